// The outline of a mesh as pixels, to compare what two meshes look like from afar.
#pragma once

#include "formats/obj_file.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace espalier {

class Silhouette {
public:
    /// Seen along the axis that is neither `right` nor `up`, in a square of so many metres around a middle.
    Silhouette(const ObjFile& mesh, int right, int up, const glm::dvec3& middle, double metres)
        : filled_(pixels * pixels, false) {
        const auto place = [&](std::size_t vertex) {
            const glm::dvec3 off = (mesh.points[vertex] - middle) / metres + 0.5;
            return glm::dvec2(off[right], off[up]) * double(pixels);
        };
        for (const ObjFile::Face& face : mesh.faces) {
            fill(place(face.points[0]), place(face.points[1]), place(face.points[2]));
        }
    }

    /// Pixels that both have by those that one of them has.
    double overlap(const Silhouette& other) const {
        int both = 0, any = 0;
        for (std::size_t i = 0; i < filled_.size(); ++i) {
            both += filled_[i] && other.filled_[i];
            any += filled_[i] || other.filled_[i];
        }
        return any > 0 ? double(both) / any : 1;
    }

private:
    static constexpr int pixels = 384;

    void fill(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
        const auto side = [](const glm::dvec2& p, const glm::dvec2& q, const glm::dvec2& x) {
            return (q.x - p.x) * (x.y - p.y) - (q.y - p.y) * (x.x - p.x);
        };
        const auto bound = [](double value) { return std::clamp(static_cast<int>(value), 0, pixels - 1); };
        const glm::dvec2 lower = glm::min(glm::min(a, b), c), upper = glm::max(glm::max(a, b), c);
        for (int y = bound(lower.y); y <= bound(upper.y); ++y) {
            for (int x = bound(lower.x); x <= bound(upper.x); ++x) {
                const glm::dvec2 centre(x + 0.5, y + 0.5);
                const double u = side(a, b, centre), v = side(b, c, centre), w = side(c, a, centre);
                if ((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)) {
                    filled_[static_cast<std::size_t>(y * pixels + x)] = true;
                }
            }
        }
    }

    std::vector<bool> filled_;
};

}  // namespace espalier
