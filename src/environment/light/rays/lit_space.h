// What a path of light meets: triangles, the soil below them and the sky above, perhaps in a period that repeats.
#pragma once

#include "environment/light/rays/light_path.h"
#include "environment/light/rays/light_sensor.h"
#include "environment/light/rays/lit_triangles.h"
#include "geometry/rays/ray_scene.h"

#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace espalier::environment {

class LitSpace {
public:
    /// `ground`: height of the soil. `period`: of a stand without an edge.
    LitSpace(double ground, std::optional<Box> period) : ground_(ground), period_(std::move(period)) {}

    /// Keeps a reference to the triangles. `highest`: lamps may stand up to there. Returns how many parts of the
    /// triangles have changed.
    std::size_t set(const LitTriangles& triangles, std::span<const LightSensor> sensors, double highest);

    /// Of a ball around all there is.
    const glm::dvec3& centre() const { return centre_; }
    double radius() const { return radius_; }
    const std::optional<Box>& period() const { return period_; }
    /// A little below the ground, so that what is drawn at its height lies on it.
    double soil() const { return soil_; }
    /// The same place, inside the period.
    glm::dvec3 inside(const glm::dvec3& place) const { return period_ ? wrapped(place, *period_) : place; }
    /// How far from where it was scattered a path meets nothing.
    double near() const { return near_; }

    struct Met {
        enum class Kind : std::uint8_t { triangle, soil, sky } kind = Kind::sky;
        RayScene::Hit hit{};
    };
    /// Goes on to what is met next. pass(to) is called before each stretch.
    template <class Pass>
    Met advance(LightPath& path, const Pass& pass) const;
    /// Whether nothing is in the way from the surface of a triangle, behind `near`, for that length; the soil neither.
    bool is_open(const glm::dvec3& from, const glm::dvec3& direction, double length) const;
    /// What light from a direction meets at a place of a surface, if not that surface itself: something that lies
    /// within `near` before it, or in the same place.
    std::optional<RayScene::Hit> met_at(const glm::dvec3& place, const glm::dvec3& towards) const;

private:
    static constexpr double far = std::numeric_limits<double>::infinity();
    static constexpr int most_periods = 100'000;

    Box bounds_of(const LitTriangles& triangles, std::span<const LightSensor> sensors) const;
    double to_side(const LightPath& path) const;
    void enter_opposite(LightPath& path) const;

    double ground_;
    std::optional<Box> period_;
    RayScene scene_;
    glm::dvec3 centre_{0, 0, 0};
    double radius_ = 0, near_ = 0, top_ = 0, soil_ = 0;
};

template <class Pass>
LitSpace::Met LitSpace::advance(LightPath& path, const Pass& pass) const {
    for (int periods = 0; periods < most_periods; ++periods) {
        const bool goes_down = path.direction.y < 0;
        const double to_soil = goes_down ? std::max(0.0, (soil_ - path.origin.y) / path.direction.y) : far;
        const double side = to_side(path);
        const double limit = std::min(to_soil, side);
        const auto hit = scene_.first_hit(glm::vec3(path.origin), glm::vec3(path.direction),
                                          static_cast<float>(path.near), static_cast<float>(limit));
        pass(hit ? static_cast<double>(hit->distance) : limit);
        if (hit) {
            path.origin += static_cast<double>(hit->distance) * path.direction;
            return {Met::Kind::triangle, *hit};
        }
        if (limit == far) return {};
        path.origin += limit * path.direction;
        if (to_soil <= side) return {Met::Kind::soil, {}};
        if (path.direction.y >= 0 && path.origin.y > top_) return {};
        enter_opposite(path);
    }
    return {};
}

}  // namespace espalier::environment
