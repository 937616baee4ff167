// Components with an axis: the horn, and the tree, whose axis is cut where branches stand.
#include "language/pgraph/model_text.h"

#include <fmt/format.h>

namespace espalier::language::pgraph {
namespace {

constexpr std::pair<const char*, char> rotations[]{{"bend", '&'}, {"sway", '+'}, {"twist", '/'}};

std::vector<std::string> axis_keys(const ComponentText& text) {
    std::vector<std::string> keys{"length", "radius"};
    for (const auto& [key, symbol] : rotations) {
        if (text.values().is_set(key)) keys.emplace_back(key);
    }
    return keys;
}

int sides_of(const ComponentText& text) {
    return std::stoi(value_of(text.component(), "sides").parts.front());
}

/// From one piece to the next; `part` is 0 at the base and 1 at the tip.
std::string rotation(const ComponentText& text, const std::string& part, const std::string& factor = "") {
    std::string modules;
    for (const auto& [key, symbol] : rotations) {
        if (!text.values().is_set(key)) continue;
        const std::string angle = text.values().along(key, part);
        modules += fmt::format("{}({}) ", symbol, factor.empty() ? angle : fmt::format("({}) * ({})", angle, factor));
    }
    return modules;
}

std::string width(const ComponentText& text, const std::string& part) {
    return fmt::format("!(2 * ({}))", text.values().along("radius", part));
}

/// A closed surface begins with a control point.
std::string surface(const ComponentText& text) {
    const int sides = sides_of(text);
    return sides ? fmt::format("@!({}) {} @Gs ", sides, width(text, "0")) : "";
}

std::string joined(const std::string& first, const std::string& rest) {
    return rest.empty() ? first : first + ", " + rest;
}

}  // namespace

void write_horn(ComponentText& text) {
    std::vector<std::string> keys = axis_keys(text);
    Parameters parameters = text.parameters(keys);
    parameters.emplace_back("pieces", text.values().whole("pieces"));
    const std::string names = names_of(parameters);
    const std::string horn = text.declared(text.kept(), names), piece = text.kept() + "Piece";
    text.productions.push_back(fmt::format("{}({}) --> {}{}({}){}", text.bud(), text.place(), text.placing(),
                                           text.kept(), values_of(parameters), text.followers(LinkKind::child)));
    const std::string pieces = text.declared(piece, "k, " + names);
    const char* end = sides_of(text) ? " @Ge(1)" : "";
    text.homomorphism.push_back(fmt::format("{} --> {}{}(0, {}){}", horn, surface(text), piece, names, end));
    const std::string drawn = fmt::format("{} F(length / pieces)", width(text, "(k + 1) / pieces"));
    text.homomorphism.push_back(fmt::format("{} : k < pieces - 1 --> {} {}{}(k + 1, {})", pieces, drawn,
                                            rotation(text, "k / max(pieces - 2, 1)"), piece, names));
    text.homomorphism.push_back(fmt::format("{} --> {}", pieces, drawn));
}

namespace {

/// The axis from one branch to the next, in as many pieces as its share of the whole.
void write_axis(ComponentText& text, const std::string& names) {
    const std::string axis = text.kept() + "Axis", piece = text.kept() + "Piece";
    const std::string section = text.declared(axis, joined("from, to", names));
    text.homomorphism.push_back(fmt::format(
        "{} : to > from --> {}(0, ceil((to - from) * pieces - 0.001), from, to, {})", section, piece, names));
    text.homomorphism.push_back(fmt::format("{} --> *", section));
    const std::string pieces = text.declared(piece, joined("k, m, from, to", names));
    const std::string share = "((to - from) * pieces / max(m, 1))";
    const std::string middle = "lerp(from, to, (k + 0.5) / max(m, 1))", end = "lerp(from, to, (k + 1) / max(m, 1))";
    text.homomorphism.push_back(
        fmt::format("{} : k < max(m, 1) --> {}{}{} F(length * (to - from) / max(m, 1)) {}(k + 1, m, from, to, {})",
                    pieces, rotation(text, middle, share), text.pull(share), width(text, end), piece, names));
    text.homomorphism.push_back(fmt::format("{} --> *", pieces));
}

}  // namespace

void write_tree(ComponentText& text) {
    std::vector<std::string> keys = axis_keys(text);
    for (const std::string& key : text.tropisms()) keys.push_back(key);
    Parameters parameters = text.parameters(keys);
    parameters.emplace_back("pieces", text.values().whole("pieces"));
    const std::string axis_names = names_of(parameters);
    parameters.emplace_back("branches", text.values().whole("branches"));
    parameters.emplace_back("divergence", text.values().number("divergence"));
    const std::string names = names_of(parameters), of = text.bud() + "Of", each = text.bud() + "Each";
    text.productions.push_back(fmt::format("{}({}) --> {}{}({}, {})", text.bud(), text.place(), text.placing(), of,
                                           text.place(), values_of(parameters)));

    const std::string at = text.values().number("at");
    const std::string below = substituted(at, {{"i", "(i - 1)"}});
    const std::string highest = substituted(at, {{"i", "(branches - 1)"}, {"n", "branches"}});
    const std::string whole = text.declared(of, joined(text.place(), names));
    const bool has_branches = !text.followers(LinkKind::branch).empty();
    const std::string axis = text.kept() + "Axis";
    const std::string start = has_branches ? fmt::format("branches > 0 ? {} : 0", highest) : "0";
    const std::string branches =
        has_branches ? fmt::format("{}(0, branches, branches{}, {}) ", each, text.depths(), names) : "";
    const std::string kept = text.declared(text.kept(), names);
    text.decomposition.push_back(fmt::format("{} --> {} {}{}({}, 1, {}){}{}", whole, kept, branches, axis, start,
                                             axis_names, sides_of(text) ? " @Ge(1)" : "",
                                             text.followers(LinkKind::child)));
    text.homomorphism.push_back(fmt::format("{} --> {}", kept, sides_of(text) ? surface(text) : "*"));
    write_axis(text, axis_names);
    if (!has_branches) return;

    const std::string some = text.declared(each, joined("i, past, n" + text.depths(), names));
    const std::string rest = joined("n" + text.depths(), names);
    text.decomposition.push_back(
        fmt::format("{0} : past - i > 1 --> {1}(i, floor((i + past) / 2), {2}) {1}(floor((i + past) / 2), past, {2})",
                    some, each, rest));
    const std::string placed = "/(divergence * i) " + text.direction_of_child();
    text.decomposition.push_back(fmt::format("{} : past - i == 1 --> {}(i > 0 ? {} : 0, {}, {}){}", some, axis, below,
                                             at, axis_names, text.followers(LinkKind::branch, placed)));
    text.decomposition.push_back(fmt::format("{} --> *", some));
}

}  // namespace espalier::language::pgraph
