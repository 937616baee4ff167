#include "language/weber_penn/translation.h"

#include "base/text.h"
#include "language/marks.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

namespace espalier::language::weber_penn {
namespace {

using Words = std::map<std::string, std::string>;

/// The text with the word for each <name>; words may have names in them.
std::string filled(std::string text, const Words& words) {
    for (const auto& [name, word] : words) {
        const std::string mark = "<" + name + ">";
        for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at)) {
            text.replace(at, mark.size(), word);
        }
    }
    return text;
}

constexpr const char* chance = R"(
/* a number from 0 to 1 that a stem keeps, and one from -v to v; a new one from -v to v */
#define FRACTION(x) ((x) - floor(x))
#define KEPT(seed, k) FRACTION(sin(57.3 * (seed) + 977.7 * (k)) * 43758.5453)
#define KEPT_WITHIN(v, seed, k) ((v) * (2 * KEPT(seed, k) - 1))
#define WITHIN(v) (ran(2 * (v)) - (v))
)";

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

// Parameters of a stem: the next segment and child, how many children it leaves to its clones from one to the next (and
// itself), the turn of that child about the stem, the length of a segment, the
// radius at the base, the number of children, the seed of its chance, and what each segment bends back after splits.
constexpr const char* stem = "k, j, stride, turn, segment, radius, children, seed, back";
constexpr const char* frame = "hx, hy, hz, ux, uy, uz";

class Translation {
public:
    Translation(const Species& species, std::string file) : species_(species), file_(std::move(file)) {
        for (int level = 0; level < species.levels(); ++level) {
            write_macros(level);
            write_level(level);
        }
    }

    std::string text() const {
        std::string text = fmt::format(
            "/* Translated from {}, a species after Weber & Penn 1995.\n"
            "   Bud: a stem to be; Stem: its tip, which asks for its heading; Wood: a segment. Numbers are levels. "
            "*/\n",
            file_);
        text += settings() + chance + macros_ + "\n" + declarations();
        text += fmt::format("\nlsystem: 1\nderivation length: {}\nStart: {{\n{}}}\naxiom: {}\n{}", length(),
                            placed(start(), species_.place_of_level(0)), placed(axiom(), species_.place_of_level(0)),
                            productions_);
        text += fmt::format("\ndecomposition\nmaximum depth: 100100\n{}\nhomomorphism\nmaximum depth: 1100\n{}",
                            decomposition_, drawing_ + leaf_drawing());
        return text + "endlsystem\n";
    }

private:
    // --- what differs between species -------------------------------------------------------------------------------

    double value(const std::string& name, int level = -1) const { return species_.value(name, level); }
    bool is_helix(int level) const { return value("CurveV", level) < 0; }
    bool splits(int level) const { return value("SegSplits", level) > 0 || (level == 0 && value("BaseSplits", 0) > 0); }
    bool has_lobes() const { return value("Lobes") > 0 && value("LobeDepth") > 0; }
    bool has_fans() const { return value("Leaves") < 0; }
    bool is_last(int level) const { return level + 1 == species_.levels(); }
    static int described(int level) { return std::min(level, highest_described_level); }

    static std::string placed(const std::string& text, const std::optional<Location>& at) {
        return at ? marked(text, *at) : text;
    }

    // --- settings ---------------------------------------------------------------------------------------------------

    /// Parameters that choose productions are no settings of the model.
    static bool is_built_in(const std::string& name) {
        return name == "Shape" || name == "Levels" || name == "Lobes" || name == "LobeDepth" || name == "LeafShape" ||
               name == "LeafScaleX" || name == "Leaves";
    }

    bool matters(const Parameter& parameter, int level) const {
        const std::string& name = parameter.name;
        if (is_built_in(name)) return false;
        if (name.starts_with("Prune")) return species_.prunes() || value("Shape") == 8;
        const bool is_of_children =
            name == "Branches" || name == "DownAngle" || name == "DownAngleV" || name == "Rotate" || name == "RotateV";
        const bool is_of_leaves = is_of_children && name != "Branches" && level == described(species_.levels());
        return level < species_.levels() || (is_of_leaves && value("Leaves") != 0);
    }

    std::string settings() const {
        std::string text;
        for (const Parameter& parameter : parameters()) {
            for (int k = 0; k < static_cast<int>(parameter.standard.size()); ++k) {
                const int level = parameter.has_levels() ? parameter.first_level + k : -1;
                if (matters(parameter, level)) text += setting(parameter, level);
            }
        }
        text +=
            fmt::format("#define LEVELS {0}  /* levels of stems that are drawn; 1..{0} whole */\n", species_.levels());
        if (value("Leaves") != 0) {
            const std::string line =
                fmt::format("#define Leaves {}  /* on a stem of the last level; 0..100000 whole */\n",
                            format_exact(std::abs(value("Leaves"))));
            text += placed(line, species_.place("Leaves"));
            text += "#define QUALITY 1  /* share of the leaves that are drawn, each the larger; 0.001..1 */\n";
        }
        return text;
    }

    std::string setting(const Parameter& parameter, int level) const {
        const double number = level < 0 ? value(parameter.name) : value(parameter.name, level);
        double lowest = parameter.lowest, highest = parameter.highest;
        // The sign chooses productions, so it stays.
        if (parameter.name == "CurveV" || parameter.name == "DownAngleV" || parameter.name == "Rotate") {
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
            fmt::format("#define {} {}  /* {}; {}{} */\n", setting_name(parameter, level), format_exact(number),
                        comment, range, parameter.unit.empty() ? "" : "; " + parameter.unit);
        return placed(line, species_.place(written_name(parameter, level)));
    }

    // --- macros -----------------------------------------------------------------------------------------------------

    Words words(int level) const {
        const int child = level + 1;
        return {{"n", std::to_string(level)},
                {"m", std::to_string(child)},
                {"c", std::to_string(described(level))},
                {"d", std::to_string(described(child))},
                {"stem", stem},
                {"frame", frame},
                {"P", species_.prunes() ? "?P(x, y, z) " : ""},
                {"at", species_.prunes() ? ", x, y, z" : ""},
                {"ask", species_.prunes() ? "?P(0, 0, 0) ?H(0, 0, 0) ?U(0, 0, 0) " : "?H(0, 0, 0) ?U(0, 0, 0) "}};
    }

    /// The radius at the part z of a stem of the given length.
    std::string taper(int level) const {
        const double number = value("Taper", level);
        const std::string flare = level == 0 && value("Flare") > 0 ? " * FLARE(z)" : "";
        if (number <= 1)
            return "#define RADIUS_<n>(radius, length, z) ((radius) * (1 - Taper_<c> * (z))" + flare + ")\n";
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

    std::string bend(int level) const {
        std::string text = "#define BEND_<n>(k, seed, back, hy, uy) (CURVE_<n>(k) + (back)";
        if (!is_helix(level)) text += " + KEPT_WITHIN(CurveV_<c> / CurveRes_<c>, seed, k)";
        if (level > 1) text += " + \\\n\tAttractionUp * acos(clamp(hy, -1, 1)) * (uy) / CurveRes_<c>";
        return text + ")\n";
    }

    std::string splits_macro(int level) const {
        const std::string at_base = level == 0 ? "(k) == 1 && BaseSplits_0 > 0 ? BaseSplits_0 : " : "";
        return "#define CLONES_<n>(k, seed) (" + at_base +
               "floor(SegSplits_<c> * (k) + KEPT(seed, 0)) - floor(SegSplits_<c> * ((k) - 1) + KEPT(seed, 0)))\n";
    }

    void write_macros(int level) {
        if (level == 0) macros_ += macros_of_tree();
        std::string text = "\n" + taper(level);
        text +=
            "#define CURVE_<n>(k) (CurveBack_<c> == 0 ? Curve_<c> / CurveRes_<c> : \\\n"
            "\t2 * ((k) < CurveRes_<c> / 2 ? Curve_<c> : CurveBack_<c>) / CurveRes_<c>)\n";
        text += bend(level);
        if (splits(level)) text += splits_macro(level);
        text += pieces(level);
        const std::string above = level == 0 ? "bare + (1 - bare) * " : "";
        text += "#define PLACE_<n>(j, children) (" + above + "((j) + 0.5) / max(1, children))\n";
        macros_ += filled(text, words(level));
    }

    std::string macros_of_tree() const {
        std::string text =
            "\n/* how long branches are at each height; how many leaves stems bear; how thick the foot is */\n";
        if (species_.prunes() || value("Shape") == 8) text += envelope;
        text += fmt::format("#define SHAPE(r) ({})\n", shape_ratio(static_cast<int>(value("Shape"))));
        text += "#define CONICAL(r) (0.2 + 0.8 * (r))\n#define TAPERED(r) (0.5 + 0.5 * (r))\n";
        if (species_.prunes()) text += inside;
        if (value("Flare") > 0) text += "#define FLARE(z) (1 + Flare * (100 ^ max(0, 1 - 8 * (z)) - 1) / 100)\n";
        if (has_round_stems()) text += "#define TIP(length, z) ((length) * (1 - (z)))\n";
        return text;
    }

    bool has_round_stems() const {
        for (int level = 0; level < species_.levels(); ++level) {
            if (value("Taper", level) > 1) return true;
        }
        return false;
    }

    /// Pieces that a segment is drawn in, and the part of the segment below the i-th.
    std::string pieces(int level) const {
        const double number = value("Taper", level);
        if (number > 2) return "#define PIECES_<n>(k) 12\n#define PART_<n>(i, k) ((i) / 12)\n";
        const bool flares = level == 0 && value("Flare") > 0, is_round = number > 1;
        if (!flares && !is_round) return "";
        const std::string foot = flares ? "(k) == 0 ? 8 : " : "",
                          tip = is_round ? "(k) == CurveRes_<c> - 1 ? 8 : " : "";
        const std::string at_foot = flares ? "(k) == 0 ? ((i) / 8) ^ 2 : " : "";
        const std::string at_tip = is_round ? "(k) == CurveRes_<c> - 1 ? 1 - (1 - (i) / 8) ^ 2 : " : "";
        return "#define PIECES_<n>(k) (" + foot + tip + "1)\n#define PART_<n>(i, k) (" + at_foot + at_tip + "(i))\n";
    }

    // --- the L-system -----------------------------------------------------------------------------------------------

    std::string declarations() const {
        std::string text;
        for (int level = 0; level < species_.levels(); ++level) {
            text +=
                filled("module Bud<n>(length, radius, children), Stem<n>(<stem>), Node<n>(<stem>);\n", words(level));
            text += filled("module Wood<n>(k, segment, radius)", words(level));
            if (!pieces(level).empty()) text += filled(", Piece<n>(i, k, segment, radius)", words(level));
            if (splits(level))
                text += filled(", Fork<n>(i, clones, <frame><at>, <stem>), Split<n>(i, clones, <frame><at>, <stem>)",
                               words(level));
            text += ";\n";
        }
        if (value("Leaves") != 0) text += "module Leaf;\n";
        if (has_fans()) text += "module Fan(i, leaves);\n";
        return text;
    }

    /// Each level ends as many steps after the one below as its stems have segments; pruned stems wait for an answer.
    std::string length() const {
        std::string sum = "CurveRes_0";
        for (int level = 1; level < species_.levels(); ++level) sum += fmt::format(" + CurveRes_{}", described(level));
        return species_.prunes() ? sum : fmt::format("{} - {}", sum, species_.levels() - 1);
    }

    std::string start() const {
        std::string text =
            "\tscale = Scale + WITHIN(ScaleV);\n\tbase = BaseSize * scale;\n"
            "\ttrunk_length = (Length_0 + WITHIN(LengthV_0)) * scale * (ZScale + WITHIN(ZScaleV));\n"
            "\ttrunk_radius = trunk_length * Ratio * (Scale_0 + WITHIN(ScaleV_0));\n"
            "\tbare = min(base / max(trunk_length, 1e-9), 0.99);\n";
        if (species_.prunes()) text += "\tfoot_x = 0;\n\tfoot_y = 0;\n\tfoot_z = 0;\n";
        return text;
    }

    std::string axiom() const {
        const std::string children = !is_last(0)            ? "round(Branches_1)"
                                     : value("Leaves") == 0 ? "0"
                                                            : "round(Leaves * QUALITY)";
        return fmt::format("/(ran(360)) {}Bud0(trunk_length, trunk_radius, {})",
                           species_.prunes() ? "?P(0, 0, 0) ?H(0, 0, 0) ?U(0, 0, 0) " : "", children);
    }

    void write_level(int level) {
        const std::string title = fmt::format("\n/* level {} */\n", level);
        const std::array<std::string*, 3> sections{&productions_, &decomposition_, &drawing_};
        std::array<std::string, 3> before;
        for (std::size_t k = 0; k < sections.size(); ++k) before[k] = std::exchange(*sections[k], "");
        write_bud(level);
        write_stem(level);
        write_node(level);
        write_wood(level);
        for (std::size_t k = 0; k < sections.size(); ++k) {
            const std::string head = sections[k] == &drawing_ ? "" : title;
            *sections[k] = before[k] + head + placed(*sections[k], species_.place_of_level(level));
        }
    }

    void write_bud(int level) {
        const char* ignored = "Bud<n>(length, radius, children) : LEVELS <= <n> || length <= 0 || radius <= 0 --> *\n";
        const std::string begins = is_helix(level) ? "&(-CurveV_<c>) " : "";
        if (!species_.prunes()) {
            decomposition_ +=
                filled(ignored + std::string("Bud<n>(length, radius, children) -->\n\t") + begins +
                           "Node<n>(0, 0, 1, ran(360), length / CurveRes_<c>, radius, children, ran(1000), 0)\n",
                       words(level));
            return;
        }
        const std::string foot = level == 0 ? "foot_x = x; foot_y = y; foot_z = z; " : "";
        productions_ +=
            filled(std::string("?P(x, y, z) ?H(hx, hy, hz) ?U(ux, uy, uz) ") + ignored +
                       "?P(x, y, z) ?H(hx, hy, hz) ?U(ux, uy, uz) Bud<n>(length, radius, children) :\n\t{" + foot +
                       "k = 0; back = 0; seed = ran(1000); segment = length / CurveRes_<c>;\n" + pruning(level) +
                       "\t} segment > 0 --> Node<n>(0, 0, 1, ran(360), segment, radius, children, seed, 0)\n"
                       "?P(x, y, z) ?H(hx, hy, hz) ?U(ux, uy, uz) Bud<n>(length, radius, children) --> *\n",
                   words(level));
    }

    /// Statements that shorten the segments from the k-th on until the stem lies in the envelope.
    static std::string pruning(int level) {
        std::string text = R"(	part = 1; inside = 0;
	while (inside == 0 && part > 0.02) {
		px = x; py = y; pz = z; vx = hx; vy = hy; vz = hz; wx = ux; wy = uy; wz = uz; i = k; inside = 1;
		while (inside == 1 && i < CurveRes_<c>) {
			bend = i > 0 ? BEND_<n>(i, seed, back, vy, wy) : 0;
			qx = vx * cos(bend) + wx * sin(bend); wx = wx * cos(bend) - vx * sin(bend); vx = qx;
			qy = vy * cos(bend) + wy * sin(bend); wy = wy * cos(bend) - vy * sin(bend); vy = qy;
			qz = vz * cos(bend) + wz * sin(bend); wz = wz * cos(bend) - vz * sin(bend); vz = qz;
			px += vx * segment * part; py += vy * segment * part; pz += vz * segment * part;
			inside = <below>INSIDE(px, py, pz);
			i += 1;
		}
		if (inside == 0) { part = part * 0.9; }
	}
	segment = segment * (1 - PruneRatio * (1 - (inside == 0 ? 0 : part)));
)";
        return filled(text, {{"below", level == 0 ? "py - foot_y <= base || " : ""}});
    }

    /// The tip of a stem, which knows its heading, draws its next segment or splits first.
    void write_stem(int level) {
        std::string asked = "<P>?H(hx, hy, hz) ?U(ux, uy, uz) Stem<n>(<stem>)";
        std::string text;
        if (splits(level)) {
            text += asked +
                    " :\n\t{clones = CLONES_<n>(k, seed);} clones > 0 --> Fork<n>(0, clones, <frame><at>, <stem>)\n";
            decomposition_ += filled(
                "Fork<n>(i, clones, <frame><at>, <stem>) : i < clones -->\n"
                "\t[ Split<n>(i + 1, clones, <frame><at>, k, j + (i + 1) * stride, stride * (clones + 1),\n"
                "\t\tturn + 90 * (i + 1), segment, radius, children, ran(1000), back) ]\n"
                "\tFork<n>(i + 1, clones, <frame><at>, <stem>)\n"
                "Fork<n>(i, clones, <frame><at>, <stem>) -->\n"
                "\tSplit<n>(0, clones, <frame><at>, k, j, stride * (clones + 1), turn, segment, radius, children, "
                "seed, back)\n",
                words(level));
            decomposition_ += filled(split_production(level), words(level));
        }
        const std::string helix = is_helix(level) ? "^(-CurveV_<c>) /(360 / CurveRes_<c>) &(-CurveV_<c>) " : "";
        text += asked + " -->\n\t" + helix + "&(BEND_<n>(k, seed, back, hy, uy)) Node<n>(<stem>)\n";
        productions_ += filled(text, words(level));
    }

    /// A clone turns away from its stem, the less the further the stem leans, and about the vertical.
    std::string split_production(int level) const {
        const std::string spread = "(2 * (i % 2) - 1) * (20 + 0.75 * (30 + abs(declination - 90)) * ran(1) ^ 2)";
        const std::string at_base = level == 0 ? "k == 1 && BaseSplits_0 > 0 ? 360 * i / (clones + 1) : " : "";
        std::string text = R"(Split<n>(i, clones, <frame><at>, <stem>) : {
	declination = acos(clamp(hy, -1, 1));
	angle = max(0, SplitAngle_<c> + WITHIN(SplitAngleV_<c>) - declination);
	spread = )" + at_base +
                           spread + R"(;
	back = back - angle / (CurveRes_<c> - k);
	angle = angle + angle / (CurveRes_<c> - k);
	qx = hx * cos(spread) + hz * sin(spread); hz = hz * cos(spread) - hx * sin(spread);
	rx = ux * cos(spread) + uz * sin(spread); uz = uz * cos(spread) - ux * sin(spread);
	hx = qx * cos(angle) + rx * sin(angle); ux = rx * cos(angle) - qx * sin(angle);
	qy = hy * cos(angle) + uy * sin(angle); uy = uy * cos(angle) - hy * sin(angle); hy = qy;
	qz = hz * cos(angle) + uz * sin(angle); uz = uz * cos(angle) - hz * sin(angle); hz = qz;
)";
        if (species_.prunes()) text += pruning(level);
        text += "\t} ";
        text += species_.prunes() ? "segment > 0" : "1";
        text += " -->\n\t@R(<frame>) &(BEND_<n>(k, seed, back, hy, uy)) Node<n>(<stem>)\n";
        if (species_.prunes()) text += "Split<n>(i, clones, <frame><at>, <stem>) --> *\n";
        return text;
    }

    /// A segment with the children on it; the stem goes on if it is not done.
    void write_node(int level) {
        std::string text;
        if (bears(level)) {
            text += "Node<n>(<stem>) : j < children && PLACE_<n>(j, children) * CurveRes_<c> < k + 1 {\n" +
                    child_values(level) + "\t} -->\n\t[ f((place * CurveRes_<c> - k) * segment) /(roll) &(pitch) " +
                    child(level) +
                    " ]\n\tNode<n>(k, j + stride, stride, turn + Rotate_<d> + WITHIN(RotateV_<d>), segment, radius, "
                    "children, seed, "
                    "back)\n";
        }
        text +=
            "Node<n>(<stem>) : k + 1 < CurveRes_<c> -->\n"
            "\tWood<n>(k, segment, radius) <ask>Stem<n>(k + 1, j, stride, turn, segment, radius, children, seed, "
            "back)\n";
        const std::string fan = is_last(level) && has_fans() ? " Fan(0, children)" : "";
        text += "Node<n>(<stem>) --> Wood<n>(k, segment, radius)" + fan + "\n";
        decomposition_ += filled(text, words(level));
        if (!fan.empty()) {
            decomposition_ += filled(
                "Fan(i, leaves) : i < leaves -->\n"
                "\t[ +(Rotate_<d> * (i / max(1, leaves - 1) - 0.5)) &(DownAngle_<d>) Leaf ] Fan(i + 1, leaves)\n"
                "Fan(i, leaves) --> *\n",
                words(level));
        }
    }

    bool bears(int level) const { return is_last(level) ? value("Leaves") > 0 : true; }

    std::string child(int level) const {
        if (is_last(level)) return "Leaf";
        return species_.prunes() ? "<ask>Bud<m>(child, thickness, grandchildren)"
                                 : "Bud<m>(child, thickness, grandchildren)";
    }

    /// Place, angles, length and radius of the next child, and how many children it will have.
    std::string child_values(int level) const {
        const int child = described(level + 1);
        std::string text =
            "\tplace = PLACE_<n>(j, children); length = segment * CurveRes_<c>; offset = place * length;\n";
        const std::string top = level == 0 ? "(1 - place) / (1 - bare)" : "1 - place";
        text += value("DownAngleV", child) < 0
                    ? "\tpitch = DownAngle_<d> + DownAngleV_<d> * (1 - 2 * CONICAL(" + top + "));\n"
                    : "\tpitch = DownAngle_<d> + WITHIN(DownAngleV_<d>);\n";
        text += value("Rotate", child) < 0
                    ? "\troll = (2 * (floor(j / stride) % 2) - 1) * (180 + Rotate_<d> + WITHIN(RotateV_<d>));\n"
                    : "\troll = turn;\n";
        if (is_last(level)) return text;
        text += "\tshare = Length_<d> + WITHIN(LengthV_<d>);\n";
        text += level == 0 ? "\tchild = length * share * SHAPE(" + top + ");\n"
                           : "\tchild = share * (length - 0.6 * offset);\n";
        text +=
            "\tthickness = min(radius * (max(0, child) / length) ^ RatioPower, RADIUS_<n>(radius, length, place));\n";
        return text + "\tgrandchildren = " + grandchildren(level) + ";\n";
    }

    std::string grandchildren(int level) const {
        if (is_last(level + 1)) return value("Leaves") == 0 ? "0" : "round(Leaves * TAPERED(place) * QUALITY)";
        const std::string number = fmt::format("Branches_{}", described(level + 2));
        return level == 0 ? "round(" + number + " * (0.2 + 0.8 * child / length / max(share, 1e-9)))"
                          : "round(" + number + " * (1 - 0.5 * place))";
    }

    // --- what is drawn ----------------------------------------------------------------------------------------------

    /// Internodes; with lobes they are the core of a surface.
    void write_wood(int level) {
        const bool lobed = level == 0 && has_lobes();
        const std::string width = "2 * RADIUS_<n>(radius, segment * CurveRes_<c>, ";
        const std::string core = lobed ? fmt::format(" * {}", format_exact(1 - value("LobeDepth"))) : "";
        const std::string foot = ";(BarkColour) " + (lobed ? lobes() + " !(" + width + "0)) @Gs " : "") + "!(" + width +
                                 "0)" + core + ") G(0.01 * segment) ";
        const auto piece = [&](const std::string& length, const std::string& end) {
            const std::string surface = lobed ? " !(" + width + end + ")) @Gc(1)" : "";
            return "!(" + width + end + ")" + core + ") G(" + length + ")" + surface;
        };
        std::string text;
        if (pieces(level).empty()) {
            text = "Wood<n>(k, segment, radius) : k == 0 --> " + foot + piece("0.99 * segment", "1 / CurveRes_<c>") +
                   "\nWood<n>(k, segment, radius) --> " + piece("segment", "(k + 1) / CurveRes_<c>") + "\n";
        } else {
            const std::string part = "(k + PART_<n>(i + 1, k)) / CurveRes_<c>";
            text = "Wood<n>(k, segment, radius) : k == 0 --> " + foot + "Piece<n>(0, k, segment, radius)\n" +
                   "Wood<n>(k, segment, radius) --> Piece<n>(0, k, segment, radius)\n" +
                   "Piece<n>(i, k, segment, radius) : i < PIECES_<n>(k) -->\n\t" +
                   piece("segment * (PART_<n>(i + 1, k) - (i + k == 0 ? 0.01 : PART_<n>(i, k)))", part) +
                   " Piece<n>(i + 1, k, segment, radius)\nPiece<n>(i, k, segment, radius) --> *\n";
        }
        drawing_ += filled(text, words(level));
    }

    /// The outline 1 + LobeDepth sin(Lobes angle) of the trunk, as magnets.
    std::string lobes() const {
        const int count = static_cast<int>(value("Lobes"));
        const std::string depth = format_exact(value("LobeDepth"));
        std::string magnets;
        for (int k = 0; k < count; ++k) magnets += ", 0, " + depth + ", 0, -" + depth;
        return fmt::format("@!({}) @Gm(1{})", std::max(16, 4 * count), magnets);
    }

    std::string leaf_drawing() const {
        if (value("Leaves") == 0) return "";
        return "Leaf --> ;(LeafColour) " + leaf_polygons(species_, "LeafScale / sqrt(QUALITY)") + "\n";
    }

    const Species& species_;
    std::string file_, macros_, productions_, decomposition_, drawing_;
};

}  // namespace

TranslatedText model_of(const Species& species, const std::string& file) {
    const std::string name = std::filesystem::path(file).filename().string();
    return unmarked(Translation(species, name).text(), {file});
}

}  // namespace espalier::language::weber_penn
