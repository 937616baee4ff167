#include "studio/packets/limb_axes.h"

#include "geometry/drawn/plant_mesh.h"
#include "studio/packets/message_bytes.h"

#include <span>
#include <type_traits>
#include <utility>

namespace espalier::studio {
namespace {

static_assert(sizeof(KeptAxes::Internode) == 48 && std::is_trivially_copyable_v<KeptAxes::Internode>,
              "it is kept as it lies in memory");

/// Lines whose points follow each other.
class Lines {
public:
    explicit Lines(std::size_t internodes) {
        geometry_.points.reserve(2 * internodes);
        geometry_.lines.connectivity.reserve(2 * internodes);
    }

    void add(const KeptAxes::Internode& internode, std::uint32_t plant) {
        if (!internode.goes_on) {
            close();
            begin(internode, plant);
        }
        add_point(internode.tip, internode.tip_radius, internode, plant);
    }

    LimbAxes take(const std::vector<BrowserTexture>& textures) {
        close();
        fill(geometry_.of_points, geometry_.points.size());
        fill(geometry_.of_cells, geometry_.lines.size());
        geometry_.texture_files.emplace_back();
        for (const BrowserTexture& texture : textures) geometry_.texture_files.push_back(texture.file.string());
        return {std::move(geometry_), std::move(modules_)};
    }

private:
    void begin(const KeptAxes::Internode& internode, std::uint32_t plant) {
        note(geometry_.of_cells, internode, plant);
        geometry_.textures.push_back(internode.texture);
        add_point(internode.base, internode.base_radius, internode, plant);
    }

    void close() {
        const auto points = static_cast<std::int32_t>(geometry_.points.size());
        if (geometry_.lines.offsets.back() < points) geometry_.lines.offsets.push_back(points);
    }

    void add_point(const glm::vec3& point, float radius, const KeptAxes::Internode& internode, std::uint32_t plant) {
        geometry_.lines.connectivity.push_back(static_cast<std::int32_t>(geometry_.points.size()));
        geometry_.points.push_back(point);
        geometry_.radii.push_back(radius);
        modules_.push_back(internode.module);
        note(geometry_.of_points, internode, plant);
    }

    static void note(FrameAttributes& of, const KeptAxes::Internode& internode, std::uint32_t plant) {
        of.plants.push_back(plant);
        of.orders.push_back(internode.order);
        of.rgb.push_back(internode.rgb);
    }

    // What was not noted.
    static void fill(FrameAttributes& of, std::size_t count) {
        of.for_columns([count](const char*, auto& column) { column.resize(count, {}); });
        of.kinds.assign(count, Kind::axis);
    }

    FrameGeometry geometry_;
    std::vector<std::uint32_t> modules_;
};

}  // namespace

std::string KeptAxes::bytes() const {
    MessageBytes out("");
    out.put(static_cast<std::uint64_t>(ends_.size()));
    out.put_all(std::span(ends_));
    out.put_all(std::span(internodes_));
    return out.take();
}

KeptAxes::KeptAxes(std::string_view bytes) {
    const auto take = [&](void* to, std::size_t size) {
        if (size > 0) std::memcpy(to, bytes.data(), size);
        bytes.remove_prefix(size);
    };
    std::uint64_t plants = 0;
    take(&plants, sizeof plants);
    ends_.resize(plants);
    take(ends_.data(), plants * sizeof ends_[0]);
    internodes_.resize(bytes.size() / sizeof(KeptAxes::Internode));
    take(internodes_.data(), bytes.size());
}

LimbAxes KeptAxes::axes(const std::vector<BrowserTexture>& textures) const {
    Lines lines(internodes_.size());
    std::size_t first = 0;
    for (std::uint32_t plant = 0; plant < ends_.size(); first = ends_[plant++]) {
        const auto of_plant = std::span(internodes_).subspan(first, ends_[plant] - first);
        for (const std::uint32_t number : geometry::by_axis(of_plant)) lines.add(of_plant[number], plant);
    }
    return lines.take(textures);
}

}  // namespace espalier::studio
