// How segments of stems are drawn.
#include "base/text.h"
#include "language/weber_penn/translated_species.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::language::weber_penn {
namespace {

/// The outline 1 + LobeDepth sin(Lobes angle) of the trunk, as magnets.
std::string lobes(const TranslatedSpecies& species) {
    const int count = static_cast<int>(species.value("Lobes"));
    const std::string depth = format_exact(species.value("LobeDepth"));
    std::string magnets;
    for (int k = 0; k < count; ++k) magnets += ", 0, " + depth + ", 0, -" + depth;
    return fmt::format("@!({}) @Gm(1{})", std::max(16, 4 * count), magnets);
}

}  // namespace

/// Internodes; with lobes they are the core of a surface.
void add_drawing(const TranslatedSpecies& species, int level, Rules& rules) {
    const bool lobed = level == 0 && species.has_lobes();
    const std::string width = "2 * RADIUS_<n>(radius, segment * CurveRes_<c>, ";
    const std::string core = lobed ? fmt::format(" * {}", format_exact(1 - species.value("LobeDepth"))) : "";
    const std::string foot = ";(BarkColour) " + (lobed ? lobes(species) + " !(" + width + "0)) @Gs " : "") + "!(" +
                             width + "0)" + core + ") G(0.01 * segment) ";
    const auto piece = [&](const std::string& length, const std::string& end) {
        const std::string surface = lobed ? " !(" + width + end + ")) @Gc(1)" : "";
        return "!(" + width + end + ")" + core + ") G(" + length + ")" + surface;
    };
    std::string text;
    if (!species.has_pieces(level)) {
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
    rules.drawing += filled(text, species.words(level));
}

}  // namespace espalier::language::weber_penn
