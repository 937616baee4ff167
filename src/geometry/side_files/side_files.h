// The files of shapes that a view file names: contours and surfaces. Each is read from text, or from a file.
#pragma once

#include "espalier/base/error.h"
#include "espalier/geometry/contour.h"
#include "espalier/geometry/surface.h"

#include "geometry/side_files/control_points.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::geometry {

// All throw UserError with the place of what cannot be understood; `name` is the file's, for that. What can be
// understood but not used is explained among `diagnostics`, and nothing is returned.

/// A contour (`cver 1 1` to `cver 1 3`, or the oldest form without version).
std::optional<Contour> read_contour_text(std::string_view text, const std::string& name,
                                         std::vector<Diagnostic>& diagnostics);
std::optional<ControlPoints> read_contour_points(std::string_view text, const std::string& name,
                                                 std::vector<Diagnostic>& diagnostics);
std::optional<Contour> read_contour(const std::filesystem::path& path, std::vector<Diagnostic>& diagnostics);

/// A Bezier surface (.s), placed: the contact point at the origin, x along left, y along heading, z along up, `size`
/// long where the file says SIZE.
std::optional<Surface> read_surface_text(std::string_view text, const std::string& name, double size,
                                         std::vector<Diagnostic>& diagnostics);
/// Sixteen points a patch, in rows, as the file writes them.
std::vector<ControlPoints> read_surface_points(std::string_view text, const std::string& name,
                                               std::vector<Diagnostic>& diagnostics);
std::optional<Surface> read_surface(const std::filesystem::path& path, double size,
                                    std::vector<Diagnostic>& diagnostics);

/// A surface of triangles (.ray), `size` times as large.
std::optional<Surface> read_triangles_text(std::string_view text, const std::string& name, double size,
                                           std::vector<Diagnostic>& diagnostics);
std::optional<Surface> read_triangles(const std::filesystem::path& path, double size,
                                      std::vector<Diagnostic>& diagnostics);

/// A surface of triangles from Wavefront OBJ, `size` times as large: its y is along heading, its x to the right and its
/// z towards the viewer of a turtle that stands upright. Polygons are cut into triangles.
Surface read_object_text(std::string_view text, const std::string& name, double size);
Surface read_object(const std::filesystem::path& path, double size);

}  // namespace espalier::geometry
