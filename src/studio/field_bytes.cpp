#include "studio/field_bytes.h"

#include "espalier/geometry/openvdb_grid.h"

#include "studio/message_bytes.h"

#include <openvdb/tools/Interpolation.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::studio {
namespace {

constexpr int most_voxels = 64;

std::shared_ptr<const FieldGrid> grid_of(const Field& field) {
    return field.current ? field.current() : field.grid;
}

std::array<float, 3> point_of(const openvdb::Vec3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace

std::string field_bytes(const Field& field, std::uint32_t growth, int step) {
    const std::shared_ptr<const FieldGrid> held = grid_of(field);
    const openvdb::FloatGrid& grid = *held->grid;
    const openvdb::CoordBBox box = held->box;
    const openvdb::Vec3d lower = box.min().asVec3d() - openvdb::Vec3d(0.5), size = box.dim().asVec3d();
    std::array<std::uint32_t, 3> counts{};
    for (int k = 0; k < 3; ++k) counts[std::size_t(k)] = std::uint32_t(std::clamp(box.dim()[k], 0, most_voxels));

    std::vector<float> values;
    const openvdb::FloatGrid::ConstAccessor accessor = grid.getConstAccessor();
    const openvdb::tools::GridSampler<openvdb::FloatGrid::ConstAccessor, openvdb::tools::BoxSampler> sampler(
        accessor, grid.transform());
    for (std::uint32_t z = 0; z < counts[2]; ++z) {
        for (std::uint32_t y = 0; y < counts[1]; ++y) {
            for (std::uint32_t x = 0; x < counts[0]; ++x) {
                const openvdb::Vec3d share((x + 0.5) / counts[0], (y + 0.5) / counts[1], (z + 0.5) / counts[2]);
                values.push_back(sampler.isSample(lower + size * share));
            }
        }
    }
    const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
    const float low = values.empty() ? 0 : *lowest, high = values.empty() ? 0 : *highest;

    MessageBytes out("ESF1");
    out.put(growth, static_cast<std::int32_t>(step), counts, point_of(grid.indexToWorld(lower)),
            point_of(grid.indexToWorld(lower + size)), low, high);
    out.put_text(field.name);
    for (const float value : values) {
        const float share = high > low ? (value - low) / (high - low) : 0;
        out.put(static_cast<std::uint8_t>(std::lround(255 * share)));
    }
    return out.take();
}

}  // namespace espalier::studio
