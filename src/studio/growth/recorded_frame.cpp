#include "studio/growth/recorded_frame.h"

#include "espalier/base/error.h"

#include "archive/meshes/surface_mesh.h"
#include "studio/packets/message_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::studio {
namespace {

RecordedModule module_at(const FrameAttributes& of, std::size_t row) {
    return {{of.plants[row], of.identities[row]}, of.parents[row], of.symbols[row], of.births[row], of.orders[row], {}};
}

Rgba rgba(const archive::Rgb& rgb, double opacity) {
    return {rgb[0], rgb[1], rgb[2], static_cast<std::uint8_t>(std::lround(255 * std::clamp(opacity, 0.0, 1.0)))};
}

}  // namespace

DrawnFrame::DrawnFrame(const RecordedRun& run, const RecordedFrame& frame) : geometry_(run.geometry(frame)) {
    const std::vector<FrameInternode> internodes = internodes_of(geometry_);
    find_modules(run, internodes);
    add_internodes(internodes);
    add_surfaces(run);
}

void DrawnFrame::find_modules(const RecordedRun& run, const std::vector<FrameInternode>& internodes) {
    const auto add = [this](RecordedModule module, PointIndex point) {
        if (!numbers_.try_emplace(module.organ).second) return;
        module.point = point.row();
        modules_.push_back(std::move(module));
    };
    for (const FrameInternode& internode : internodes) {
        add(module_at(geometry_.of_points, internode.tip_point.row()), internode.tip_point);
    }
    for (std::size_t i = 0; i < geometry_.polygons.size(); ++i) {
        const auto corners = geometry_.polygons[i];
        if (!corners.empty()) add(module_at(geometry_.of_cells, geometry_.polygons.first + i), PointIndex(corners[0]));
    }
    std::stable_sort(modules_.begin(), modules_.end(),
                     [](const RecordedModule& a, const RecordedModule& b) { return a.organ.plant < b.organ.plant; });
    for (std::size_t i = 0; i < modules_.size(); ++i) numbers_[modules_[i].organ] = static_cast<std::uint32_t>(i);
    for (const RecordedPlant& plant : run.plants()) {
        const auto first = std::partition_point(modules_.begin(), modules_.end(), [&](const RecordedModule& module) {
            return module.organ.plant < plant.number;
        });
        parts_.first_modules.push_back(static_cast<std::uint32_t>(first - modules_.begin()));
    }
}

void DrawnFrame::add_internodes(const std::vector<FrameInternode>& internodes) {
    for (const FrameInternode& one : internodes) {
        parts_.extent.add(one.base, one.tip, double(one.base_radius), double(one.tip_radius));
    }
    for (const FrameInternode& one : internodes) {
        parts_.internodes.push_back({parts_.extent.parts(one.base), parts_.extent.parts(one.tip),
                                     parts_.extent.part_of_radius(double(one.base_radius)),
                                     parts_.extent.part_of_radius(double(one.tip_radius)),
                                     archive::colour_of(geometry_.of_points, one.tip_point.row()),
                                     static_cast<std::uint8_t>(std::min<int>(one.order, 255)),
                                     number_of({one.plant, one.identity})});
    }
}

void DrawnFrame::add_surfaces(const RecordedRun& run) {
    const FrameMesh mesh = surfaces_of(geometry_, {});
    for (const MeshPart& part : mesh.parts) {
        const std::uint32_t module = number_of({part.plant, part.identity});
        const auto first = static_cast<std::uint32_t>(parts_.triangles.points.size());
        for (std::size_t i = part.first_vertex; i < part.first_vertex + part.vertices; ++i) {
            parts_.triangles.add({mesh.points[i], mesh.normals[i], {}},
                                 rgba(mesh.rgb[i], run.material(mesh.rgb[i]).opacity), module);
        }
        for (std::size_t i = part.first_triangle; i < part.first_triangle + part.triangles; ++i) {
            for (const std::uint32_t corner : mesh.triangles[i]) {
                parts_.triangles.indices.push_back(first + corner - static_cast<std::uint32_t>(part.first_vertex));
            }
        }
    }
    parts_.triangles.sort();
}

LimbAxes DrawnFrame::limb_axes() const {
    LimbAxes axes{geometry_, std::vector<std::uint32_t>(geometry_.points.size(), 0)};
    std::fill(axes.geometry.textures.begin(), axes.geometry.textures.end(), std::uint16_t{0});
    const FrameAttributes& of = geometry_.of_points;
    for (std::size_t i = 0; i < axes.modules.size(); ++i) {
        const auto number = numbers_.find({of.plants[i], of.identities[i]});
        if (number != numbers_.end()) axes.modules[i] = number->second;
    }
    return axes;
}

std::vector<std::pair<std::string, double>> DrawnFrame::parameters(const RecordedModule& module) const {
    std::vector<std::pair<std::string, double>> known;
    for (const auto& [name, values] : geometry_.parameters) {
        if (module.point && !std::isnan(values[*module.point])) known.emplace_back(name, values[*module.point]);
    }
    return known;
}

std::vector<std::string> DrawnFrame::columns() const {
    std::vector<std::string> names{"age", "plant", "symbol", "order"};
    for (const auto& [name, values] : geometry_.parameters) names.push_back(name);
    return names;
}

std::string DrawnFrame::column(std::uint32_t growth, int step, const std::string& name) const {
    const auto parameter = geometry_.parameters.find(name);
    const auto value = [&](const RecordedModule& module) {
        if (name == "age") return static_cast<float>(step - module.birth);
        if (name == "plant") return static_cast<float>(module.organ.plant);
        if (name == "symbol") return static_cast<float>(module.symbol);
        if (name == "order") return static_cast<float>(module.order);
        if (parameter == geometry_.parameters.end()) throw UserError(fmt::format("modules have no '{}'", name));
        return module.point ? static_cast<float>(parameter->second[*module.point]) : no_number;
    };
    std::vector<float> values;
    for (const RecordedModule& module : modules_) values.push_back(value(module));
    return column_message(growth, step, name, values);
}

}  // namespace espalier::studio
