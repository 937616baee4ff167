#include "language/sdl/parser.h"

#include "base/text.h"
#include "language/sdl/formula.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace espalier::language::sdl {
namespace {

constexpr int most_generations = 100000, most_slaves = 1000, most_depth = 50;
const std::array<std::string, 5> attribute_names{"length", "vertical", "horizontal", "generation", "i"};
const std::array<std::string, 4> weight_names{"length", "vertical", "horizontal", "generation"};

class SkeletonParser {
public:
    SkeletonParser(TokenReader& in, Mistakes& mistakes) : in_(in), mistakes_(mistakes) {}

    Skeleton skeleton() {
        if (in_.at_end()) throw SyntaxError{in_.next().at, "there is no skeleton here; it begins with 'define {'"};
        open_block("define", "a skeleton begins with its components");
        statements("define", [&] { component(); });
        open_block("rules", "the rules follow the components");
        statements("rules", [&] { rule(); });
        while (!in_.at_end()) further_block();
        return std::move(skeleton_);
    }

private:
    void open_block(const char* word, const char* why) {
        const std::array<std::string, 1> known{word};
        if (!in_.accept(word)) in_.fail(fmt::format("'{}': {}", word, why), known);
        in_.expect("{", fmt::format("after '{}'", word));
    }

    /// Statements up to the brace that ends the block. A mistake ends the statement, not the block.
    template <class Statement>
    void statements(const char* block, Statement statement) {
        while (!in_.accept("}")) {
            if (in_.at_end()) in_.fail(fmt::format("'}}' at the end of '{}'", block));
            try {
                statement();
            } catch (const SyntaxError& mistake) {
                mistakes_.error(mistake);
                in_.skip_statement();
            }
        }
    }

    // #const_ver name[beginning, length, vertical, horizontal];
    void component() {
        Component component;
        while (in_.next().kind == Token::Kind::directive) prefix(component);
        component.at = in_.next().at;
        component.name = in_.expect_name("the name of a component").text;
        skeleton_.components.push_back(component);  // known from here on, whatever is wrong with its features
        in_.expect("[", fmt::format("before the features of '{}'", component.name));
        component.is_null = in_.accept("NULL");
        const std::array<std::string, 1> null{"NULL"};
        const bool is_nearly_null = !nearest_name(in_.next().text, null).empty();
        if (!component.is_null && is_nearly_null) in_.fail("NULL or a beginning", null);
        if (component.is_null && in_.looking_at(",")) in_.fail("']': a component that is NULL has no features");
        if (!component.is_null) features(component);
        in_.expect("]", fmt::format("after the features of '{}'", component.name));
        in_.expect(";", "after a component");
        skeleton_.components.back() = component;
    }

    void prefix(Component& component) {
        const std::array<std::string, 2> known{"#const_ver", "#const_hor"};
        bool& is_constant = in_.looking_at(known[0]) ? component.constant_ver : component.constant_hor;
        if (!in_.looking_at(known[0]) && !in_.looking_at(known[1])) in_.fail("#const_ver or #const_hor", known);
        if (is_constant) throw SyntaxError{in_.next().at, in_.next().text + " is said twice"};
        is_constant = true;
        in_.take();
    }

    /// Features that are left out at the end are 0.
    void features(Component& component) {
        for (std::size_t k = 0; k < component.features.size(); ++k) {
            if (k > 0 && in_.looking_at("]")) return;
            if (k > 0 && !in_.accept(",")) {
                in_.fail(fmt::format(
                    "',' and the {} of '{}', or ']': a component has a beginning, a length, a vertical and a "
                    "horizontal angle",
                    Component::feature_names[k], component.name));
            }
            component.features[k] =
                attribute(fmt::format("the {} of '{}'", Component::feature_names[k], component.name));
        }
        if (in_.looking_at(",")) in_.fail("']': a component has four features");
    }

    Attribute attribute(const std::string& what) {
        Attribute attribute;
        attribute.at = in_.next().at;
        attribute.middle = parse_formula(in_, attribute_names, what);
        if (!in_.accept(":")) return attribute;
        const Location at = in_.next().at;
        attribute.deviation = parse_formula(in_, attribute_names, "the deviation of " + what);
        if (attribute.deviation->number.value_or(0) < 0) {
            throw SyntaxError{at, fmt::format("the deviation of {} is the largest distance from the middle, 0 or "
                                              "more, not {}",
                                              what, attribute.deviation->text)};
        }
        if (in_.looking_at(":")) in_.fail(fmt::format("',' or ']': {} has one deviation", what));
        return attribute;
    }

    // master -> (a b*3(c d)) : weight | () : weight;
    void rule() {
        Rule rule;
        rule.at = in_.next().at;
        rule.master = in_.expect_name("the component on the left side of a rule").text;
        in_.expect("->", fmt::format("after '{}'", rule.master));
        do {
            rule.right_sides.push_back(right_side());
        } while (in_.accept("|"));
        in_.expect(";", "after a rule");
        skeleton_.rules.push_back(std::move(rule));
    }

    RightSide right_side() {
        RightSide side;
        side.slaves = slaves(1);
        if (!in_.accept(":")) return side;
        const Location at = in_.next().at;
        side.weight = parse_formula(in_, weight_names, "the weight of a right side");
        if (side.weight->number.value_or(0) < 0) {
            throw SyntaxError{at, fmt::format("a weight is 0 or more, not {}", side.weight->text)};
        }
        return side;
    }

    std::vector<Slave> slaves(int depth) {
        if (depth > most_depth) throw SyntaxError{in_.next().at, "the branches are nested more than 50 deep"};
        in_.expect("(", "before the slaves");
        std::vector<Slave> list;
        while (!in_.accept(")")) {
            if (in_.looking_at(",")) in_.fail("a component: slaves are separated by blanks");
            if (in_.next().kind != Token::Kind::name) in_.fail("a component or ')'");
            Slave slave;
            slave.at = in_.next().at;
            slave.component = in_.expect_name("a component").text;
            if (is_row_of_letters(slave.component)) {
                const std::string letters = slave.component;
                for (std::size_t i = 0; i < letters.size(); ++i) {
                    slave.component = letters[i];
                    if (i + 1 < letters.size()) list.push_back(slave);
                }
            }
            if (in_.accept("*")) slave.count = in_.expect_whole("the count of a cycle", 0, most_slaves);
            if (in_.looking_at("(")) slave.slaves = slaves(depth + 1);
            list.push_back(std::move(slave));
        }
        return list;
    }

    bool is_known(const std::string& name) const {
        return std::any_of(skeleton_.components.begin(), skeleton_.components.end(),
                           [&](const Component& component) { return component.name == name; });
    }

    /// As the paper writes (A B(CD)E): no component has this name, but each of its letters is one.
    bool is_row_of_letters(const std::string& name) const {
        return !is_known(name) &&
               std::all_of(name.begin(), name.end(), [&](char letter) { return is_known(std::string(1, letter)); });
    }

    void further_block() {
        const std::array<std::string, 2> known{"fibres", "generations"};
        if (in_.accept("fibres")) {
            in_.expect("{", "after 'fibres'");
            for (Fibre& fibre : parse_fibres(in_, mistakes_)) skeleton_.fibres.push_back(std::move(fibre));
        } else if (in_.looking_at("generations")) {
            if (skeleton_.says_generations) throw SyntaxError{in_.next().at, "'generations' is said twice"};
            skeleton_.generations_at = in_.take().at;
            skeleton_.generations = in_.expect_whole("the number of generations", 0, most_generations);
            skeleton_.says_generations = true;
            in_.expect(";", "after the number of generations");
        } else {
            in_.fail("'fibres', 'generations' or the end of the file", known);
        }
    }

    TokenReader& in_;
    Mistakes& mistakes_;
    Skeleton skeleton_;
};

}  // namespace

Skeleton parse(const std::string& text, const std::string& file) {
    Sources sources;
    const std::uint32_t number = sources.add(file, text);
    Mistakes mistakes(sources);
    Skeleton skeleton;
    try {
        TokenReader in(tokens_of(text, number, mistakes));
        try {
            // Characters that belong to no token would bring further mistakes, which are none.
            if (mistakes.none()) {
                skeleton = SkeletonParser(in, mistakes).skeleton();
                check(skeleton, mistakes);
            }
        } catch (const SyntaxError& mistake) {
            mistakes.error(mistake);
        }
    } catch (const TooManyMistakes&) {
        // Those found so far are reported.
    }
    if (!mistakes.none()) throw UserError(mistakes.errors());
    return skeleton;
}

}  // namespace espalier::language::sdl
