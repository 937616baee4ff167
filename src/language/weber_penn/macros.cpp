// Functions of a place on a stem, as macros: its radius, how it bends, and how often it splits.
#include "language/weber_penn/translated_species.h"

#include <fmt/format.h>

namespace espalier::language::weber_penn {
namespace {

std::string shape_ratio(int shape) {
    static const char* const formulas[]{
        "0.2 + 0.8 * (r)",
        "0.2 + 0.8 * sin(180 * (r))",
        "0.2 + 0.8 * sin(90 * (r))",
        "1",
        "0.5 + 0.5 * (r)",
        "(r) <= 0.7 ? (r) / 0.7 : (1 - (r)) / 0.3",
        "1 - 0.8 * (r)",
        "(r) <= 0.7 ? 0.5 + 0.5 * (r) / 0.7 : 0.5 + 0.5 * (1 - (r)) / 0.3",
        "ENVELOPE(r)",
    };
    return formulas[shape];
}

constexpr const char* envelope = R"(#define ENVELOPE(r) \
	((r) <= 0 || (r) >= 1 ? 0 : (r) < 1 - PruneWidthPeak ? ((r) / (1 - PruneWidthPeak)) ^ PrunePowerHigh : \
	((1 - (r)) / PruneWidthPeak) ^ PrunePowerLow)
)";

constexpr const char* inside = R"(#define INSIDE(x, y, z) (sqrt(((x) - foot_x) ^ 2 + ((z) - foot_z) ^ 2) <= \
	scale * PruneWidth * ENVELOPE((scale - (y) + foot_y) / (scale - base)))
)";

/// The radius at the part z of a stem of the given length.
std::string taper(const TranslatedSpecies& species, int level) {
    const double number = species.value("Taper", level);
    const std::string flare = level == 0 && species.value("Flare") > 0 ? " * FLARE(z)" : "";
    if (number <= 1) return "#define RADIUS_<n>(radius, length, z) ((radius) * (1 - Taper_<c> * (z))" + flare + ")\n";
    // At most a sphere's radius from the tip, or anywhere on a chain of spheres, the outline is a circle.
    const std::string cone = number <= 2 ? "((radius) * (1 - (2 - Taper_<c>) * (z)))" : "(radius)";
    const std::string round = number <= 2 ? "1" : "(TIP(length, z) < (radius) ? 1 : Taper_<c> - 2)";
    const std::string from_tip =
        number <= 2 ? "min(TIP(length, z), CONE_<n>(radius, z))"
                    : "abs(TIP(length, z) - 2 * (radius) * floor(TIP(length, z) / (2 * (radius)) + 0.5))";
    return "#define CONE_<n>(radius, z) " + cone + "\n#define ROUND_<n>(radius, length, z) " + round +
           "\n#define RADIUS_<n>(radius, length, z) (((1 - ROUND_<n>(radius, length, z)) * CONE_<n>(radius, z) + "
           "\\\n"
           "\tROUND_<n>(radius, length, z) * sqrt(max(0, CONE_<n>(radius, z) ^ 2 - (" +
           from_tip + " - CONE_<n>(radius, z)) ^ 2)))" + flare + ")\n";
}

std::string bend(const TranslatedSpecies& species, int level) {
    std::string text = "#define BEND_<n>(k, seed, back, hy, uy) (CURVE_<n>(k) + (back)";
    if (!species.is_helix(level)) text += " + KEPT_WITHIN(CurveV_<c> / CurveRes_<c>, seed, k)";
    if (level > 1) text += " + \\\n\tAttractionUp * acos(clamp(hy, -1, 1)) * (uy) / CurveRes_<c>";
    return text + ")\n";
}

std::string splits_macro(const TranslatedSpecies& species, int level) {
    const auto random = [](const std::string& most) { return "floor((1 - " + most + ") * KEPT(seed, (k) + 31))"; };
    std::string at_base;
    if (level == 0 && species.value("BaseSplits", 0) > 0) at_base = "(k) == 1 && BaseSplits_0 > 0 ? BaseSplits_0 : ";
    if (level == 0 && species.value("BaseSplits", 0) < 0) at_base = "(k) == 1 ? " + random("BaseSplits_0") + " : ";
    const std::string along =
        species.value("SegSplits", level) < 0
            ? random("SegSplits_<c>")
            : "floor(SegSplits_<c> * (k) + KEPT(seed, 0)) - floor(SegSplits_<c> * ((k) - 1) + KEPT(seed, 0))";
    return "#define CLONES_<n>(k, seed) (" + at_base + along + ")\n";
}

bool has_round_stems(const TranslatedSpecies& species) {
    for (int level = 0; level < species.levels(); ++level) {
        if (species.value("Taper", level) > 1) return true;
    }
    return false;
}

std::string macros_of_tree(const TranslatedSpecies& species) {
    std::string text =
        "\n/* how long branches are at each height; how many leaves stems bear; how thick the foot is */\n";
    if (species.prunes() || species.value("Shape") == 8) text += envelope;
    text += fmt::format("#define SHAPE(r) ({})\n", shape_ratio(static_cast<int>(species.value("Shape"))));
    text += "#define CONICAL(r) (0.2 + 0.8 * (r))\n";
    text += fmt::format("#define LEAVES_AT(r) ({})\n", shape_ratio(static_cast<int>(species.value("LeafDistrib"))));
    if (species.prunes()) text += inside;
    if (species.value("Flare") > 0) text += "#define FLARE(z) (1 + Flare * (100 ^ max(0, 1 - 8 * (z)) - 1) / 100)\n";
    if (has_round_stems(species)) text += "#define TIP(length, z) ((length) * (1 - (z)))\n";
    return text;
}

/// Pieces that a segment is drawn in, and the part of the segment below the i-th.
std::string pieces(const TranslatedSpecies& species, int level) {
    const double number = species.value("Taper", level);
    if (number > 2) return "#define PIECES_<n>(k) 12\n#define PART_<n>(i, k) ((i) / 12)\n";
    if (!species.has_pieces(level)) return "";
    const bool flares = level == 0 && species.value("Flare") > 0, is_round = number > 1;
    const std::string foot = flares ? "(k) == 0 ? 8 : " : "", tip = is_round ? "(k) == CurveRes_<c> - 1 ? 8 : " : "";
    const std::string at_foot = flares ? "(k) == 0 ? ((i) / 8) ^ 2 : " : "";
    const std::string at_tip = is_round ? "(k) == CurveRes_<c> - 1 ? 1 - (1 - (i) / 8) ^ 2 : " : "";
    return "#define PIECES_<n>(k) (" + foot + tip + "1)\n#define PART_<n>(i, k) (" + at_foot + at_tip + "(i))\n";
}

/// Where the j-th of the children stands on a stem.
std::string place_macro(const TranslatedSpecies& species, int level) {
    const std::string bare = level == 0 ? "bare" : species.sets("BaseSize", level) ? "BaseSize_<c>" : "";
    const std::string above = bare.empty() ? "" : bare + " + (1 - " + bare + ") * ";
    const std::string even = "(j, children) (" + above + "((j) + 0.5) / max(1, children))\n";
    if (!species.sets("BranchDist", level + 1)) return "#define PLACE_<n>" + even;
    return "#define EVEN_<n>" + even + "#define PLACE_<n>(j, children) max(" + (bare.empty() ? "0" : bare) +
           ", \\\n\t(floor(EVEN_<n>(j, children) * CurveRes_<c>) + \\\n"
           "\tBranchDist_<d> * FRACTION(EVEN_<n>(j, children) * CurveRes_<c>)) / CurveRes_<c>)\n";
}

std::string macros_of_level(const TranslatedSpecies& species, int level) {
    std::string text = "\n" + taper(species, level);
    text +=
        "#define CURVE_<n>(k) (CurveBack_<c> == 0 ? Curve_<c> / CurveRes_<c> : \\\n"
        "\t2 * ((k) < CurveRes_<c> / 2 ? Curve_<c> : CurveBack_<c>) / CurveRes_<c>)\n";
    text += bend(species, level);
    if (species.splits(level)) text += splits_macro(species, level);
    text += pieces(species, level);
    if (species.sets("BendV", level)) {
        text += "#define SIDE_<n>(k, seed) KEPT_WITHIN(BendV_<c> / CurveRes_<c>, seed, (k) + 53)\n";
    }
    return filled(text + place_macro(species, level), species.words(level));
}

}  // namespace

std::string macros(const TranslatedSpecies& species) {
    std::string text = macros_of_tree(species);
    for (int level = 0; level < species.levels(); ++level) text += macros_of_level(species, level);
    return text;
}

}  // namespace espalier::language::weber_penn
