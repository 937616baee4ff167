#pragma once

#include <openvdb/openvdb.h>

namespace openvdb::tools {

/// Linear along z, then y, then x, between the eight voxels around an index.
struct BoxSampler {
    template <class Values>
    static float sample(const Values& values, const Vec3d& index) {
        const Coord corner = Coord::floor(index);
        const Vec3d share = index - corner.asVec3d();
        const auto between = [](float a, float b, double weight) {
            const auto part = static_cast<float>((b - a) * weight);
            return a + part;
        };
        const auto along_z = [&](int x, int y) {
            return between(values.getValue(corner.offsetBy(x, y, 0)), values.getValue(corner.offsetBy(x, y, 1)),
                           share.z());
        };
        const auto along_y = [&](int x) { return between(along_z(x, 0), along_z(x, 1), share.y()); };
        return between(along_y(0), along_y(1), share.x());
    }
};

}  // namespace openvdb::tools
