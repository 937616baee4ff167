#include "studio/packets/limb_axes.h"

#include "geometry/drawn/plant_mesh.h"
#include "studio/packets/message_bytes.h"
#include "studio/packets/packet.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace espalier::studio {

template <class Self, class Visit>
void KeptAxes::for_columns(Self& self, const Visit& visit) {
    visit(self.points_);
    visit(self.radii_);
    visit(self.modules_);
    visit(self.plants_);
    visit(self.ends_);
    visit(self.orders_);
    visit(self.textures_);
    visit(self.rgb_);
}

KeptAxes::KeptAxes(const timeline::Frame& frame, const Look& look) {
    const std::vector<std::uint32_t> firsts = first_modules(frame);
    for (std::uint32_t plant = 0; plant < frame.plants.size(); ++plant) {
        const PlantGeometry& drawn = frame.plants[plant].interpretation->geometry;
        geometry::for_lines(drawn.internodes, [&](std::uint32_t i, bool begins) {
            const Internode& internode = drawn.internodes[i];
            const auto add = [&](const glm::dvec3& point, double radius) {
                points_.emplace_back(point);
                radii_.push_back(static_cast<float>(radius));
                modules_.push_back(firsts[plant] + internode.module);
                orders_.push_back(internode.order);
                rgb_.push_back(look.colour(plant, internode.colour));
            };
            if (begins) {
                const std::uint16_t texture = i < drawn.textures.size() ? drawn.textures[i] : std::uint16_t{0};
                plants_.push_back(plant);
                textures_.push_back(static_cast<std::uint16_t>(look.texture(plant, texture)));
                ends_.push_back(0);
                add(internode.base, internode.base_radius);
            }
            add(internode.tip, internode.tip_radius);
            ends_.back() = static_cast<std::int32_t>(points_.size());
        });
    }
}

std::string KeptAxes::bytes() const {
    MessageBytes out("");
    for_columns(*this, [&](const auto& column) {
        out.put(static_cast<std::uint64_t>(column.size()));
        out.put_all(std::span(column));
    });
    return out.take();
}

KeptAxes::KeptAxes(std::string_view bytes) {
    const auto take = [&](void* to, std::size_t size) {
        if (size > 0) std::memcpy(to, bytes.data(), size);
        bytes.remove_prefix(size);
    };
    for_columns(*this, [&](auto& column) {
        std::uint64_t count = 0;
        take(&count, sizeof count);
        column.resize(count);
        take(column.data(), count * sizeof(column[0]));
    });
}

LimbAxes KeptAxes::axes(const std::vector<BrowserTexture>& textures) const {
    LimbAxes result;
    FrameGeometry& geometry = result.geometry;
    geometry.points = points_;
    geometry.radii = radii_;
    geometry.lines.offsets.insert(geometry.lines.offsets.end(), ends_.begin(), ends_.end());
    geometry.lines.connectivity.resize(points_.size());
    std::iota(geometry.lines.connectivity.begin(), geometry.lines.connectivity.end(), 0);
    const auto fill = [](FrameAttributes& of, std::size_t count) {
        of.for_columns([count](const char*, auto& column) { column.resize(count, {}); });
        of.kinds.assign(count, Kind::axis);
    };
    fill(geometry.of_points, points_.size());
    fill(geometry.of_cells, plants_.size());
    geometry.of_points.orders = orders_;
    geometry.of_points.rgb = rgb_;
    geometry.of_cells.plants = plants_;
    for (std::size_t line = 0; line < plants_.size(); ++line) {
        for (const std::int32_t point : geometry.lines[line]) {
            geometry.of_points.plants[static_cast<std::size_t>(point)] = plants_[line];
        }
        const auto first = static_cast<std::size_t>(geometry.lines[line].front());
        geometry.of_cells.orders[line] = orders_[first];
        geometry.of_cells.rgb.push_back(rgb_[first]);
    }
    geometry.textures = textures_;
    geometry.texture_files.emplace_back();
    for (const BrowserTexture& texture : textures) geometry.texture_files.push_back(texture.file.string());
    result.modules.assign(modules_.begin(), modules_.end());
    return result;
}

}  // namespace espalier::studio
