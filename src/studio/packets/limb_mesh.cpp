#include "studio/packets/limb_mesh.h"

#include "espalier/base/error.h"

#include "archive/meshes/axis_lines.h"
#include "archive/meshes/skin.h"
#include "archive/meshes/surface_mesh.h"
#include "studio/packets/message_bytes.h"

#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

namespace espalier::studio {
namespace {

constexpr int tube_sides = 12;
constexpr double on_screen = 1.7;  // voxels that are coarser than those of pictures: a third of the triangles

/// Tubes of one texture after those of another.
class LimbMessage {
public:
    explicit LimbMessage(const LimbAxes& axes) : axes_(axes) {}

    void add(const AxisLine& axis, const Tube& tube) {
        const auto origin = static_cast<std::uint32_t>(positions_.size());
        const FrameGeometry& geometry = axes_.geometry;
        for (const TubeVertex& vertex : tube.vertices) {
            const std::size_t row = axis.line.nodes[vertex.node].point.row();
            const auto [red, green, blue] = archive::colour_of(geometry.of_points, row);
            positions_.push_back(vertex.position);
            std::array<std::int8_t, 4> normal{};
            for (int k = 0; k < 3; ++k) {
                normal[static_cast<std::size_t>(k)] = static_cast<std::int8_t>(std::lround(127 * vertex.normal[k]));
            }
            normals_.push_back(normal);
            colours_.push_back({red, green, blue, 255});
            modules_.push_back(axes_.modules[row]);
            uvs_.push_back(vertex.uv);
        }
        std::vector<std::uint32_t>& indices = indices_[geometry.textures[axis.row]];
        for (const TubeTriangle& triangle : tube.triangles) {
            for (const std::uint32_t corner : triangle.corners) indices.push_back(origin + corner);
        }
    }

    std::string take(std::uint32_t growth, int step, bool smooth) const {
        MessageBytes out("ESM1");
        std::size_t count = 0;
        for (const auto& [texture, indices] : indices_) count += indices.size();
        out.reserve(64 + 32 * positions_.size() + 4 * count);
        out.put(growth, static_cast<std::int32_t>(step), static_cast<std::uint32_t>(smooth), size(positions_),
                static_cast<std::uint32_t>(count), size(indices_));
        std::uint32_t first = 0;
        for (const auto& [texture, indices] : indices_) {
            out.put(texture, first, size(indices));
            first += size(indices);
        }
        out.put_all(std::span<const glm::vec3>(positions_));
        out.put_all(std::span<const std::array<std::int8_t, 4>>(normals_));
        out.put_all(std::span<const std::array<std::uint8_t, 4>>(colours_));
        out.put_all(std::span<const std::uint32_t>(modules_));
        out.put_all(std::span<const glm::vec2>(uvs_));
        for (const auto& [texture, indices] : indices_) out.put_all(std::span<const std::uint32_t>(indices));
        return out.take();
    }

private:
    template <class List>
    static std::uint32_t size(const List& list) {
        return static_cast<std::uint32_t>(list.size());
    }

    const LimbAxes& axes_;
    std::vector<glm::vec3> positions_;
    std::vector<std::array<std::int8_t, 4>> normals_;
    std::vector<std::array<std::uint8_t, 4>> colours_;
    std::vector<std::uint32_t> modules_;
    std::vector<glm::vec2> uvs_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> indices_;  ///< by texture
};

std::vector<Tube> tubes_of_plant(std::span<const AxisLine> lines, const AxisSkin& skin) {
    if (skin.smooth) return skin_of(lines, std::vector<int>(lines.size(), tube_sides), skin);
    std::vector<Tube> tubes;
    for (const AxisLine& axis : lines) tubes.push_back(sweep(axis.line, tube_sides));
    return tubes;
}

}  // namespace

std::string limb_mesh(const LimbOrder& order, const ContinueCallback& may_continue) {
    const FrameGeometry& geometry = order.axes.geometry;
    const bool smooth = order.smooth;
    const std::vector<AxisLine> lines =
        axis_lines(geometry, axis_paths(geometry, {}), 0, archive::thinnest_radius(geometry),
                   smooth ? archive::Forks::none : archive::Forks::rings);
    AxisSkin skin;
    skin.smooth = smooth;
    if (smooth) skin.voxel = on_screen * archive::skin_voxel(lines, skin);
    LimbMessage message(order.axes);
    // Plant after plant, so that one may stop between them.
    for (std::size_t first = 0, end = 0; first < lines.size(); first = end) {
        while (end < lines.size() && lines[end].plant == lines[first].plant) ++end;
        if (!may_continue(static_cast<double>(first) / static_cast<double>(lines.size()))) return "";
        const auto plant = std::span(lines).subspan(first, end - first);
        const std::vector<Tube> tubes = tubes_of_plant(plant, skin);
        for (std::size_t i = 0; i < plant.size(); ++i) message.add(plant[i], tubes[i]);
    }
    return message.take(order.growth, order.step, smooth);
}

}  // namespace espalier::studio
