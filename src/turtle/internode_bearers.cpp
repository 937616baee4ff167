#include "turtle/internode_bearers.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace espalier::turtle {
namespace {

/// Among one module's internodes, from `first` on, the last whose tip is the base of the internode `at`; else `last`.
std::uint32_t bearer_in_picture(const PlantGeometry& geometry, std::uint32_t first, std::uint32_t at,
                                std::uint32_t last) {
    const glm::dvec3& base = geometry.internodes[at].base;
    for (std::uint32_t i = at; i-- > first;) {
        if (geometry.internodes[i].tip == base) return i;
    }
    return last;
}

double distance_to(const Internode& internode, const glm::dvec3& place) {
    const glm::dvec3 along = internode.tip - internode.base, here = place - internode.base;
    const double square = glm::dot(along, along);
    const double share = square > 0 ? std::clamp(glm::dot(here, along) / square, 0.0, 1.0) : 0.0;
    return glm::length(here - share * along);
}

/// Calls visit_internode(internode, bearer) and visit_module(module, last) in the string's order; `last` is the last
/// internode on the branch, those of the module included.
template <class VisitInternode, class VisitModule>
void walk_branches(const PlantGeometry& geometry, const ModuleString& string, const VisitInternode& visit_internode,
                   const VisitModule& visit_module) {
    const Column<Internode>& internodes = geometry.internodes;
    std::vector<std::uint32_t> branches;
    std::uint32_t last = no_bearer, next = 0;
    for (std::uint32_t module = 0; module < string.size(); ++module) {
        const std::uint32_t first = next, before = last;
        for (; next < internodes.size() && internodes[next].module == module; ++next) {
            visit_internode(next, next == first ? before : bearer_in_picture(geometry, first, next, before));
            last = next;
        }
        // A bracket has a picture only where a stage drew for it what bears the branch.
        if (string.letters[module] == Alphabet::open_bracket) {
            branches.push_back(last);
        } else if (string.letters[module] == Alphabet::close_bracket && !branches.empty()) {
            last = branches.back();
            branches.pop_back();
        }
        visit_module(module, last);
    }
}

}  // namespace

std::vector<std::uint32_t> internode_bearers(const PlantGeometry& geometry, const ModuleString& string) {
    std::vector<std::uint32_t> bearers(geometry.internodes.size(), no_bearer);
    walk_branches(
        geometry, string, [&](std::uint32_t internode, std::uint32_t bearer) { bearers[internode] = bearer; },
        [](std::uint32_t, std::uint32_t) {});
    return bearers;
}

OrganBearers::OrganBearers(const PlantGeometry& geometry, const ModuleString& string)
    : geometry_(geometry), last_(string.size(), no_bearer) {
    walk_branches(
        geometry, string, [](std::uint32_t, std::uint32_t) {},
        [&](std::uint32_t module, std::uint32_t last) { last_[module] = last; });
}

std::uint32_t OrganBearers::of(std::uint32_t module, const glm::dvec3& place) const {
    std::uint32_t nearest = last_[module];
    if (nearest == no_bearer) return no_bearer;
    const auto is_own = [&](std::uint32_t internode) { return geometry_.internodes[internode].module == module; };
    for (std::uint32_t i = nearest; i-- > 0 && is_own(i) && is_own(nearest);) {
        // Where two meet there, the first ends there.
        if (distance_to(geometry_.internodes[i], place) <= distance_to(geometry_.internodes[nearest], place))
            nearest = i;
    }
    return nearest;
}

}  // namespace espalier::turtle
