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

/// A field in as many voxels as pages get.
struct Sampled {
    std::array<std::uint32_t, 3> counts{};
    std::array<float, 3> lower{}, upper{};
    std::vector<float> values;
};

/// `value_at` gives the value of the voxel at a share of the box, 0 to 1 along each side: the nearest one, which is the
/// one itself where all of them are sent.
template <class ValueAt>
void sample(Sampled& sampled, const std::array<int, 3>& size, const ValueAt& value_at) {
    for (std::size_t k = 0; k < 3; ++k) sampled.counts[k] = std::uint32_t(std::clamp(size[k], 0, most_voxels));
    const auto [columns, rows, layers] = sampled.counts;
    sampled.values.resize(std::size_t{columns} * rows * layers);
    tbb::parallel_for(std::uint32_t{0}, layers, [&, columns = columns, rows = rows, layers = layers](std::uint32_t z) {
        const auto value = value_at();
        float* at = sampled.values.data() + std::size_t(z) * rows * columns;
        for (std::uint32_t y = 0; y < rows; ++y) {
            for (std::uint32_t x = 0; x < columns; ++x) {
                *at++ = value((x + 0.5) / columns, (y + 0.5) / rows, (z + 0.5) / layers);
            }
        }
    });
}

std::string message_of(const Sampled& sampled, const std::string& name, std::uint32_t growth, int step) {
    const auto& values = sampled.values;
    const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
    const float low = values.empty() ? 0 : *lowest, high = values.empty() ? 0 : *highest;
    MessageBytes out("ESF1");
    out.put(growth, static_cast<std::int32_t>(step), sampled.counts, sampled.lower, sampled.upper, low, high);
    out.put_text(name);
    std::vector<std::uint8_t> parts(values.size());
    std::transform(values.begin(), values.end(), parts.begin(), [&](float value) {
        return static_cast<std::uint8_t>(high > low ? 255 * ((value - low) / (high - low)) + 0.5f : 0);
    });
    out.put_all(std::span<const std::uint8_t>(parts));
    return out.take();
}

}  // namespace

std::string field_bytes(const Field& field, std::uint32_t growth, int step) {
    const std::shared_ptr<const FieldGrid> held = grid_of(field);
    const openvdb::FloatGrid& grid = *held->grid;
    const openvdb::Vec3d lower = held->box.min().asVec3d() - openvdb::Vec3d(0.5), size = held->box.dim().asVec3d();
    Sampled sampled;
    sampled.lower = point_of(grid.indexToWorld(lower));
    sampled.upper = point_of(grid.indexToWorld(lower + size));
    const openvdb::Coord dim = held->box.dim();
    sample(sampled, {dim.x(), dim.y(), dim.z()}, [&] {
        return [&, accessor = grid.getConstAccessor()](double x, double y, double z) {
            return accessor.getValue(openvdb::Coord::round(lower + size * openvdb::Vec3d(x, y, z)));
        };
    });
    return message_of(sampled, field.name, growth, step);
}

std::string field_bytes(const RecordedField& field, std::uint32_t growth, int step) {
    Sampled sampled;
    for (int k = 0; k < 3; ++k) {
        const double lower = field.origin[k] - 0.5 * field.voxel[k];
        sampled.lower[std::size_t(k)] = static_cast<float>(lower);
        sampled.upper[std::size_t(k)] = static_cast<float>(lower + field.size[k] * field.voxel[k]);
    }
    const auto index = [](double share, int count) { return std::min(static_cast<int>(share * count), count - 1); };
    sample(sampled, {field.size.x, field.size.y, field.size.z}, [&] {
        return [&](double x, double y, double z) {
            return field.at(index(x, field.size.x), index(y, field.size.y), index(z, field.size.z));
        };
    });
    return message_of(sampled, field.name, growth, step);
}

}  // namespace espalier::studio
