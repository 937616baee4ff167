#include "language/weber_penn/translation.h"

#include "language/text/marks.h"
#include "language/weber_penn/translated_species.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

namespace espalier::language::weber_penn {
namespace {

constexpr const char* chance = R"(
/* a number from 0 to 1 that a stem keeps, and one from -v to v; a new one from -v to v */
#define FRACTION(x) ((x) - floor(x))
#define KEPT(seed, k) FRACTION(sin(57.3 * (seed) + 977.7 * (k)) * 43758.5453)
#define KEPT_WITHIN(v, seed, k) ((v) * (2 * KEPT(seed, k) - 1))
#define WITHIN(v) (ran(2 * (v)) - (v))
)";

std::string declarations(const TranslatedSpecies& species) {
    std::string text;
    for (int level = 0; level < species.levels(); ++level) {
        text += filled("module Bud<n>(length, radius, children), Stem<n>(<stem>), Node<n>(<stem>);\n",
                       species.words(level));
        text += filled("module Wood<n>(k, segment, radius)", species.words(level));
        if (species.has_pieces(level)) text += filled(", Piece<n>(i, k, segment, radius)", species.words(level));
        if (species.splits(level))
            text += filled(", Fork<n>(i, clones, <frame><at>, <stem>), Split<n>(i, clones, <frame><at>, <stem>)",
                           species.words(level));
        text += ";\n";
    }
    if (species.value("Leaves") != 0) text += "module Leaf;\n";
    if (species.bends_leaves()) text += "module LeafBud, Foot;\n";
    if (species.has_fans()) text += "module Fan(i, leaves);\n";
    return text;
}

/// Each level ends as many steps after the one below as its stems have segments; pruned stems wait for an answer.
std::string length(const TranslatedSpecies& species) {
    std::string sum = "CurveRes_0";
    for (int level = 1; level < species.levels(); ++level)
        sum += fmt::format(" + CurveRes_{}", species.described(level));
    const int less = (species.prunes() ? 0 : species.levels() - 1) - (species.bends_leaves() ? 1 : 0);
    return less == 0 ? sum : fmt::format("{} {} {}", sum, less > 0 ? "-" : "+", std::abs(less));
}

std::string start(const TranslatedSpecies& species) {
    std::string text =
        "\tscale = Scale + WITHIN(ScaleV);\n\tbase = BaseSize * scale;\n"
        "\ttrunk_length = (Length_0 + WITHIN(LengthV_0)) * scale * (ZScale + WITHIN(ZScaleV));\n"
        "\ttrunk_radius = trunk_length * Ratio * (Scale_0 + WITHIN(ScaleV_0));\n"
        "\tbare = min(base / max(trunk_length, 1e-9), 0.99);\n";
    if (species.prunes() || species.bends_leaves()) text += "\tfoot_x = 0;\n\tfoot_y = 0;\n\tfoot_z = 0;\n";
    return text;
}

std::string axiom(const TranslatedSpecies& species) {
    const std::string children = !species.is_last(0)            ? "round(Branches_1)"
                                 : species.value("Leaves") == 0 ? "0"
                                                                : "round(Leaves * QUALITY)";
    return fmt::format("/(ran(360)) {}Bud0(trunk_length, trunk_radius, {}){}",
                       species.prunes() ? "?P(0, 0, 0) ?H(0, 0, 0) ?U(0, 0, 0) " : "", children,
                       species.bends_leaves() ? " ?P(0, 0, 0) Foot" : "");
}

std::string leaf_drawing(const TranslatedSpecies& species) {
    if (species.value("Leaves") == 0) return "";
    return "Leaf --> ;(LeafColour) " + leaf_polygons(species.species(), "LeafScale / sqrt(QUALITY)") + "\n";
}

/// The rules of all levels, each marked with the place where the file sets the first of its parameters.
Rules rules_of(const TranslatedSpecies& species) {
    Rules all;
    for (int level = 0; level < species.levels(); ++level) {
        Rules rules;
        add_growth(species, level, rules);
        add_drawing(species, level, rules);
        const std::string title = fmt::format("\n/* level {} */\n", level);
        const std::optional<Location> at = species.species().place_of_level(level);
        all.productions += title + placed(rules.productions, at);
        all.decomposition += title + placed(rules.decomposition, at);
        all.drawing += placed(rules.drawing, at);
    }
    if (species.bends_leaves()) {
        const std::string turns =
            "\n/* where the tree stands, and how leaves turn */\n"
            "?P(x, y, z) Foot : {foot_x = x; foot_y = y; foot_z = z;} 1 --> *\n" +
            leaf_turns();
        all.productions += placed(turns, species.species().place("LeafBend"));
    }
    return all;
}

std::string text_of(const TranslatedSpecies& species, const std::string& file) {
    const Rules rules = rules_of(species);
    const std::optional<Location> tree = species.species().place_of_level(0);
    std::string text = fmt::format(
        "/* Translated from {}, a species after Weber & Penn 1995.\n"
        "   Bud: a stem to be; Stem: its tip, which asks for its heading; Wood: a segment. Numbers are levels. "
        "*/\n",
        file);
    text += settings(species) + chance + macros(species) + "\n" + declarations(species);
    text += fmt::format("\nlsystem: 1\nderivation length: {}\nStart: {{\n{}}}\naxiom: {}\n{}", length(species),
                        placed(start(species), tree), placed(axiom(species), tree), rules.productions);
    text += fmt::format("\ndecomposition\nmaximum depth: 100100\n{}\nhomomorphism\nmaximum depth: 1100\n{}",
                        rules.decomposition, rules.drawing + leaf_drawing(species));
    return text + "endlsystem\n";
}

}  // namespace

TranslatedText model_of(const Species& species, const std::string& file) {
    const std::string name = std::filesystem::path(file).filename().string();
    TranslatedText translated = unmarked(text_of(TranslatedSpecies(species), name), {file});
    translated.warnings = species.warnings;
    return translated;
}

}  // namespace espalier::language::weber_penn
