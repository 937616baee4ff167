#include "geometry/internode_bearers.h"

namespace espalier::geometry {
namespace {

/// Of the internodes of one module, from `first` on, the last whose tip is the base of the internode `at`; else `last`.
std::uint32_t bearer_in_picture(const PlantGeometry& geometry, std::uint32_t first, std::uint32_t at,
                                std::uint32_t last) {
    const glm::dvec3& base = geometry.internodes[at].base;
    for (std::uint32_t i = at; i-- > first;) {
        if (geometry.internodes[i].tip == base) return i;
    }
    return last;
}

}  // namespace

std::vector<std::uint32_t> internode_bearers(const PlantGeometry& geometry, const ModuleString& string) {
    const Column<Internode>& internodes = geometry.internodes;
    std::vector<std::uint32_t> bearers(internodes.size(), no_bearer), branches;
    std::uint32_t last = no_bearer, next = 0;
    for (std::uint32_t module = 0; module < string.size() && next < internodes.size(); ++module) {
        if (string.letters[module] == Alphabet::open_bracket) {
            branches.push_back(last);
        } else if (string.letters[module] == Alphabet::close_bracket && !branches.empty()) {
            last = branches.back();
            branches.pop_back();
        }
        const std::uint32_t first = next, before = last;
        for (; next < internodes.size() && internodes[next].module == module; ++next) {
            bearers[next] = next == first ? before : bearer_in_picture(geometry, first, next, before);
            last = next;
        }
    }
    return bearers;
}

}  // namespace espalier::geometry
