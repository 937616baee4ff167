// A tree of three orders of branching with crossed cards for leaves, made by hand.
#pragma once

#include "timeline/frames.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace espalier {

class SmallTree {
public:
    SmallTree() {
        grow({0, 0, 0}, {0, 1, 0}, 1.5, 0.06, 0);
        plant.number = 0;
    }

    HandmadePlant plant;
    std::size_t cards = 0;

private:
    static constexpr int pieces = 6, orders = 3;

    void grow(glm::dvec3 base, glm::dvec3 heading, double length, double radius, std::uint16_t order) {
        const std::uint32_t axis = plant.interpretation.geometry.axes;
        glm::dvec3 across = glm::normalize(glm::cross(heading, glm::dvec3(0.3, 0.2, 1)));
        std::vector<std::pair<glm::dvec3, glm::dvec3>> forks;
        for (int i = 0; i < pieces; ++i) {
            const glm::dvec3 tip = base + heading * (length / pieces);
            plant.add_internode(++identity_, 0, 0, axis, order, base, tip, 0);
            Internode& internode = plant.interpretation.geometry.internodes.back();
            internode.base_radius = radius * (1 - 0.12 * i);
            internode.tip_radius = radius * (1 - 0.12 * (i + 1));
            base = tip;
            heading = glm::normalize(heading + 0.08 * across);
            across = glm::normalize(std::cos(2.4) * across + std::sin(2.4) * glm::cross(heading, across));
            forks.emplace_back(base, glm::normalize(heading + 1.2 * across));
        }
        if (order + 1 == orders) add_cards(base, heading, across);
        for (std::size_t i = 1; order + 1 < orders && i < forks.size(); ++i) {
            grow(forks[i].first, forks[i].second, 0.5 * length, 0.45 * radius, static_cast<std::uint16_t>(order + 1));
        }
    }

    void add_cards(glm::dvec3 base, glm::dvec3 heading, glm::dvec3 across) {
        for (int card = 0; card < 2; ++card) {
            const std::uint32_t module = plant.add("P", {}, ++identity_, 0, 0);
            PlantGeometry& geometry = plant.interpretation.geometry;
            const auto first = static_cast<std::uint32_t>(geometry.vertices.size());
            const glm::dvec3 half = 0.03 * across, along = 0.08 * heading;
            for (const glm::dvec3& vertex : {base - half, base + half, base + half + along, base - half + along}) {
                geometry.vertices.push_back(vertex);
                geometry.bounds.add(vertex);
            }
            geometry.polygons.push_back({module, first, 4, 1, 5});
            across = glm::normalize(glm::cross(heading, across));
            ++cards;
        }
    }

    Identity identity_ = 100;
};

}  // namespace espalier
