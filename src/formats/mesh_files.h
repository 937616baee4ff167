// What formats of triangles share: how many there are, and how many files.
#pragma once

#include "espalier/formats/exporter.h"

#include "archive/meshes/surface_mesh.h"

#include <functional>
#include <string>
#include <vector>

namespace espalier::formats {

/// What to say of a mesh that could not have the number of triangles asked for, to a tenth; "" otherwise.
std::string hint_of_triangles(const ExportJob& job, std::size_t triangles);

/// Throws UserError if fewer triangles, a distance or several pieces are asked for; `why` says of what there can be
/// none.
void refuse_triangles_and_split(const ExportJob& job, const std::string& why);

/// Writes each frame into a file, or into a file for every piece; reports them. A triangle of a format that shares no
/// vertices has three of its own.
void write_meshes(const ExportJob& job, const std::string& extension, bool shares_vertices,
                  const std::function<std::string(const FrameMesh&)>& bytes_of);

}  // namespace espalier::formats
