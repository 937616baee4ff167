// Which values a sweep gives to which keys of a scene.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace espalier::simulation {

/// Keys that change together, and the values of all of them in one run after the other.
struct Variation {
    std::vector<std::string> keys;
    std::vector<std::vector<std::string>> values;
};

/// "light.voxel=0.1:0.9:9": nine numbers from 0.1 to 0.9, evenly; "simulation.seed=1..10": whole numbers;
/// "light.mode=add,attenuate": these; "a,b=3:4,5:6": a and b are 3 and 4, then 5 and 6. Throws UserError for what is
/// none of them, and beyond a million values.
Variation parse_variation(const std::string& text);

/// One run of a sweep: a value for every key, and a name for its folder.
struct Variant {
    std::vector<std::pair<std::string, std::string>> values;
    std::string name;
};

/// Every combination, the last key varying fastest. Names are like "transmittance=0.1,seed=3": the last part of each
/// key, or all of it where two keys end alike. Throws UserError for a key given twice and beyond a million runs.
std::vector<Variant> combine(const std::vector<Variation>& variations);

}  // namespace espalier::simulation
