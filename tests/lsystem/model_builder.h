// Builds small models by hand, so that the engine is tested without a reader.
#pragma once

#include "espalier/lsystem/derivation.h"

#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace espalier::test {

using namespace espalier::lsystem;

inline Expression number(double value) {
    return Expression::number(value);
}

inline Expression formal(std::uint32_t index) {
    Expression expression;
    expression.kind = Expression::Kind::formal;
    expression.index = index;
    return expression;
}

inline Expression global(std::uint32_t index) {
    Expression expression;
    expression.kind = Expression::Kind::global;
    expression.index = index;
    return expression;
}

inline Expression element(std::uint32_t array, std::vector<Expression> subscripts) {
    Expression expression;
    expression.kind = Expression::Kind::element;
    expression.index = array;
    expression.operands = std::move(subscripts);
    return expression;
}

inline Expression text(std::string value) {
    Expression expression;
    expression.kind = Expression::Kind::text;
    expression.text = std::move(value);
    return expression;
}

inline Expression apply(Operator op, std::vector<Expression> operands) {
    Expression expression;
    expression.kind = Expression::Kind::apply;
    expression.op = op;
    expression.operands = std::move(operands);
    expression.place = {"model.l", 7, 3};
    return expression;
}

inline Expression call(Function function, std::vector<Expression> operands) {
    Expression expression;
    expression.kind = Expression::Kind::call;
    expression.function = function;
    expression.operands = std::move(operands);
    expression.place = {"model.l", 8, 5};
    return expression;
}

inline Expression choose(Expression condition, Expression then, Expression otherwise) {
    Expression expression;
    expression.kind = Expression::Kind::conditional;
    expression.operands = {std::move(condition), std::move(then), std::move(otherwise)};
    return expression;
}

inline Expression operator+(Expression a, Expression b) {
    return apply(Operator::add, {std::move(a), std::move(b)});
}
inline Expression operator-(Expression a, Expression b) {
    return apply(Operator::subtract, {std::move(a), std::move(b)});
}
inline Expression operator*(Expression a, Expression b) {
    return apply(Operator::multiply, {std::move(a), std::move(b)});
}
inline Expression operator/(Expression a, Expression b) {
    return apply(Operator::divide, {std::move(a), std::move(b)});
}
inline Expression operator<(Expression a, Expression b) {
    return apply(Operator::less, {std::move(a), std::move(b)});
}

inline Statement assign(Expression target, Expression value) {
    Expression expression;
    expression.kind = Expression::Kind::assign;
    expression.operands = {std::move(target), std::move(value)};
    Statement statement;
    statement.expressions.emplace_back(std::move(expression));
    return statement;
}

inline Statement run(Expression expression) {
    Statement statement;
    statement.expressions.emplace_back(std::move(expression));
    return statement;
}

inline Statement while_loop(Expression condition, Block body) {
    Statement statement;
    statement.kind = Statement::Kind::while_loop;
    statement.expressions.emplace_back(std::move(condition));
    statement.bodies.push_back(std::move(body));
    statement.place = {"model.l", 9, 2};
    return statement;
}

/// A symbol with its number of parameters, as a pattern.
struct Pattern {
    std::string symbol;
    int arity = 0;
};

class ModelBuilder {
public:
    ModelBuilder() : model_(std::make_shared<Model>()) {
        model_->name = "model.l";
        model_->systems.emplace_back();
        system().globals = {"Q", "Z"};
    }

    LSystem& system() { return model_->systems.front(); }
    Model& model() { return *model_; }

    std::uint32_t add_global(const std::string& name) {
        system().globals.push_back(name);
        return static_cast<std::uint32_t>(system().globals.size() - 1);
    }

    /// Modules without parameters, one per character.
    std::vector<ModuleTemplate> word(std::string_view symbols) {
        std::vector<ModuleTemplate> modules;
        for (const char symbol : symbols) modules.push_back(module(std::string(1, symbol), {}));
        return modules;
    }

    ModuleTemplate module(const std::string& symbol, std::vector<Expression> arguments) {
        const LetterId letter = model_->alphabet.letter(symbol, static_cast<int>(arguments.size()));
        return {letter, std::move(arguments), {}};
    }

    /// Patterns without parameters, one per character; `=` skips to the end of a branch.
    static std::vector<Pattern> patterns(std::string_view symbols) {
        std::vector<Pattern> all;
        for (const char symbol : symbols) all.push_back({std::string(1, symbol), 0});
        return all;
    }

    /// Formals are numbered in the order left, strict, right.
    Production make(const std::vector<Pattern>& left, const std::vector<Pattern>& strict,
                    const std::vector<Pattern>& right, std::vector<ModuleTemplate> successor) {
        Production production;
        production.left = bound(left, production);
        production.strict = bound(strict, production);
        production.right = bound(right, production);
        production.successor = std::move(successor);
        production.place = {"model.l", static_cast<int>(system().productions.size()) + 1, 1};
        return production;
    }

    Production& rule(const std::vector<Pattern>& strict, std::vector<ModuleTemplate> successor) {
        return add(make({}, strict, {}, std::move(successor)));
    }
    Production& rule(std::string_view left, std::string_view strict, std::string_view right,
                     std::string_view successor) {
        return add(make(patterns(left), patterns(strict), patterns(right), word(successor)));
    }
    Production& rule(std::string_view strict, std::string_view successor) { return rule("", strict, "", successor); }
    Production& add(Production production) {
        system().productions.push_back(std::move(production));
        return system().productions.back();
    }

    std::shared_ptr<const CompiledModel> compiled() { return compile(model_); }

private:
    static std::string made_name(int index) {
        std::string name = std::to_string(index);
        name.insert(name.begin(), 'p');
        return name;
    }

    std::vector<ModulePattern> bound(const std::vector<Pattern>& patterns, Production& production) {
        std::vector<ModulePattern> all;
        for (const Pattern& pattern : patterns) {
            ModulePattern made;
            made.skip_branch = pattern.symbol == "=";
            if (!made.skip_branch) made.letter = model_->alphabet.letter(pattern.symbol, pattern.arity);
            made.first_formal = static_cast<std::uint32_t>(production.formals.size());
            for (int k = 0; k < pattern.arity; ++k) production.formals.push_back(made_name(k));
            all.push_back(made);
        }
        return all;
    }

    std::shared_ptr<Model> model_;
};

inline DerivationSettings with_lineage(std::uint64_t seed = 1, std::uint32_t plant = 0) {
    DerivationSettings settings;
    settings.seed = seed;
    settings.plant = plant;
    settings.lineage = true;
    return settings;
}

inline std::vector<Identity> identities_of(const ModuleString& string) {
    std::vector<Identity> all;
    for (std::size_t i = 0; i < string.births.size(); ++i) all.push_back(string.identity(i));
    return all;
}

/// The same modules, who are the same, have the same parents and are as old.
inline bool same(const ModuleString& a, const ModuleString& b) {
    if (a.letters != b.letters || a.parameters != b.parameters || a.has_lineage() != b.has_lineage()) return false;
    for (std::size_t i = 0; i < a.births.size(); ++i) {
        if (a.identity(i) != b.identity(i) || a.parent(i) != b.parent(i)) return false;
        if (a.step_of_birth(i) != b.step_of_birth(i)) return false;
    }
    return true;
}

/// The string after some steps.
inline ModuleString grow(Derivation& derivation, int steps) {
    ModuleString string, next;
    derivation.start(string);
    for (int k = 0; k < steps; ++k) {
        derivation.step(string, next);
        std::swap(string, next);
    }
    return string;
}

inline std::string text_after(ModelBuilder& builder, int steps, DerivationSettings settings = {}) {
    const std::shared_ptr<const CompiledModel> compiled = builder.compiled();
    Derivation derivation(compiled, std::move(settings));
    return to_text(grow(derivation, steps), builder.model().alphabet);
}

}  // namespace espalier::test
