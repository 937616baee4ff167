// The parameters of a species as the settings of its model.
#include "base/text.h"
#include "language/weber_penn/translated_species.h"

#include <fmt/format.h>

#include <cmath>

namespace espalier::language::weber_penn {
namespace {

/// Parameters that choose productions are no settings of the model.
bool is_built_in(const std::string& name) {
    return name == "Shape" || name == "Levels" || name == "Lobes" || name == "LobeDepth" || name == "LeafShape" ||
           name == "LeafScaleX" || name == "Leaves" || name == "LeafDistrib" || name == "LeafQuality";
}

/// Parameters that few species have: without them the model is as short as the paper's.
bool is_seldom_set(const std::string& name, int level) {
    return name == "BendV" || name == "BranchDist" || name == "LeafBend" || name == "LeafStemLen" ||
           (level > 0 && (name == "Scale" || name == "BaseSize"));
}

bool matters(const TranslatedSpecies& species, const Parameter& parameter, int level) {
    const std::string& name = parameter.name;
    if (is_built_in(name)) return false;
    if (is_seldom_set(name, level) && !species.sets(name, level)) return false;
    if (name.starts_with("Leaf") && species.value("Leaves") == 0) return false;
    if (name.starts_with("Prune")) return species.prunes() || species.value("Shape") == 8;
    const bool is_of_children = name == "Branches" || name == "BranchDist" || name == "DownAngle" ||
                                name == "DownAngleV" || name == "Rotate" || name == "RotateV";
    const bool is_of_leaves = is_of_children && name != "Branches" && level == species.described(species.levels());
    return level < species.levels() || (is_of_leaves && species.value("Leaves") != 0);
}

std::string setting(const TranslatedSpecies& species, const Parameter& parameter, int level) {
    const double number = level < 0 ? species.value(parameter.name) : species.value(parameter.name, level);
    double lowest = parameter.lowest, highest = parameter.highest;
    // The sign chooses productions, so it stays.
    if (parameter.name == "CurveV" || parameter.name == "DownAngleV" || parameter.name == "Rotate" ||
        parameter.name == "BaseSplits" || parameter.name == "SegSplits") {
        (number < 0 ? highest : lowest) = 0;
    }
    if (parameter.name == "Taper") {
        lowest = number <= 1 ? 0 : number <= 2 ? 1 : 2;
        highest = lowest + 1;
    }
    const auto bound = [](double limit) { return std::isfinite(limit) ? format_exact(limit) : std::string(); };
    std::string comment = parameter.summary.substr(0, parameter.summary.find(';'));
    std::string range = bound(lowest) + ".." + bound(highest);
    if (range == "..") range = "-1e9..1e9";
    if (parameter.is_whole) range += " whole";
    const std::string line =
        fmt::format("#define {} {}  /* {}; {}{} */\n", setting_name(parameter, level), format_exact(number), comment,
                    range, parameter.unit.empty() ? "" : "; " + parameter.unit);
    return placed(line, species.species().place(written_name(parameter, level)));
}

}  // namespace

std::string settings(const TranslatedSpecies& species) {
    std::string text;
    for (const Parameter& parameter : parameters()) {
        for (int k = 0; k < static_cast<int>(parameter.standard.size()); ++k) {
            const int level = parameter.has_levels() ? parameter.first_level + k : -1;
            if (matters(species, parameter, level)) text += setting(species, parameter, level);
        }
    }
    text += fmt::format("#define LEVELS {0}  /* levels of stems that are drawn; 1..{0} whole */\n", species.levels());
    if (species.value("Leaves") != 0) {
        const std::string line = fmt::format("#define Leaves {}  /* on a stem of the last level; 0..100000 whole */\n",
                                             format_exact(std::abs(species.value("Leaves"))));
        text += placed(line, species.species().place("Leaves"));
        const std::string quality =
            fmt::format("#define QUALITY {}  /* share of the leaves that are drawn, each the larger; 0.001..1 */\n",
                        format_exact(species.value("LeafQuality")));
        text += placed(quality, species.species().place("LeafQuality"));
    }
    return text;
}

}  // namespace espalier::language::weber_penn
