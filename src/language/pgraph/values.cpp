#include "language/pgraph/values.h"

#include "espalier/language/model_settings.h"

#include "base/characters.h"
#include "base/text.h"
#include "language/parser/vector_field.h"
#include "language/text/marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace espalier::language::pgraph {
namespace {

/// The names that differ from instance to instance, and the random numbers, each with a value to try expressions with.
const std::string trial =
    "#define i 1\n#define n 3\n#define u 0.5\n#define depth 1\n#define x 0.5\n"
    "#define ran(a) ((a) * 0.5)\n#define nran(a, b) (a)\n#define bran(a, b) 0.5\n#define biran(a, b) (a)\n";

bool differs_by_instance(const std::string& expression) {
    Names marks;
    for (const char* name : {"i", "n", "u", "depth", "ran", "nran", "bran", "biran"})
        marks.emplace(name, std::string(1, '?'));
    return substituted(expression, marks) != expression;
}

class Check {
public:
    explicit Check(const Graph& graph) : graph_(graph), trial_(ModelSettings::parse(definitions() + trial, "trial")) {}

    void run() {
        for (const Component& component : graph_.components) {
            for (const KeyValue& each : component.keys) {
                check(*find_type(component.type)->find(each.key), each.value);
            }
            if (component.type == "FFD") check_deformation(component);
            if (const Value* curve = component.find("curve")) check_curve(component, *curve);
        }
        if (!mistakes_.empty()) throw UserError(mistakes_);
    }

    std::optional<double> value_of(const std::string& expression, const Place& place) {
        return value_of(expression, place, {});
    }

    /// The value with names replaced by numbers.
    std::optional<double> value_of(const std::string& expression, const Place& place, const Names& names) {
        try {
            return trial_.value(substituted(expression, names));
        } catch (const UserError& error) {
            report(place, fmt::format("'{}' is no expression: {}", expression, error.what()));
            return std::nullopt;
        }
    }

private:
    std::string definitions() const {
        std::string text;
        for (const Define& define : graph_.defines) text += define.text + "\n";
        return text;
    }

    void check(const Key& key, const Value& value) {
        if (key.kind == KeyKind::word) return check_word(key, value);
        if (key.kind == KeyKind::field) return check_field(key, value);
        for (const std::string& part : value.parts) check_number(key, part, value.place);
        if (!value.function.empty()) value_of(value.function, value.place);
        if (!value.noise.empty()) value_of(value.noise, value.place);
        if (!value.noise.empty() && (key.kind == KeyKind::axis || key.name == "at")) {
            report(value.place, fmt::format("'{}' takes no noise; write ran() into its ends instead", key.name));
        }
        if (key.kind == KeyKind::axis && differs_by_instance(value.function)) {
            report(value.place, fmt::format("the function of '{}' is one of x alone", key.name));
        }
        const bool differs = std::any_of(value.parts.begin(), value.parts.end(), differs_by_instance);
        if (key.kind == KeyKind::list && differs) {
            report(value.place, fmt::format("the numbers of '{}' are the same for all instances", key.name));
        }
        if (key.kind == KeyKind::vector) check_count(key, value);
        if (key.kind == KeyKind::list && value.parts.size() < 2) {
            report(value.place, fmt::format("'{}' needs two numbers or more", key.name));
        }
    }

    void check_count(const Key& key, const Value& value) {
        if (value.parts.size() != 3) report(value.place, fmt::format("'{}' is x, y, z", key.name));
    }

    void check_field(const Key& key, const Value& value) {
        const std::string& first = value.parts.front();
        if (value.parts.size() == 1 && VectorField::length_of_reading(first) == first.size()) return;
        if (value.parts.size() != 3) {
            return report(value.place, fmt::format("'{}' is x, y, z, or gradient(FIELD) or vector(FIELD)", key.name));
        }
        for (const std::string& part : value.parts) {
            if (differs_by_instance(part)) {
                report(value.place, fmt::format("'{}' is a function of the place x, y, z alone", key.name));
            }
            value_of(part, value.place, {{"x", "0.3"}, {"y", "0.5"}, {"z", "0.7"}});
        }
    }

    // What a curve decides, the other keys of an axis cannot.
    void check_curve(const Component& component, const Value& curve) {
        const std::vector<std::string>& parts = curve.parts;
        const auto number = [&](std::size_t k) { return value_of(parts[k], curve.place).value_or(0); };
        if (parts.size() < 6 || parts.size() % 3 != 0 || number(0) != 0 || number(1) != 0 || number(2) != 0) {
            return report(curve.place, "'curve' is x, y, z of two points or more, the first of which is 0, 0, 0");
        }
        for (std::size_t k = 3; k < parts.size(); k += 3) {
            if (number(k) != number(k - 3) || number(k + 1) != number(k - 2) || number(k + 2) != number(k - 1))
                continue;
            report(curve.place, "two successive points of 'curve' are the same");
        }
        for (const char* key : {"length", "bend", "sway"}) {
            const Value* other = component.find(key);
            if (other) report(other->place, fmt::format("'{}' follows from 'curve'; leave one of them out", key));
        }
        const Value pieces = pgraph::value_of(component, "pieces");
        const std::string& count = pieces.parts.front();
        if (pieces.is_range || !std::all_of(count.begin(), count.end(), is_digit)) {
            report(pieces.place, "'pieces' of a horn with a 'curve' is a whole number in digits");
        }
    }

    // The lattice says how many moves there are; all numbers are those of the component, not of an instance.
    void check_deformation(const Component& component) {
        const Value* moves = component.find("moves");
        if (!moves) {
            return report(component.place, "an FFD needs 'moves': x, y, z for each of the points of its lattice");
        }
        std::size_t points = 1;
        const Value lattice = pgraph::value_of(component, "lattice");
        for (const std::string& part : lattice.parts) {
            const double count = value_of(part, lattice.place).value_or(0);
            if (count != std::floor(count)) report(lattice.place, "'lattice' is three whole numbers");
            points *= static_cast<std::size_t>(std::clamp(count, 0.0, 16.0));
        }
        if (moves->parts.size() != 3 * points) {
            report(moves->place,
                   fmt::format("'moves' needs x, y, z for each of the {} points of the lattice: {} numbers, "
                               "not {}",
                               points, 3 * points, moves->parts.size()));
        }
        for (const KeyValue& each : component.keys) {
            if (!is_listed(find_type("FFD")->find(each.key)->kind)) continue;
            for (const std::string& part : each.value.parts) {
                if (!differs_by_instance(part)) continue;
                report(each.value.place, fmt::format("'{}' is the same for all instances", each.key));
            }
        }
    }

    void check_word(const Key& key, const Value& value) {
        const std::vector<std::string> words = words_of(key.unit, "|");
        const std::string& word = value.parts.front();
        if (std::find(words.begin(), words.end(), word) != words.end()) return;
        report(value.place, fmt::format("'{}' is {}, not '{}'{}", key.name, key.unit, word, did_you_mean(word, words)));
    }

    // The function may bring a number into its range, so only bare constants are held against it.
    void check_number(const Key& key, const std::string& expression, const Place& place) {
        const std::optional<double> number = value_of(expression, place);
        const bool is_literal = key.kind == KeyKind::literal;
        const auto is_digits = [](const std::string& text) { return std::all_of(text.begin(), text.end(), is_digit); };
        if (key.name == "sides" && (number == 1 || number == 2)) {
            return report(place, fmt::format("'sides' is 0, or from 3 to {} around a closed surface, not {}",
                                             format_general(key.highest), expression));
        }
        if (is_literal && !is_digits(expression)) {
            return report(place, fmt::format("'{}' is a whole number in digits, not '{}'", key.name, expression));
        }
        if (!number || differs_by_instance(expression)) return;
        if (*number >= key.lowest && *number <= key.highest) return;
        const std::string low = format_general(key.lowest);
        const std::string range = std::isfinite(key.highest)
                                      ? fmt::format("from {} to {}", low, format_general(key.highest))
                                      : "at least " + low;
        report(place, fmt::format("'{}' must be {}{}, not {}", key.name, range, key.unit.empty() ? "" : " " + key.unit,
                                  format_general(*number)));
    }

    void report(const Place& place, const std::string& message) {
        mistakes_.push_back({Diagnostic::Severity::error, place, message});
    }

    const Graph& graph_;
    ModelSettings trial_;
    std::vector<Diagnostic> mistakes_;
};

}  // namespace

void check_values(const Graph& graph) {
    Check(graph).run();
}

std::vector<double> numbers_of(const Graph& graph, const Value& list) {
    std::vector<double> numbers;
    for (const std::string& part : list.parts) numbers.push_back(*Check(graph).value_of(part, list.place));
    return numbers;
}

Values::Values(const Component& component, const Structure& structure, const Origins& origins)
    : component_(component), origins_(origins), depth_("1") {
    const std::vector<std::string>& heads = structure.enclosing_recursions(component.name);
    if (!heads.empty()) depth_ = "depth_" + heads.back();
}

std::string Values::expression(const Value& value, std::size_t k, const std::string& text, Names names) const {
    names.insert({{"u", "(i / max(n - 1, 1))"}, {"depth", depth_}});
    return origins_.written(text, value.place_of(k), names);
}

std::string Values::function_of(const Value& value, const std::string& argument) const {
    if (value.function.empty()) return argument;
    return expression(value, value.parts.size(), value.function, {{"x", "(" + argument + ")"}});
}

std::string Values::number(const std::string& key) const {
    const Value value = value_of(component_, key);
    std::string text = expression(value, 0, value.parts.front());
    if (value.is_range)
        text = fmt::format("lerp({}, {}, i / max(n - 1, 1))", text, expression(value, 1, value.parts.back()));
    text = function_of(value, text);
    if (!value.noise.empty()) {
        const std::size_t k = value.columns.empty() ? 0 : value.columns.size() - 1;
        text = fmt::format("{} + ({}) * (ran(2) - 1)", text, expression(value, k, value.noise));
    }
    return origins_.marked(text, value.place);
}

std::string Values::whole(const std::string& key) const {
    const std::string text = number(key), plain = without_marks(text);
    return std::all_of(plain.begin(), plain.end(), is_digit) ? plain : "round(" + text + ")";
}

std::vector<std::pair<std::string, std::string>> Values::parameters(const std::string& key) const {
    if (find_type(component_.type)->find(key)->kind != KeyKind::axis) return {{key, number(key)}};
    const Value value = value_of(component_, key);
    if (!value.is_range) return {{key, expression(value, 0, value.parts.front())}};
    return {{key + "0", expression(value, 0, value.parts.front())},
            {key + "1", expression(value, 1, value.parts.back())}};
}

std::string Values::along(const std::string& key, const std::string& part) const {
    const Value value = value_of(component_, key);
    const std::string text = value.is_range ? fmt::format("lerp({0}0, {0}1, {1})", key, part) : key;
    return origins_.marked(function_of(value, text), value.place);
}

}  // namespace espalier::language::pgraph
