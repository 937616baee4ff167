#include "environment/rays/ray_scene.h"

#include "espalier/base/error.h"

#include <algorithm>
#include <embree3/rtcore.h>
#include <limits>
#include <string>

namespace espalier::environment {
namespace {

// The widest instructions differ between processors, and so would their rounding.
constexpr const char* same_everywhere = "isa=sse2";

}  // namespace

struct RayScene::Embree {
    RTCDevice device = rtcNewDevice(same_everywhere);
    RTCScene scene = nullptr;

    Embree() { require_success(); }
    ~Embree() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    void require_success() const {
        if (device && rtcGetDeviceError(device) == RTC_ERROR_NONE) return;
        throw RunError("rays: Embree cannot hold the triangles of the plants: there is too little memory");
    }
};

RayScene::RayScene() : embree_(std::make_unique<Embree>()) {}
RayScene::~RayScene() = default;

void RayScene::set_triangles(std::span<const glm::vec3> corners) {
    if (embree_->scene) rtcReleaseScene(embree_->scene);
    embree_->scene = rtcNewScene(embree_->device);
    embree_->require_success();
    rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::size_t triangles = corners.size() / 3;
    auto* places = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), 3 * triangles));
    auto* numbers = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles));
    if (triangles > 0) embree_->require_success();
    for (std::size_t i = 0; i < 3 * triangles; ++i) {
        places[i] = corners[i];
        numbers[i] = static_cast<std::uint32_t>(i);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(embree_->scene);
    embree_->require_success();
}

std::optional<RayScene::Hit> RayScene::first_hit(const glm::vec3& origin, const glm::vec3& direction, float from,
                                                 float to) const {
    if (!embree_->scene) return std::nullopt;
    RTCRayHit ray{};
    ray.ray = {origin.x, origin.y, origin.z, from, direction.x, direction.y, direction.z, 0, to, 0xFFFFFFFF, 0, 0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(embree_->scene, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{ray.hit.primID, ray.ray.tfar};
}

}  // namespace espalier::environment
