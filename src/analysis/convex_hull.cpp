#include "analysis/convex_hull.h"

#include "espalier/base/error.h"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <glm/common.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace espalier::analysis {
namespace {

/// Qhull's answer for points of `dimension` coordinates each; everything of it is freed at the end.
class Hull {
public:
    Hull(std::vector<double> coordinates, int dimension) : coordinates_(std::move(coordinates)) {
        qh_zero(&qhull_, errors_.get());
        // FA computes area and volume; Pp leaves out warnings about precision.
        char options[] = "qhull FA Pp";
        const int points = static_cast<int>(coordinates_.size()) / dimension;
        code_ = qh_new_qhull(&qhull_, dimension, points, coordinates_.data(), /*ismalloc=*/False, options, nullptr,
                             errors_.get());
    }
    ~Hull() {
        qh_freeqhull(&qhull_, !qh_ALL);
        int current = 0, total = 0;
        qh_memfreeshort(&qhull_, &current, &total);
    }
    Hull(const Hull&) = delete;
    Hull& operator=(const Hull&) = delete;

    /// In the plane an area. 0 if the points span no more than a hyperplane.
    double volume() const {
        if (code_ == qh_ERRsingular) return 0;
        if (code_ == qh_ERRmem) throw std::bad_alloc();
        if (code_ != qh_ERRnone) throw RunError("qhull cannot compute a convex hull of these points");
        return qhull_.totvol;
    }

private:
    std::vector<double> coordinates_;
    /// Where qhull writes its explanations, which are not read.
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> errors_{std::fopen("/dev/null", "w"), std::fclose};
    qhT qhull_{};
    int code_ = 0;
};

template <class Point>
double hull_volume(std::span<const Point> points) {
    constexpr int dimension = Point::length();
    const auto same = [&](const Point& point) { return point == points.front(); };
    if (points.size() <= dimension || std::all_of(points.begin(), points.end(), same)) return 0;
    std::vector<double> coordinates;
    coordinates.reserve(points.size() * dimension);
    Point extent(0);
    for (const Point& point : points) {
        // Far from the origin a small plant would lose digits.
        const Point from_first = point - points.front();
        extent = glm::max(extent, glm::abs(from_first));
        for (int axis = 0; axis < dimension; ++axis) coordinates.push_back(from_first[axis]);
    }
    // What is flat but for errors of rounding is flat: an upright axis, or its shadow.
    constexpr double nothing = 1e-12;  // m
    for (int axis = 0; axis < dimension; ++axis) {
        if (extent[axis] < nothing) return 0;
    }
    return Hull(std::move(coordinates), dimension).volume();
}

}  // namespace

double convex_hull_area(std::span<const glm::dvec2> points) {
    return hull_volume(points);
}

double convex_hull_volume(std::span<const glm::dvec3> points) {
    return hull_volume(points);
}

}  // namespace espalier::analysis
