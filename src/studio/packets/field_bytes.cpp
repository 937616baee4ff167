#include "studio/packets/field_bytes.h"

#include "espalier/geometry/openvdb_grid.h"

#include "studio/packets/message_bytes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

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

    // The nearest voxel, which is the one itself where all of them are sent.
    const std::size_t voxels = std::size_t{counts[0]} * counts[1] * counts[2];
    std::vector<float> values(voxels);
    const auto sample_layer = [&](std::uint32_t z) {
        const openvdb::FloatGrid::ConstAccessor accessor = grid.getConstAccessor();
        float* at = values.data() + std::size_t(z) * counts[1] * counts[0];
        for (std::uint32_t y = 0; y < counts[1]; ++y) {
            for (std::uint32_t x = 0; x < counts[0]; ++x) {
                const openvdb::Vec3d share((x + 0.5) / counts[0], (y + 0.5) / counts[1], (z + 0.5) / counts[2]);
                *at++ = accessor.getValue(openvdb::Coord::round(lower + size * share));
            }
        }
    };
    tbb::parallel_for(std::uint32_t{0}, counts[2], sample_layer);
    const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
    const float low = values.empty() ? 0 : *lowest, high = values.empty() ? 0 : *highest;

    MessageBytes out("ESF1");
    out.put(growth, static_cast<std::int32_t>(step), counts, point_of(grid.indexToWorld(lower)),
            point_of(grid.indexToWorld(lower + size)), low, high);
    out.put_text(field.name);
    std::vector<std::uint8_t> parts(values.size());
    std::transform(values.begin(), values.end(), parts.begin(), [&](float value) {
        return static_cast<std::uint8_t>(high > low ? 255 * ((value - low) / (high - low)) + 0.5f : 0);
    });
    out.put_all(std::span<const std::uint8_t>(parts));
    return out.take();
}

}  // namespace espalier::studio
