// Components with an axis: the horn, and the tree, whose axis is cut where branches stand.
#include "espalier/base/math.h"

#include "base/text.h"
#include "language/pgraph/curve.h"
#include "language/pgraph/model_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <utility>

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
    const int sides = sides_of(text.component());
    return sides ? fmt::format("@!({}) {} @Gs ", sides, width(text, "0")) : "";
}

/// Ahead by a piece of the axis: of a surface, which takes the place of internodes, or an internode.
std::string piece_ahead(const ComponentText& text, const std::string& length) {
    return sides_of(text.component()) ? "f(" + length + ") @Gc(1)" : "F(" + length + ")";
}

/// Behind the axis, whose surface ends there or goes on along another one.
std::string end_of_surface(const ComponentText& text) {
    const bool goes_on = !text.continuation().empty();
    return sides_of(text.component()) && !goes_on ? " @Ge(1)" : "";
}

/// What is drawn where an axis begins; nothing where it goes on along the surface of the one before.
void write_beginning(ComponentText& text, const std::string& module, const std::string& rest) {
    const bool can_continue = text.structure().can_continue(text.component().name);
    if (can_continue)
        text.homomorphism.push_back(fmt::format("{} : joined > 0 --> {}", module, rest.empty() ? "*" : rest));
    const std::string drawn = surface(text) + rest;
    text.homomorphism.push_back(fmt::format("{} --> {}", module, drawn.empty() ? "*" : drawn));
}

std::string joined(const std::string& first, const std::string& rest) {
    return rest.empty() ? first : first + ", " + rest;
}

/// Arrays of the turns before each piece of a horn that follows a curve, and of the lengths of the pieces; the turns
/// and the step as modules.
std::string along_curve(ComponentText& text) {
    const Component& component = text.component();
    const std::vector<double> numbers = numbers_of(text.graph(), value_of(component, "curve"));
    std::vector<glm::dvec3> points;
    for (std::size_t k = 0; k + 2 < numbers.size(); k += 3) {
        points.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
    }
    const CurveThrough curve(points);
    const int pieces = std::stoi(value_of(component, "pieces").parts.front());
    glm::dvec3 heading(0, 1, 0), left(-1, 0, 0), up(0, 0, -1), before(0);
    std::vector<std::string> turns, pitches, lengths;
    for (int k = 1; k <= pieces; ++k) {
        const glm::dvec3 point = curve.at(curve.length() * k / pieces), step = point - before;
        const double turn = math::atan2(glm::dot(step, left), glm::dot(step, heading));
        const glm::dvec3 ahead = heading * math::cos(turn) + left * math::sin(turn);
        left = left * math::cos(turn) - heading * math::sin(turn);
        const double pitch = math::atan2(glm::dot(step, up), glm::dot(step, ahead));
        heading = ahead * math::cos(pitch) + up * math::sin(pitch);
        up = up * math::cos(pitch) - ahead * math::sin(pitch);
        turns.push_back(format_exact(glm::degrees(turn)));
        pitches.push_back(format_exact(glm::degrees(pitch)));
        lengths.push_back(format_exact(glm::length(step)));
        before = point;
    }
    const std::string name = component.name;
    for (const auto& [array, values] : {std::pair{"turn", &turns}, {"pitch", &pitches}, {"length", &lengths}}) {
        text.arrays.push_back(fmt::format("array {}_{}[{}] = {{{}}};", array, name, pieces, fmt::join(*values, ", ")));
    }
    return fmt::format("+(turn_{0}[k]) &(pitch_{0}[k]) {1}", name, piece_ahead(text, "length_" + name + "[k]"));
}

}  // namespace

void write_horn(ComponentText& text) {
    const bool is_curve = text.values().is_set("curve");
    std::vector<std::string> keys = axis_keys(text);
    if (is_curve) std::erase(keys, "length");
    Parameters parameters = text.parameters(keys);
    parameters.emplace_back("pieces", text.values().whole("pieces"));
    const std::string names = names_of(parameters), piece = text.kept() + "Piece";
    if (text.structure().can_continue(text.component().name)) parameters.emplace_back("joined", "joined");
    const std::string horn = text.declared(text.kept(), names_of(parameters));
    text.productions.push_back(fmt::format("{}({}) --> {}{}({}){}{}", text.bud(), text.place(), text.placing(),
                                           text.kept(), values_of(parameters), text.followers(LinkKind::child),
                                           text.continuation()));
    const std::string pieces = text.declared(piece, "k, " + names);
    write_beginning(text, horn, fmt::format("{}(0, {}){}", piece, names, end_of_surface(text)));
    const std::string drawn =
        width(text, "(k + 1) / pieces") + " " + (is_curve ? along_curve(text) : piece_ahead(text, "length / pieces"));
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
    text.homomorphism.push_back(fmt::format("{} : k < max(m, 1) --> {}{}{} {} {}(k + 1, m, from, to, {})", pieces,
                                            rotation(text, middle, share), text.pull(share), width(text, end),
                                            piece_ahead(text, "length * (to - from) / max(m, 1)"), piece, names));
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
    const std::string branches = has_branches ? fmt::format("{}(0, branches{}, {}) ", each, text.depths(), names) : "";
    const bool can_continue = text.structure().can_continue(text.component().name);
    const std::string kept = text.declared(text.kept(), can_continue ? joined(names, "joined") : names);
    text.decomposition.push_back(fmt::format("{} --> {} {}{}({}, 1, {}){}{}{}", whole, kept, branches, axis, start,
                                             axis_names, end_of_surface(text), text.followers(LinkKind::child),
                                             text.continuation()));
    write_beginning(text, kept, "");
    write_axis(text, axis_names);
    if (!has_branches) return;

    const std::string rest = joined("n" + text.depths(), names);
    const std::string some = text.declared(each, "i, " + rest);
    const std::string placed = "/(divergence * i) " + text.direction_of_child();
    text.decomposition.push_back(fmt::format("{} : i < n --> {}(i > 0 ? {} : 0, {}, {}){} {}(i + 1, {})", some, axis,
                                             below, at, axis_names, text.followers(LinkKind::branch, placed), each,
                                             rest));
    text.decomposition.push_back(fmt::format("{} --> *", some));
}

}  // namespace espalier::language::pgraph
