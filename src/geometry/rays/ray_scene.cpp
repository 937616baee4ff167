#include "geometry/rays/ray_scene.h"

#include "espalier/base/error.h"

#include "geometry/rays/embree.h"

#include <algorithm>
#include <string>
#include <utility>

namespace espalier::geometry {
namespace {

// The widest instructions differ between processors, and so would their rounding.
constexpr const char* same_everywhere = "isa=sse2";

RTCRay ray_of(const glm::vec3& origin, const glm::vec3& direction, float from, float to) {
    return {origin.x, origin.y, origin.z, from, direction.x, direction.y, direction.z, 0, to, 0xFFFFFFFF, 0, 0};
}

}  // namespace

struct RayScene::Embree {
    /// Releases it with its owner.
    class TriangleScene {
    public:
        explicit TriangleScene(RTCDevice device) : scene_(rtcNewScene(device)) {}
        TriangleScene(TriangleScene&& other) noexcept : scene_(std::exchange(other.scene_, nullptr)) {}
        TriangleScene& operator=(TriangleScene&& other) noexcept {
            std::swap(scene_, other.scene_);
            return *this;
        }
        ~TriangleScene() {
            if (scene_) rtcReleaseScene(scene_);
        }
        RTCScene get() const { return scene_; }

    private:
        RTCScene scene_;
    };

    struct BuiltPart {
        TriangleScene scene;
        std::span<const glm::vec3> corners;  ///< of the scene
    };

    struct Standing {
        std::uint32_t part, place;
    };

    RTCDevice device = rtcNewDevice(same_everywhere);
    std::vector<BuiltPart> parts;
    std::vector<Standing> instances;
    std::optional<TriangleScene> all;
    RTCScene met = nullptr;  ///< what rays are sent into

    Embree() { require_success(); }
    ~Embree() {
        all.reset();
        parts.clear();
        if (device) rtcReleaseDevice(device);
    }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    void require_success() const {
        if (device && rtcGetDeviceError(device) == RTC_ERROR_NONE) return;
        throw RunError("rays: Embree cannot hold the triangles of the plants: there is too little memory");
    }

    void attach(const TriangleScene& scene, RTCGeometry geometry) const {
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene.get(), geometry);
        rtcReleaseGeometry(geometry);
    }

    BuiltPart build(std::span<const glm::vec3> corners) const {
        TriangleScene scene(device);
        require_success();
        rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* places = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), corners.size()));
        auto* numbers = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), corners.size() / 3));
        require_success();
        std::copy(corners.begin(), corners.end(), places);
        for (std::size_t i = 0; i < corners.size(); ++i) numbers[i] = static_cast<std::uint32_t>(i);
        attach(scene, geometry);
        rtcCommitScene(scene.get());
        require_success();
        return {std::move(scene), {places, corners.size()}};
    }

    void stand(const BuiltPart& part, const glm::mat4x3& place) {
        RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(instance, part.scene.get());
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &place[0][0]);
        attach(*all, instance);
    }
};

glm::mat4x3 moved_by(const glm::vec3& shift) {
    glm::mat4x3 place(1);
    place[3] = shift;
    return place;
}

RayScene::RayScene() : embree_(std::make_unique<Embree>()) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::size_t RayScene::set_parts(std::span<const Part> parts) {
    std::size_t built = 0;
    Embree& own = *embree_;
    own.all.emplace(own.device);
    own.require_success();
    rtcSetSceneFlags(own.all->get(), RTC_SCENE_FLAG_ROBUST);
    own.instances.clear();
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const std::span<const glm::vec3> corners = parts[k].corners;
        const bool is_known = k < own.parts.size();
        if (!is_known ||
            !std::equal(corners.begin(), corners.end(), own.parts[k].corners.begin(), own.parts[k].corners.end())) {
            Embree::BuiltPart part = own.build(corners);
            if (is_known) {
                own.parts[k] = std::move(part);
            } else {
                own.parts.push_back(std::move(part));
            }
            ++built;
        }
        if (corners.empty()) continue;
        for (std::size_t i = 0; i < parts[k].places.size(); ++i) {
            own.stand(own.parts[k], parts[k].places[i]);
            own.instances.push_back({static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(i)});
        }
    }
    own.parts.erase(own.parts.begin() + static_cast<std::ptrdiff_t>(parts.size()), own.parts.end());
    rtcCommitScene(own.all->get());
    own.require_success();
    // A lone part that is not moved needs no look into the places first, a sixth of a ray's time.
    const bool is_alone = own.instances.size() == 1;
    const Embree::Standing alone = is_alone ? own.instances.front() : Embree::Standing{};
    const bool is_as_given = is_alone && parts[alone.part].places[alone.place] == moved_by({0, 0, 0});
    own.met = is_as_given ? own.parts[alone.part].scene.get() : own.all->get();
    return built;
}

std::optional<RayScene::Hit> RayScene::first_hit(const glm::vec3& origin, const glm::vec3& direction, float from,
                                                 float to) const {
    if (embree_->instances.empty()) return std::nullopt;
    RTCRayHit ray{ray_of(origin, direction, from, to), {}};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersect(embree_->met, ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return hit_of(ray.hit.instID[0], ray.hit.primID, ray.ray.tfar, ray.hit.u, ray.hit.v);
}

RayScene::Hit RayScene::hit_of(std::uint32_t instance, std::uint32_t triangle, float distance, float u, float v) const {
    const auto [part, place] = embree_->instances[instance == RTC_INVALID_GEOMETRY_ID ? 0 : instance];
    return {part, triangle, distance, u, v, place};
}

RayScene::FourHits RayScene::first_hits(std::span<const glm::vec3, 4> origins, std::span<const glm::vec3, 4> directions,
                                        float to) const {
    FourHits hits;
    if (embree_->instances.empty()) return hits;
    RTCRayHit4 rays{};
    for (std::size_t i = 0; i < 4; ++i) {
        rays.ray.org_x[i] = origins[i].x, rays.ray.org_y[i] = origins[i].y, rays.ray.org_z[i] = origins[i].z;
        rays.ray.dir_x[i] = directions[i].x, rays.ray.dir_y[i] = directions[i].y, rays.ray.dir_z[i] = directions[i].z;
        rays.ray.tfar[i] = to;
        rays.ray.mask[i] = 0xFFFFFFFF;
        rays.hit.geomID[i] = rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    intersect(embree_->met, rays);
    for (std::size_t i = 0; i < 4; ++i) {
        if (rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
        hits[i] = hit_of(rays.hit.instID[0][i], rays.hit.primID[i], rays.ray.tfar[i], rays.hit.u[i], rays.hit.v[i]);
    }
    return hits;
}

bool RayScene::is_blocked(const glm::vec3& origin, const glm::vec3& direction, float from, float to) const {
    if (embree_->instances.empty()) return false;
    RTCRay ray = ray_of(origin, direction, from, to);
    return is_occluded(embree_->met, ray);
}

}  // namespace espalier::geometry
