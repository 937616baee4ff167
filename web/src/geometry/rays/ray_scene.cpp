#include "geometry/rays/ray_scene.h"

#include "espalier/base/error.h"

namespace espalier::geometry {

/// Nothing: rays are Embree's, which pages do not have.
struct RayScene::Embree {};

glm::mat4x3 moved_by(const glm::vec3& shift) {
    glm::mat4x3 place(1.0f);
    place[3] = shift;
    return place;
}

RayScene::RayScene() {
    throw RunError("a page cannot trace rays: this needs the program that is installed, with Embree");
}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::size_t RayScene::set_parts(std::span<const Part>) {
    return 0;
}

std::optional<RayScene::Hit> RayScene::first_hit(const glm::vec3&, const glm::vec3&, float, float) const {
    return std::nullopt;
}

bool RayScene::is_blocked(const glm::vec3&, const glm::vec3&, float, float) const {
    return false;
}

}  // namespace espalier::geometry
