#include "base/part_help.h"
#include "base/text.h"
#include "language/weber_penn/species.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace espalier::language::weber_penn {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

const std::vector<Parameter>& of_tree() {
    static const std::vector<Parameter> all{
        {"Shape",
         "",
         0,
         8,
         true,
         "crown: 0 conical, 1 spherical, 2 hemispherical, 3 cylindrical, 4 tapered cylindrical, 5 flame, 6 inverse "
         "conical, 7 tend flame, 8 the envelope of pruning",
         {0}},
        {"BaseSize", "", 0, 0.99, false, "share of the height without branches", {0.25}},
        {"Scale", "m", 1e-3, unbounded, false, "size of the tree", {10}},
        {"ScaleV", "m", 0, unbounded, false, "varies Scale", {0}},
        {"ZScale", "", 1e-3, unbounded, false, "stretches the trunk, not its thickness", {1}},
        {"ZScaleV", "", 0, unbounded, false, "varies ZScale", {0}},
        {"Levels", "", 1, 9, true, "number of levels of stems, with the trunk", {3}},
        {"Ratio", "", 0, unbounded, false, "radius of the trunk by its length", {0.015}},
        {"RatioPower", "", 0, unbounded, false, "a stem's radius falls with this power of its length", {1.2}},
        {"Lobes", "", 0, 64, true, "number of lobes around the trunk", {0}},
        {"LobeDepth", "", 0, 0.9, false, "depth of the lobes, by the radius of the trunk", {0}},
        {"Flare", "", 0, unbounded, false, "by how many radii the foot is thicker", {0}},
        {"Leaves",
         "",
         -1000,
         100000,
         true,
         "number of leaves on a stem of the last level; negative: as a fan at its end",
         {0}},
        {"LeafShape",
         "",
         0,
         5,
         true,
         "0 oval, 1 triangle, 2 oak of three lobes, 3 maple of three, 4 maple of five, 5 three leaflets",
         {0}},
        {"LeafScale", "m", 1e-6, unbounded, false, "length of a leaf", {0.15}},
        {"LeafScaleX", "", 1e-3, unbounded, false, "width of a leaf by its length", {0.6}},
        {"LeafBend", "", 0, 1, false, "how far leaves turn outwards and up to the light (LeafOrient is the same)", {0}},
        {"LeafStemLen", "", 0, 100, false, "length of the stalk of a leaf, by LeafScale", {0}},
        {"LeafDistrib",
         "",
         0,
         7,
         true,
         "which shape, of those of Shape, the number of leaves follows from the base to the tip of the parent's parent",
         {4}},
        {"LeafQuality", "", 0.001, 1, false, "share of the leaves that are drawn, each the larger", {1}},
        {"AttractionUp",
         "",
         -unbounded,
         unbounded,
         false,
         "how strongly stems of level 2 and deeper turn upwards; negative: downwards",
         {0}},
        {"PruneRatio", "", 0, 1, false, "how far stems outside the envelope are shortened", {0}},
        {"PruneWidth", "", 1e-3, unbounded, false, "greatest radius of the envelope, by Scale", {0.5}},
        {"PruneWidthPeak",
         "",
         0.001,
         0.999,
         false,
         "height of the greatest radius of the envelope, from base to top of the crown",
         {0.5}},
        {"PrunePowerLow", "", 1e-6, unbounded, false, "form of the envelope below its greatest radius", {0.5}},
        {"PrunePowerHigh", "", 1e-6, unbounded, false, "form of the envelope above its greatest radius", {0.5}},
        {"BarkColour", "", 0, 255, true, "index of the bark in the colour map (not of the paper)", {120}},
        {"LeafColour", "", 0, 255, true, "index of leaves in the colour map (not of the paper)", {40}},
    };
    return all;
}

const std::vector<Parameter>& of_levels() {
    static const std::vector<Parameter> all{
        {"Scale", "", 1e-3, unbounded, false, "factor of a stem's radius", {1, 1, 1, 1}, 0},
        {"ScaleV", "", 0, unbounded, false, "varies 0Scale", {0}, 0},
        {"BaseSize", "", 0, 0.99, false, "share of a stem's length without children", {0, 0, 0}, 1},
        {"BaseSplits",
         "",
         -100,
         100,
         true,
         "clones at the end of the trunk's first segment; negative: at random, from 0 to that many",
         {0},
         0},
        {"DownAngle", "degrees", -360, 360, false, "angle of a child with its parent", {60, 45, 45}, 1},
        {"DownAngleV",
         "degrees",
         -360,
         360,
         false,
         "varies nDownAngle; negative: along the parent, more at its base than at its tip",
         {0, 0, 0},
         1},
        {"Rotate",
         "degrees",
         -360,
         360,
         false,
         "turn about the parent, from child to child; negative: children stand left and right at 180 + nRotate",
         {140, 140, 140},
         1},
        {"RotateV", "degrees", 0, 360, false, "varies nRotate", {0, 0, 0}, 1},
        {"Branches", "", 0, 100000, false, "children of a stem at most", {30, 20, 10}, 1},
        {"BranchDist",
         "",
         0,
         1,
         false,
         "where children stand on a segment of their parent, from 0, all at its base, to 1, spread over it",
         {1, 1, 1},
         1},
        {"Length",
         "",
         0,
         unbounded,
         false,
         "length of the trunk by Scale; of stems of deeper levels by that of the parent",
         {1, 0.3, 0.5, 0.3},
         0},
        {"LengthV", "", 0, unbounded, false, "varies nLength", {0, 0, 0, 0}, 0},
        {"Taper",
         "",
         0,
         3,
         false,
         "0 a cylinder, 1 a cone, 2 a cylinder with a round end, 3 a chain of spheres, and between",
         {1, 1, 1, 1},
         0},
        {"SegSplits",
         "",
         -100,
         100,
         false,
         "clones at the end of a segment; negative: at random, from 0 to that many",
         {0, 0, 0, 0},
         0},
        {"SplitAngle",
         "degrees",
         0,
         180,
         false,
         "angle of a clone with its stem, if that is vertical",
         {0, 0, 0, 0},
         0},
        {"SplitAngleV", "degrees", 0, 180, false, "varies nSplitAngle", {0, 0, 0, 0}, 0},
        {"CurveRes", "", 1, 1000, true, "segments of a stem", {5, 5, 3, 1}, 0},
        {"Curve",
         "degrees",
         -unbounded,
         unbounded,
         false,
         "angle by which a stem bends from base to tip",
         {0, 0, 0, 0},
         0},
        {"CurveBack",
         "degrees",
         -unbounded,
         unbounded,
         false,
         "not 0: angle by which the second half of a stem bends, and nCurve is that of the first",
         {0, 0, 0, 0},
         0},
        {"CurveV",
         "degrees",
         -360,
         unbounded,
         false,
         "varies the bend; negative: the stem is a helix with this angle to its axis",
         {0, 0, 0, 0},
         0},
        {"BendV", "degrees", 0, unbounded, false, "how far a stem bends to its sides, at random", {0, 0, 0, 0}, 0},
    };
    return all;
}

const Parameter& parameter_called(const std::string& name, bool has_levels) {
    const auto& list = parameters();
    return *std::find_if(list.begin(), list.end(),
                         [&](const Parameter& each) { return each.name == name && each.has_levels() == has_levels; });
}

}  // namespace

const std::vector<Parameter>& parameters() {
    static const std::vector<Parameter> all = [] {
        std::vector<Parameter> joined = of_tree();
        joined.insert(joined.end(), of_levels().begin(), of_levels().end());
        return joined;
    }();
    return all;
}

std::string written_name(const Parameter& parameter, int level) {
    return parameter.has_levels() ? std::to_string(level) + parameter.name : parameter.name;
}

std::string setting_name(const Parameter& parameter, int level) {
    return parameter.has_levels() ? fmt::format("{}_{}", parameter.name, level) : parameter.name;
}

std::string describe_parameters() {
    std::string text;
    for (const Parameter& each : parameters()) {
        std::vector<std::string> standard;
        for (const double value : each.standard) standard.push_back(format_general(value));
        const std::string name = each.has_levels() ? (each.standard.size() == 1 ? "0" : "n") + each.name : each.name;
        text += fmt::format("  {:15} {}{}{}{}; {}\n", name + " ",
                            standard.size() == 1 ? standard[0] : fmt::format("[{}]", fmt::join(standard, ", ")),
                            each.unit.empty() ? "" : " ", each.unit, described_range(each.lowest, each.highest),
                            each.summary);
    }
    return text;
}

double Species::standard(const std::string& name, int level) const {
    const Parameter& parameter = parameter_called(name, level >= 0);
    const int place = parameter.has_levels() ? std::min(level, highest_described_level) - parameter.first_level : 0;
    return parameter.standard.at(static_cast<std::size_t>(place));
}

double Species::value(const std::string& name, int level) const {
    const Parameter& parameter = parameter_called(name, level >= 0);
    const int described = std::min(level, highest_described_level);
    const auto found = values_.find(written_name(parameter, described));
    return found != values_.end() ? found->second : standard(name, level);
}

std::optional<Location> Species::place(const std::string& written) const {
    const auto found = places_.find(written);
    return found == places_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<Location> Species::place_of_level(int level) const {
    std::optional<Location> first, first_of_level;
    const auto keep = [](std::optional<Location>& kept, Location at) { kept = kept ? std::min(*kept, at) : at; };
    for (const auto& [name, at] : places_) {
        keep(first, at);
        if (name.front() == '0' + std::min(level, highest_described_level)) keep(first_of_level, at);
    }
    return first_of_level ? first_of_level : first;
}

}  // namespace espalier::language::weber_penn
