#include "formats/mesh_files.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "archive/meshes/mesh_pieces.h"

#include <fmt/format.h>

#include <cmath>

namespace espalier::formats {
namespace {

PieceLimit limit_of(const ExportJob& job, bool shares_vertices) {
    PieceLimit limit;
    if (job.most_vertices == 0) return limit;
    if (shares_vertices) {
        limit.vertices = job.most_vertices;
    } else {
        limit.triangles = job.most_vertices / 3;
    }
    return limit;
}

void write_mesh(const ExportJob& job, const RecordedFrame& frame, const std::string& extension, bool shares_vertices,
                const FrameMesh& mesh, std::size_t piece, const std::string& bytes, const std::string& hint) {
    const std::size_t vertices = shares_vertices ? mesh.points.size() : 3 * mesh.triangles.size();
    const auto path = job.path(frame, extension, {vertices, mesh.triangles.size(), piece, ""});
    write_text(path, bytes);
    job.report({path, vertices, mesh.triangles.size(), 0, "", hint});
}

}  // namespace

std::string hint_of_triangles(const ExportJob& job, std::size_t triangles) {
    if (!job.options.triangles) return "";
    const auto wanted = static_cast<double>(*job.options.triangles), found = static_cast<double>(triangles);
    if (std::abs(found - wanted) <= 0.1 * wanted) return "";
    if (found < wanted) {
        return fmt::format("--triangles {}: there are no more than {} triangles; more --sides give more",
                           *job.options.triangles, triangles);
    }
    return fmt::format("--triangles {}: no number near it can be reached; the next larger is {}",
                       *job.options.triangles, triangles);
}

void refuse_triangles_and_split(const ExportJob& job, const std::string& why) {
    if (job.options.triangles) throw UserError(fmt::format("--triangles {}: {}", *job.options.triangles, why));
    if (job.options.distance > 0) throw UserError(fmt::format("--distance {}: {}", job.options.distance, why));
    if (job.most_vertices > 0) throw UserError(fmt::format("--split {}: {}", job.most_vertices, why));
}

void write_meshes(const ExportJob& job, const std::string& extension, bool shares_vertices,
                  const std::function<std::string(const FrameMesh&)>& bytes_of) {
    for (const RecordedFrame* frame : job.frames) {
        const FrameMesh mesh = mesh_of(job.geometry(*frame), job.options);
        const std::string hint = hint_of_triangles(job, mesh.triangles.size());
        if (job.most_vertices == 0) {
            write_mesh(job, *frame, extension, shares_vertices, mesh, 0, bytes_of(mesh), hint);
            continue;
        }
        const std::vector<FrameMesh> pieces = pieces_of(mesh, limit_of(job, shares_vertices));
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            const std::size_t number = pieces.size() > 1 ? i + 1 : 0;
            write_mesh(job, *frame, extension, shares_vertices, pieces[i], number, bytes_of(pieces[i]),
                       i == 0 ? hint : "");
        }
    }
}

}  // namespace espalier::formats
