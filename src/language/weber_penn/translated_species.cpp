#include "language/weber_penn/translated_species.h"

#include "language/text/marks.h"

namespace espalier::language::weber_penn {
namespace {

// Parameters of a stem: the next segment and child, how many children it leaves to its clones from one to the next (and
// itself), the turn of that child about the stem, the length of a segment, the radius at the base, the number of
// children, the seed of its chance, and what each segment bends back after splits.
constexpr const char* stem = "k, j, stride, turn, segment, radius, children, seed, back";
constexpr const char* frame = "hx, hy, hz, ux, uy, uz";

}  // namespace

std::string filled(std::string text, const Words& words) {
    for (const auto& [name, word] : words) {
        const std::string mark = "<" + name + ">";
        for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at)) {
            text.replace(at, mark.size(), word);
        }
    }
    return text;
}

std::string placed(const std::string& text, const std::optional<Location>& at) {
    return at ? marked(text, *at) : text;
}

Words TranslatedSpecies::words(int level) const {
    const int child = level + 1;
    return {{"n", std::to_string(level)},
            {"m", std::to_string(child)},
            {"c", std::to_string(described(level))},
            {"d", std::to_string(described(child))},
            {"stem", stem},
            {"frame", frame},
            {"P", prunes() ? "?P(x, y, z) " : ""},
            {"at", prunes() ? ", x, y, z" : ""},
            {"leaf", bends_leaves() ? "?P(0, 0, 0) ?H(0, 0, 0) ?U(0, 0, 0) LeafBud" : "Leaf"},
            {"side", sets("BendV", level) ? "+(SIDE_" + std::to_string(level) + "(k, seed)) " : ""},
            {"ask", prunes() ? "?P(0, 0, 0) ?H(0, 0, 0) ?U(0, 0, 0) " : "?H(0, 0, 0) ?U(0, 0, 0) "}};
}

}  // namespace espalier::language::weber_penn
