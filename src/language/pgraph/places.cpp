// Components that place what follows them: one simple body, the multipliers, the world, and deformations.
#include "language/pgraph/model_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace espalier::language::pgraph {
namespace {

/// A rectangle around which the turtle goes, turning to one side; it has moved out along up to where the face is.
std::string rectangle(const std::string& along, const std::string& across, char turn) {
    return fmt::format("{{ . f({0}) {2}(90) f({1}) {2}(90) f({0}) {2}(90) f({1}) }}", along, across, turn);
}

std::string side_of_box(int side) {
    const bool is_deep = side % 2 == 0;
    const std::string out = is_deep ? "depth" : "width", across = is_deep ? "width" : "depth";
    return fmt::format("[ /({}) &(90) f({} / 2) ^(90) +(90) f({} / 2) -(90) {} ] ", 90 * side, out, across,
                       rectangle("length", across, '-'));
}

std::string end_of_box(char turn) {
    return fmt::format("[ &(90) f(depth / 2) {0}(90) f(width / 2) {0}(90) {1} ] ", turn,
                       rectangle("depth", "width", turn));
}

/// All faces look outwards.
std::string box() {
    std::string text;
    for (int side = 0; side < 4; ++side) text += side_of_box(side);
    return text + end_of_box('-') + "f(length) " + end_of_box('+');
}

struct Shape {
    std::vector<std::string> keys;
    std::string drawn;
};

Shape shape_of(const std::string& name, const std::string& sides) {
    if (name == "sphere") return {{"radius"}, fmt::format("@!({}) @O(2 * radius)", sides)};
    if (name == "cylinder") {
        return {{"length", "radius"}, fmt::format("@!({}) !(2 * radius) @Gs f(length) @Ge(1)", sides)};
    }
    if (name == "box") return {{"length", "width", "depth"}, box()};
    return {{}, "*"};
}

/// Where child i of n stands.
std::string place_of(const ComponentText& text) {
    const std::string direction = text.direction_of_child();
    if (text.component().type == "Hydra") return "/(360 * i / n) " + direction;
    if (text.component().type == "Ring") return "/(360 * i / n) &(90) f(radius) ^(90) " + direction;
    return "/(divergence * i) &(acos(lerp(cos(from), cos(to), (i + 0.5) / n))) f(radius) " + direction;
}

std::vector<std::string> keys_of_place(const std::string& type) {
    if (type == "Hydra") return {};
    if (type == "Ring") return {"radius"};
    return {"radius", "from", "to", "divergence"};
}

}  // namespace

void write_simple(ComponentText& text) {
    const Shape shape =
        shape_of(value_of(text.component(), "shape").parts.front(), value_of(text.component(), "sides").parts.front());
    const Parameters parameters = text.parameters(shape.keys);
    text.productions.push_back(fmt::format("{}({}) --> {}{}{}", text.bud(), text.place(), text.placing(),
                                           ComponentText::call(text.kept(), values_of(parameters)),
                                           text.followers(LinkKind::child)));
    text.homomorphism.push_back(
        fmt::format("{} --> {}", text.declared(text.kept(), names_of(parameters)), shape.drawn));
}

void write_multiplier(ComponentText& text) {
    Parameters parameters{{"count", text.values().whole("count")}};
    for (const auto& parameter : text.parameters(keys_of_place(text.component().type))) parameters.push_back(parameter);
    const std::string names = names_of(parameters), of = text.bud() + "Of", each = text.bud() + "Each";
    text.productions.push_back(fmt::format("{}({}) --> {}{}({}, {})", text.bud(), text.place(), text.placing(), of,
                                           text.place(), values_of(parameters)));

    const std::string rest = "n" + text.depths() + ", " + names;
    const std::string kept = text.declared(text.kept(), names);
    text.decomposition.push_back(fmt::format("{} --> {} {}(0, count{}, {})",
                                             text.declared(of, text.place() + ", " + names), kept, each, text.depths(),
                                             names));
    const std::string some = text.declared(each, "i, " + rest);
    text.decomposition.push_back(fmt::format("{} : i < n -->{} {}(i + 1, {})", some,
                                             text.followers(LinkKind::child, place_of(text)), each, rest));
    text.decomposition.push_back(fmt::format("{} --> *", some));
    text.homomorphism.push_back(fmt::format("{} --> *", kept));
}

void write_world(ComponentText& text) {
    for (const KeyValue& key : text.component().keys) {
        const std::string field =
            fmt::format("field {}_{} = {};", key.key, text.component().name, fmt::join(key.value.parts, ", "));
        text.fields.push_back(text.origins().marked(field, key.value.place));
    }
    text.productions.push_back(
        fmt::format("{}({}) --> {}{}", text.bud(), text.place(), text.kept(), text.followers(LinkKind::child)));
    text.homomorphism.push_back(fmt::format("{} --> *", text.declared(text.kept(), "")));
}

void write_deformation(ComponentText& text) {
    const auto numbers = [&](const char* key) {
        return fmt::format("{}", fmt::join(value_of(text.component(), key).parts, ", "));
    };
    const std::string leaves = value_of(text.component(), "leaves").parts.front();
    const int code = leaves == "bent" ? 0 : leaves == "carried" ? 1 : 2;
    const std::string kept = text.declared(text.kept(), "");
    text.productions.push_back(fmt::format("{}({}) --> {}{}{} @De", text.bud(), text.place(), text.placing(), kept,
                                           text.followers(LinkKind::child)));
    text.homomorphism.push_back(fmt::format("{} --> @Db({}, {}, {}, {}, {})", kept, code, numbers("lattice"),
                                            numbers("lower"), numbers("upper"), numbers("moves")));
}

}  // namespace espalier::language::pgraph
