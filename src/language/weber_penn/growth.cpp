// How stems grow: a bud becomes a stem, whose tip adds segments, splits and bears children.
#include "language/weber_penn/translated_species.h"

#include <fmt/format.h>

namespace espalier::language::weber_penn {
namespace {

/// Statements that shorten the segments from the k-th on until the stem lies in the envelope.
std::string pruning(const TranslatedSpecies& species, int level) {
    const std::string sideways = !species.sets("BendV", level) ? "" : R"(
			side = i > 0 ? SIDE_<n>(i, seed) : 0;
			qx = vy * wz - vz * wy; qy = vz * wx - vx * wz; qz = vx * wy - vy * wx;
			vx = vx * cos(side) + qx * sin(side);
			vy = vy * cos(side) + qy * sin(side);
			vz = vz * cos(side) + qz * sin(side);)";
    std::string text = R"(	part = 1; inside = 0;
	while (inside == 0 && part > 0.02) {
		px = x; py = y; pz = z; vx = hx; vy = hy; vz = hz; wx = ux; wy = uy; wz = uz; i = k; inside = 1;
		while (inside == 1 && i < CurveRes_<c>) {
			bend = i > 0 ? BEND_<n>(i, seed, back, vy, wy) : 0;<sideways>
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
    return filled(text, {{"below", level == 0 ? "py - foot_y <= base || " : ""}, {"sideways", sideways}});
}

void write_bud(const TranslatedSpecies& species, int level, Rules& rules) {
    const char* ignored = "Bud<n>(length, radius, children) : LEVELS <= <n> || length <= 0 || radius <= 0 --> *\n";
    const std::string begins = species.is_helix(level) ? "&(-CurveV_<c>) " : "";
    if (!species.prunes()) {
        rules.decomposition +=
            filled(ignored + std::string("Bud<n>(length, radius, children) -->\n\t") + begins +
                       "Node<n>(0, 0, 1, ran(360), length / CurveRes_<c>, radius, children, ran(1000), 0)\n",
                   species.words(level));
        return;
    }
    const std::string foot = level == 0 ? "foot_x = x; foot_y = y; foot_z = z; " : "";
    rules.productions +=
        filled(std::string("?P(x, y, z) ?H(hx, hy, hz) ?U(ux, uy, uz) ") + ignored +
                   "?P(x, y, z) ?H(hx, hy, hz) ?U(ux, uy, uz) Bud<n>(length, radius, children) :\n\t{" + foot +
                   "k = 0; back = 0; seed = ran(1000); segment = length / CurveRes_<c>;\n" + pruning(species, level) +
                   "\t} segment > 0 --> Node<n>(0, 0, 1, ran(360), segment, radius, children, seed, 0)\n"
                   "?P(x, y, z) ?H(hx, hy, hz) ?U(ux, uy, uz) Bud<n>(length, radius, children) --> *\n",
               species.words(level));
}

/// A clone turns away from its stem, the less the further the stem leans, and about the vertical.
std::string split_production(const TranslatedSpecies& species, int level) {
    const std::string spread = "(2 * (i % 2) - 1) * (20 + 0.75 * (30 + abs(declination - 90)) * ran(1) ^ 2)";
    const std::string at_base = level == 0 ? "k == 1 && BaseSplits_0 != 0 ? 360 * i / (clones + 1) : " : "";
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
    if (species.prunes()) text += pruning(species, level);
    text += "\t} ";
    text += species.prunes() ? "segment > 0" : "1";
    text += " -->\n\t@R(<frame>) <side>&(BEND_<n>(k, seed, back, hy, uy)) Node<n>(<stem>)\n";
    if (species.prunes()) text += "Split<n>(i, clones, <frame><at>, <stem>) --> *\n";
    return text;
}

/// The tip of a stem, which knows its heading, draws its next segment or splits first.
void write_stem(const TranslatedSpecies& species, int level, Rules& rules) {
    std::string asked = "<P>?H(hx, hy, hz) ?U(ux, uy, uz) Stem<n>(<stem>)";
    std::string text;
    if (species.splits(level)) {
        text +=
            asked + " :\n\t{clones = CLONES_<n>(k, seed);} clones > 0 --> Fork<n>(0, clones, <frame><at>, <stem>)\n";
        rules.decomposition += filled(
            "Fork<n>(i, clones, <frame><at>, <stem>) : i < clones -->\n"
            "\t[ Split<n>(i + 1, clones, <frame><at>, k, j + (i + 1) * stride, stride * (clones + 1),\n"
            "\t\tturn + 90 * (i + 1), segment, radius, children, ran(1000), back) ]\n"
            "\tFork<n>(i + 1, clones, <frame><at>, <stem>)\n"
            "Fork<n>(i, clones, <frame><at>, <stem>) -->\n"
            "\tSplit<n>(0, clones, <frame><at>, k, j, stride * (clones + 1), turn, segment, radius, children, "
            "seed, back)\n",
            species.words(level));
        rules.decomposition += filled(split_production(species, level), species.words(level));
    }
    const std::string helix = species.is_helix(level) ? "^(-CurveV_<c>) /(360 / CurveRes_<c>) &(-CurveV_<c>) " : "";
    text += asked + " -->\n\t" + helix + "<side>&(BEND_<n>(k, seed, back, hy, uy)) Node<n>(<stem>)\n";
    rules.productions += filled(text, species.words(level));
}

std::string child(const TranslatedSpecies& species, int level) {
    if (species.is_last(level)) return "<leaf>";
    return species.prunes() ? "<ask>Bud<m>(child, thickness, grandchildren)"
                            : "Bud<m>(child, thickness, grandchildren)";
}

std::string grandchildren(const TranslatedSpecies& species, int level) {
    if (species.is_last(level + 1))
        return species.value("Leaves") == 0 ? "0" : "round(Leaves * LEAVES_AT(place) * QUALITY)";
    const std::string number = fmt::format("Branches_{}", species.described(level + 2));
    return level == 0 ? "round(" + number + " * (0.2 + 0.8 * child / length / max(share, 1e-9)))"
                      : "round(" + number + " * (1 - 0.5 * place))";
}

/// Place, angles, length and radius of the next child, and how many children it will have.
std::string child_values(const TranslatedSpecies& species, int level) {
    const int child = species.described(level + 1);
    std::string text = "\tplace = PLACE_<n>(j, children); length = segment * CurveRes_<c>; offset = place * length;\n";
    const std::string top = level == 0 ? "(1 - place) / (1 - bare)" : "1 - place";
    text += species.value("DownAngleV", child) < 0
                ? "\tpitch = DownAngle_<d> + DownAngleV_<d> * (1 - 2 * CONICAL(" + top + "));\n"
                : "\tpitch = DownAngle_<d> + WITHIN(DownAngleV_<d>);\n";
    text += species.value("Rotate", child) < 0
                ? "\troll = (2 * (floor(j / stride) % 2) - 1) * (180 + Rotate_<d> + WITHIN(RotateV_<d>));\n"
                : "\troll = turn;\n";
    if (species.is_last(level)) return text;
    text += "\tshare = Length_<d> + WITHIN(LengthV_<d>);\n";
    text += level == 0 ? "\tchild = length * share * SHAPE(" + top + ");\n"
                       : "\tchild = share * (length - 0.6 * offset);\n";
    const std::string factor = species.sets("Scale", level + 1) ? "Scale_<d> * " : "";
    text += "\tthickness = min(" + factor +
            "radius * (max(0, child) / length) ^ RatioPower, RADIUS_<n>(radius, length, place));\n";
    return text + "\tgrandchildren = " + grandchildren(species, level) + ";\n";
}

/// A segment with the children on it; the stem goes on if it is not done.
void write_node(const TranslatedSpecies& species, int level, Rules& rules) {
    std::string text;
    if (species.bears(level)) {
        text += "Node<n>(<stem>) : j < children && PLACE_<n>(j, children) * CurveRes_<c> < k + 1 {\n" +
                child_values(species, level) +
                "\t} -->\n\t[ f((place * CurveRes_<c> - k) * segment) /(roll) &(pitch) " + child(species, level) +
                " ]\n\tNode<n>(k, j + stride, stride, turn + Rotate_<d> + WITHIN(RotateV_<d>), segment, radius, "
                "children, seed, "
                "back)\n";
    }
    text +=
        "Node<n>(<stem>) : k + 1 < CurveRes_<c> -->\n"
        "\tWood<n>(k, segment, radius) <ask>Stem<n>(k + 1, j, stride, turn, segment, radius, children, seed, "
        "back)\n";
    const std::string fan = species.is_last(level) && species.has_fans() ? " Fan(0, children)" : "";
    text += "Node<n>(<stem>) --> Wood<n>(k, segment, radius)" + fan + "\n";
    rules.decomposition += filled(text, species.words(level));
    if (!fan.empty()) {
        rules.decomposition += filled(
            "Fan(i, leaves) : i < leaves -->\n"
            "\t[ +(Rotate_<d> * (i / max(1, leaves - 1) - 0.5)) &(DownAngle_<d>) <leaf> ] Fan(i + 1, leaves)\n"
            "Fan(i, leaves) --> *\n",
            species.words(level));
    }
}

}  // namespace

void add_growth(const TranslatedSpecies& species, int level, Rules& rules) {
    write_bud(species, level, rules);
    write_stem(species, level, rules);
    write_node(species, level, rules);
}

}  // namespace espalier::language::weber_penn
