// Embree without anything around it: the yardstick of everything that follows rays.
#pragma once

#include "base/parallel.h"
#include "geometry/rays/embree.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

namespace espalier::bench {

struct Ray {
    glm::vec3 origin, direction;
};

/// One mesh in a scene of Embree, without anything around it.
class BareEmbree {
public:
    BareEmbree(const char* options, std::span<const glm::vec3> corners)
        : device_(rtcNewDevice(options)), scene_(rtcNewScene(device_)) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* places = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), corners.size()));
        auto* numbers = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), corners.size() / 3));
        std::copy(corners.begin(), corners.end(), places);
        std::iota(numbers, numbers + corners.size(), 0U);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    ~BareEmbree() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;

    std::size_t hits(std::span<const Ray> rays) const {
        std::atomic<std::size_t> hits = 0;
        for_in_parallel(tbb::blocked_range<std::size_t>(0, rays.size()), [&](const auto& part) {
            std::size_t own = 0;
            for (std::size_t i = part.begin(); i < part.end(); ++i) {
                const auto& [o, d] = rays[i];
                RTCRayHit ray{{o.x, o.y, o.z, 0, d.x, d.y, d.z, 0, INFINITY, 0xFFFFFFFF, 0, 0}, {}};
                ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
                geometry::intersect(scene_, ray);
                own += ray.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
            }
            hits += own;
        });
        return hits;
    }

private:
    RTCDevice device_;
    RTCScene scene_;
};

}  // namespace espalier::bench
