// The files of functions and curves that a view file names. Each is read from text, or from a file.
#pragma once

#include "espalier/lsystem/resources.h"

#include "geometry/side_files/control_points.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language {

/// A member of a function set; the name is cut at its last dot.
struct NamedFunction {
    std::string name;
    FunctionCurve function;
};

// All throw UserError with the place of what cannot be understood; `name` is the file's, for that.

/// A function file (`fver 1 1`), or one of the older form, which does not say its samples.
FunctionCurve read_function_text(std::string_view text, const std::string& name, int samples_if_old = 0);
FunctionCurve read_function_file(const std::filesystem::path& path, int samples_if_old = 0);

/// A function set (`funcgalleryver 1 1`).
std::vector<NamedFunction> read_function_set_text(std::string_view text, const std::string& name);
std::vector<NamedFunction> read_function_set(const std::filesystem::path& path);

/// The control points of a function file, or of all functions of a set.
std::vector<ControlPoints> read_function_points(std::string_view text, const std::string& name);

/// Whether a file whose name ends with `.con` is a curve in space, not a contour.
bool is_curve_text(std::string_view text);
ControlPoints read_curve_points(std::string_view text, const std::string& name);
/// A curve in space; `samples` chords measure its length.
SpaceCurve read_curve_text(std::string_view text, const std::string& name, int samples = 100);
SpaceCurve read_curve_file(const std::filesystem::path& path, int samples = 100);

}  // namespace espalier::language
