// The point of a long polyline that is nearest to another.
#pragma once

#include "espalier/language/measured_plants.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace espalier::language::measured {

class NearestPoint {
public:
    struct Spot {
        std::size_t segment = 0;  ///< from this node to the next
        double share = 0;         ///< of the segment, 0 to 1
        double square = 0;        ///< of the distance
    };

    /// Keeps a reference to the nodes, of which there is one at least.
    explicit NearestPoint(const std::vector<MeasuredNode>& nodes);
    /// The first of the nearest ones.
    Spot to(const glm::dvec3& place) const;

    /// On one segment; the last node is a segment of its own.
    static Spot on_segment(const std::vector<MeasuredNode>& nodes, std::size_t segment, const glm::dvec3& place);

private:
    struct Box {
        glm::dvec3 lower, upper;
    };
    static constexpr std::size_t width = 8;  ///< of a box, in boxes of the level below or in segments

    void search(std::size_t level, std::size_t box, const glm::dvec3& place, Spot& best) const;

    const std::vector<MeasuredNode>& nodes_;
    std::vector<std::vector<Box>> levels_;  ///< of segments first; the last is one box
};

}  // namespace espalier::language::measured
