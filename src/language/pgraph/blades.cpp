// Leaves: nets of points along a midrib and both edges, and the smooth curve of their outline.
#include "base/text.h"
#include "language/pgraph/model_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace espalier::language::pgraph {
namespace {

/// A point of the curve through equidistant points (Catmull & Rom 1974); the curve lies between 0 and 1.
double curve_through(const std::vector<double>& points, double part) {
    const double place = part * static_cast<double>(points.size() - 1);
    const auto last = static_cast<int>(points.size()) - 1;
    const int before = std::min(static_cast<int>(place), last - 1);
    const auto point = [&](int index) { return points[static_cast<std::size_t>(std::clamp(index, 0, last))]; };
    const double a = point(before - 1), b = point(before), c = point(before + 1), d = point(before + 2);
    const double t = place - before;
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

/// The half widths of the blade at the ends of its pieces.
std::string outline_array(const ComponentText& text, const std::string& name, int pieces) {
    const std::vector<double> points = numbers_of(text.graph(), value_of(text.component(), "outline"));
    std::vector<std::string> widths;
    for (int k = 0; k <= pieces; ++k) {
        widths.push_back(format_general(std::max(curve_through(points, double(k) / pieces), 0.0)));
    }
    return fmt::format("array {}[{}] = {{{}}};", name, pieces + 1, fmt::join(widths, ", "));
}

}  // namespace

void write_leaf(ComponentText& text) {
    std::vector<std::string> keys{"length", "width", "fold", "waves", "wave_height"};
    if (text.values().is_set("bend")) keys.emplace_back("bend");
    for (const std::string& key : text.tropisms()) keys.push_back(key);
    const Parameters parameters = text.parameters(keys);
    const std::string names = names_of(parameters);
    const std::string leaf = text.declared(text.kept(), names), piece = text.kept() + "Piece";
    text.productions.push_back(fmt::format("{}({}) --> {}{}({}){}", text.bud(), text.place(), text.placing(),
                                           text.kept(), values_of(parameters), text.followers(LinkKind::child)));

    const int pieces = std::stoi(value_of(text.component(), "pieces").parts.front());
    const std::string outline = "outline_" + text.component().name;
    text.arrays.push_back(outline_array(text, outline, pieces));
    const std::string step = fmt::format("g(length / {})", pieces);
    std::string onward = step + " ";
    if (text.values().is_set("bend")) {
        onward += fmt::format("&({}) ", text.values().along("bend", fmt::format("k / {}", std::max(pieces - 1, 1))));
    }
    onward += text.pull("1");
    const auto edge = [&](const char* raised, const char* sideways) {
        return fmt::format(
            "[ {}(fold) {}(90) g(width / 2 * {}[k]) &(90) g(wave_height * sin(360 * waves * k / {})) @Np ]", raised,
            sideways, outline, pieces);
    };
    const std::string row = fmt::format("{} @Np {}", edge("\\", "+"), edge("/", "-"));
    text.homomorphism.push_back(fmt::format("{} --> @Nb(3) {}(0, {})", leaf, piece, names));
    const std::string one = text.declared(piece, "k, " + names);
    text.homomorphism.push_back(
        fmt::format("{} : k < {} --> {} {}{}(k + 1, {})", one, pieces, row, onward, piece, names));
    text.homomorphism.push_back(fmt::format("{} --> {} @Ne", one, row));
}

}  // namespace espalier::language::pgraph
