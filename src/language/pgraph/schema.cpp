#include "language/pgraph/schema.h"

#include "base/part_help.h"
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::language::pgraph {
namespace {

using enum KeyKind;

std::vector<Key> joined(std::initializer_list<std::vector<Key>> lists) {
    std::vector<Key> all;
    for (const std::vector<Key>& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
}

const std::vector<Key>& placing() {
    static const std::vector<Key> keys{
        {"roll", instance, "degrees", -unbounded, unbounded, "0", "turn about the heading, first of all"},
        {"pitch", instance, "degrees", -unbounded, unbounded, "0", "turn away from the axis it stands on, after roll"},
        {"turn", instance, "degrees", -unbounded, unbounded, "0", "turn sideways, after pitch"},
        {"move", instance, "m", -unbounded, unbounded, "0", "way forward, after all turns"},
        {"scale", instance, "", 1e-6, unbounded, "1", "scale of the component and of all that follows it"},
        {"colour", instance, "", 0, 255, "128", "index in the colour map; without this key, that of its parent"},
    };
    return keys;
}

const std::vector<Key>& recursion() {
    static const std::vector<Key> keys{
        {"recursion", literal, "", 1, 1000, "1", "instances on one path, for a component that a link leads back to"}};
    return keys;
}

const std::vector<Key>& horn() {
    static const std::vector<Key> keys{
        {"length", instance, "m", 0, unbounded, "1", "length of the axis"},
        {"radius", axis, "m", 0, unbounded, "0.05 .. 0.02", "radius of the cross-section, from base to tip"},
        {"bend", axis, "degrees", -180, 180, "0", "pitch from one piece to the next, from base to tip"},
        {"sway", axis, "degrees", -180, 180, "0", "turn from one piece to the next"},
        {"twist", axis, "degrees", -unbounded, unbounded, "0", "roll from one piece to the next"},
        {"pieces", instance, "", 1, 10000, "8", "number of pieces of the cone"},
        {"sides", literal, "", 0, 256, "0", "number of sides of a closed surface; 0: internodes, which cost less"},
    };
    return keys;
}

const std::vector<Key>& tropisms() {
    static const std::vector<Key> keys{
        {"gravitropism", instance, "", -unbounded, unbounded, "0",
         "a piece turns towards gravity by this times the sine of the angle between, in radians; negative: away"},
        {"phototropism", instance, "", -unbounded, unbounded, "0", "the same towards the light"},
    };
    return keys;
}

std::vector<Key> multiplier(const std::string& count, const std::string& angle) {
    return {
        {"count", instance, "", 0, 9e5, count, "children, rounded"},
        {"angle", children, "degrees", -unbounded, unbounded, angle,
         "angle of each child with the direction of its place"},
        {"child_scale", children, "", 1e-6, unbounded, "1", "scale of each child"},
    };
}

std::vector<Key> radius(const std::string& standard, const std::string& summary) {
    return {{"radius", instance, "m", 0, unbounded, standard, summary}};
}

const std::vector<Key>& divergence() {
    static const std::vector<Key> keys{{"divergence", instance, "degrees", -unbounded, unbounded, "137.50776405",
                                        "about the axis, from one to the next"}};
    return keys;
}

std::vector<ComponentType> make_types() {
    std::vector<ComponentType> types;
    types.push_back({"Simple", "a sphere, a cylinder, a box or nothing; places what follows it",
                     joined({{{"shape", word, "none|sphere|cylinder|box", 0, 0, "none", "what is drawn"},
                              {"length", instance, "m", 0, unbounded, "1", "length of a cylinder or box"},
                              {"width", instance, "m", 0, unbounded, "1", "width of a box"},
                              {"depth", instance, "m", 0, unbounded, "1", "depth of a box"},
                              {"sides", literal, "", 3, 256, "36",
                               "meridians of a sphere, which encloses 84 % of its volume with 8, 99.1 % with 36 and "
                               "99.7 % with 64; sides of a cylinder"}},
                             radius("0.5", "radius of a sphere or cylinder"),
                             placing(),
                             recursion()})});
    types.push_back(
        {"Horn", "a bent cone; what follows it stands on its tip",
         joined({horn(),
                 {{"curve", list, "m", -unbounded, unbounded, "0, 0, 0, 0, 1, 0",
                   "x, y, z of points, the first 0, 0, 0: the axis is a smooth curve through them instead"}},
                 placing(),
                 recursion()})});
    types.push_back(
        {"Tree", "a horn with tropisms that carries branches",
         joined({horn(),
                 tropisms(),
                 {{"branches", instance, "", 0, 1e5, "0", "number of branches of every branch link, rounded"},
                  {"at", children, "", 0, 1, "0.2 .. 1", "part of the axis below each branch, not decreasing"},
                  {"angle", children, "degrees", -unbounded, unbounded, "45", "angle of each branch with the axis"},
                  {"child_scale", children, "", 1e-6, unbounded, "1", "scale of each branch"}},
                 divergence(),
                 placing(),
                 recursion()}),
         false, true});
    types.push_back(
        {"Leaf", "a blade on both sides of a midrib",
         joined({{{"length", instance, "m", 0, unbounded, "1", "length of the midrib"},
                  {"width", instance, "m", 0, unbounded, "0.5", "width of the blade where the outline is 1"},
                  {"outline", list, "", 0, unbounded, "0, 0.8, 1, 0.7, 0",
                   "outline of one half, at equal distances from base to tip; a smooth curve passes through"},
                  {"fold", instance, "degrees", -90, 90, "0", "by which both halves rise"},
                  {"bend", axis, "degrees", -180, 180, "0", "pitch from one piece to the next, from base to tip"},
                  {"waves", instance, "", 0, 1000, "0", "number of waves of the edge"},
                  {"wave_height", instance, "m", 0, unbounded, "0", "height of the waves of the edge"},
                  {"pieces", literal, "", 1, 1000, "4", "number of pieces of the blade"},
                  {"texture", instance, "", 0, 65535, "0", "number of a picture that fills the blade; 0: none"}},
                 tropisms(),
                 placing(),
                 recursion()})});
    types.push_back({"Hydra", "multiplies its children as a star about the axis",
                     joined({multiplier("5", "45"), placing(), recursion()}), true});
    types.push_back({"Ring", "multiplies its children on a circle about the axis",
                     joined({multiplier("5", "0"), radius("1", "radius of the circle"), placing(), recursion()}),
                     true});
    types.push_back(
        {"Phiball", "multiplies its children on a section of a sphere by the golden section",
         joined({multiplier("100", "0"),
                 radius("1", "radius of the sphere"),
                 {{"from", instance, "degrees", 0, 180, "0", "where the section begins, measured from the heading"},
                  {"to", instance, "degrees", 0, 180, "180", "where the section ends"}},
                 divergence(),
                 placing(),
                 recursion()}),
         true});
    types.push_back({"World",
                     "replaces the directions that tropisms turn to, for what follows it",
                     {{"gravity", field, "", -unbounded, unbounded, "0, -1, 0",
                       "vector at the place x, y, z; or gradient(FIELD) or vector(FIELD) of a process"},
                      {"light", field, "", -unbounded, unbounded, "0, 1, 0", "the same"}},
                     false,
                     false,
                     false});
    types.push_back({"FFD", "bends the space around what follows it by a lattice of points",
                     joined({{{"lower", vector, "m", -unbounded, unbounded, "-1, 0, -1", "corner of the box"},
                              {"upper", vector, "m", -unbounded, unbounded, "1, 2, 1", "the opposite corner"},
                              {"lattice", vector, "", 2, 16, "2, 2, 2", "points along x, y, z"},
                              {"moves", list, "m", -unbounded, unbounded, "0, 0, 0",
                               "needed: x, y, z for each point of the lattice, along x first, then y, then z"},
                              {"leaves", word, "bent|carried|left", 0, 0, "carried",
                               "leaves bend, or keep their shape, or stay where they are"}},
                             placing(),
                             recursion()})});
    return types;
}

std::string single_spaced(const std::string& text) {
    std::string result;
    for (const std::string& part : words_of(text, " \t\r")) result += (result.empty() ? "" : " ") + part;
    return result;
}

/// The places of a separator outside parentheses. A word stands between blanks.
std::vector<std::string> split(const std::string& text, const std::string& separator) {
    std::vector<std::string> parts{""};
    int depth = 0;
    for (std::size_t k = 0; k < text.size();) {
        depth += text[k] == '(' || text[k] == '[' ? 1 : text[k] == ')' || text[k] == ']' ? -1 : 0;
        if (depth == 0 && text.compare(k, separator.size(), separator) == 0) {
            parts.emplace_back();
            k += separator.size();
        } else {
            parts.back() += text[k++];
        }
    }
    for (std::string& part : parts) part = single_spaced(part);
    return parts;
}

bool has_empty(const std::vector<std::string>& parts) {
    return std::find(parts.begin(), parts.end(), "") != parts.end();
}

}  // namespace

const Key* ComponentType::find(const std::string& key) const {
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const Key& each) { return each.name == key; });
    return found == keys.end() ? nullptr : &*found;
}

const std::vector<ComponentType>& component_types() {
    static const std::vector<ComponentType> types = make_types();
    return types;
}

const ComponentType* find_type(const std::string& name) {
    for (const ComponentType& type : component_types()) {
        if (type.name == name) return &type;
    }
    return nullptr;
}

bool is_listed(KeyKind kind) {
    return kind == list || kind == vector || kind == field;
}

bool read_value(const std::string& written, KeyKind kind, Value& value) {
    const std::string text = single_spaced(written);
    if (kind == word || kind == literal || is_listed(kind)) {
        value.parts = split(text, ",");
        return !has_empty(value.parts) && (is_listed(kind) || value.parts.size() == 1);
    }
    const std::vector<std::string> noisy = split(text, " noise ");
    const std::vector<std::string> mapped = split(noisy.front(), " then ");
    value.parts = split(mapped.front(), "..");
    value.is_range = value.parts.size() == 2;
    if (mapped.size() == 2) value.function = mapped.back();
    if (noisy.size() == 2) value.noise = noisy.back();
    return noisy.size() < 3 && mapped.size() < 3 && value.parts.size() < 3 && !has_empty(noisy) && !has_empty(mapped) &&
           !has_empty(value.parts);
}

Value value_of(const Component& component, const std::string& key) {
    if (const Value* value = component.find(key)) return *value;
    const Key* known = find_type(component.type)->find(key);
    Value standard;
    read_value(known->standard, known->kind, standard);
    return standard;
}

std::string describe_types() {
    const auto how = [](KeyKind kind) {
        return kind == instance   ? "; a range is spread over the instances"
               : kind == children ? "; a range is spread over the children"
               : kind == axis     ? "; a range runs along the axis"
               : kind == list     ? "; a list of numbers"
               : kind == vector   ? "; a vector"
               : kind == field    ? "; a field: three functions of x, y, z"
                                  : "";
    };
    const auto standard = [](const Key& key) {
        if (key.standard.empty()) return std::string("none");
        return key.standard.find(' ') == key.standard.npos ? key.standard : fmt::format("[{}]", key.standard);
    };
    std::string text;
    for (const ComponentType& type : component_types()) {
        text += fmt::format("\n{}: {}\n\n", type.name, type.summary);
        for (const Key& key : type.keys) {
            const bool is_word = key.kind == word;
            const std::string range = is_word ? ", or " + key.unit : described_range(key.lowest, key.highest);
            text += fmt::format("  {:13} {}{}{}; {}{}\n", key.name + " ", standard(key),
                                is_word || key.unit.empty() ? "" : " " + key.unit, range, key.summary, how(key.kind));
        }
    }
    return text;
}

}  // namespace espalier::language::pgraph
