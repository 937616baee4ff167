// The cellular automata of Ulam and their published variants, by their definitions on the square lattice.
#pragma once

#include <array>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace espalier {

struct UlamRule {
    std::string excluding = "simple";  ///< candidates at corners that exclude: as the process `ulam` names its rules
    bool all_ask = false;              ///< all living cells propose, not only those born last
    bool cells_exclude = true;         ///< living cells at corners exclude, unless the rule is simple
};

class UlamAutomaton {
public:
    using Site = std::pair<int, int>;

    explicit UlamAutomaton(UlamRule rule) : rule_(std::move(rule)) {}

    /// The number of living cells after 0, 1, ... steps.
    std::vector<int> cells(int steps) {
        std::vector<int> counts{1};
        for (int step = 0; step < steps; ++step) {
            grow();
            counts.push_back(static_cast<int>(living_.size()));
        }
        return counts;
    }

private:
    static std::array<Site, 4> edges(const Site& at) {
        const auto [x, y] = at;
        return {{{x + 1, y}, {x, y + 1}, {x - 1, y}, {x, y - 1}}};
    }

    // Whether one of the cells touches a corner of the place, other than those beside its parent.
    static bool touches(const Site& place, const Site& parent, const std::set<Site>& cells) {
        for (const int x : {-1, 1}) {
            for (const int y : {-1, 1}) {
                const Site corner{place.first + x, place.second + y};
                const int apart = std::abs(corner.first - parent.first) + std::abs(corner.second - parent.second);
                if (apart != 1 && cells.count(corner)) return true;
            }
        }
        return false;
    }

    void grow() {
        std::set<Site> candidates, eligible, free, born;
        std::map<Site, Site> parent;
        for (const Site& cell : rule_.all_ask ? living_ : born_) {
            for (const Site& place : edges(cell)) {
                if (!living_.count(place)) candidates.insert(place);
            }
        }
        for (const Site& place : candidates) {
            int neighbours = 0;
            for (const Site& cell : edges(place)) {
                if (!living_.count(cell)) continue;
                ++neighbours;
                parent[place] = cell;
            }
            if (neighbours == 1) eligible.insert(place);
        }
        const bool simple = rule_.excluding == "simple";
        for (const Site& place : eligible) {
            if (simple || !rule_.cells_exclude || !touches(place, parent[place], living_)) free.insert(place);
        }
        const std::set<Site> none;
        const std::set<Site>& rivals = simple                          ? none
                                       : rule_.excluding == "births"   ? free
                                       : rule_.excluding == "eligible" ? eligible
                                                                       : candidates;
        for (const Site& place : free) {
            if (!touches(place, parent[place], rivals)) born.insert(place);
        }
        living_.insert(born.begin(), born.end());
        born_ = std::move(born);
    }

    UlamRule rule_;
    std::set<Site> living_{{0, 0}}, born_{{0, 0}};
};

}  // namespace espalier
