// An L-system as data: axiom, productions, decomposition, homomorphism, blocks. Readers fill it, the engine compiles
// it.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/lsystem/alphabet.h"
#include "espalier/lsystem/arithmetic.h"
#include "espalier/lsystem/expression.h"
#include "espalier/lsystem/module_string.h"
#include "espalier/lsystem/resources.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace espalier::lsystem {

/// A module to be written: a letter and one expression per parameter.
struct ModuleTemplate {
    LetterId letter = no_letter;
    std::vector<Expression> arguments;
    Place place;
};

/// A module to be matched. Its parameters bind to formals first_formal, first_formal + 1, ...
/// `skip_branch` is `=` in a right context: skip to the end of the current branch.
struct ModulePattern {
    LetterId letter = no_letter;
    std::uint32_t first_formal = 0;
    bool skip_branch = false;
    Place place;
};

/// left < strict > right : {before} condition {after} --> successor : weight
struct Production {
    std::vector<ModulePattern> left, strict, right;
    std::vector<std::string> formals;
    Block before;
    std::optional<Expression> condition;
    Block after;
    std::vector<ModuleTemplate> successor;
    std::optional<Expression> weight;
    Place place;
};

struct ArrayDeclaration {
    std::string name;
    std::vector<Expression> dimensions;  ///< constant expressions
    std::vector<Expression> values;      ///< constant expressions, row-major; the rest is 0
    bool external = false;
    Place place;
};

/// Decomposition or homomorphism.
struct RuleSet {
    std::vector<Production> productions;
    std::optional<Expression> maximum_depth;  ///< default 1
    std::optional<Expression> seed;
    bool warnings = true;
    bool present = false;
};

struct LSystem {
    std::string label;
    bool ring = false;
    std::optional<Expression> seed;               ///< its presence makes weights legal
    std::optional<Expression> derivation_length;  ///< default 0
    enum class Filter { none, ignore, consider };
    Filter filter = Filter::none;
    std::vector<SymbolId> filtered;
    std::vector<ArrayDeclaration> arrays;
    std::vector<std::string> globals;  ///< index 0 is Q (current step), 1 is Z (derivation length)
    std::vector<std::string> external_globals;
    Block start, start_each, end_each, end;
    std::vector<ModuleTemplate> axiom;
    /// Stands for the axiom, in which each of its letters occurs; null: the axiom stands for itself.
    std::shared_ptr<const ModuleString> given_axiom;
    std::vector<Production> productions;
    RuleSet decomposition, homomorphism;
};

/// A named module's declaration: `module Apex(age, vigour);`
struct ModuleDeclaration {
    std::string name;
    std::vector<std::string> parameters;
};

/// What a model file says: one or more L-systems over one alphabet, and what it declares about the world.
struct Model {
    std::string name;  ///< file name without folder
    std::filesystem::path path;
    Alphabet alphabet;
    std::vector<LSystem> systems;  ///< the first is the main one
    std::vector<ModuleDeclaration> modules;
    std::vector<std::string> processes;  ///< names of `environment light, water;` in order
    /// Of `environment light = 1;`: what the first parameters of a query are answered where there is no such process.
    std::map<std::string, std::vector<double>> default_answers;
    /// Texts that stand among the parameters of modules, as in @L("%d", n); the parameter is an index into them.
    std::vector<std::string> texts;
    /// What side files provide; null if there are none.
    std::shared_ptr<const Resources> resources;
    Arithmetic arithmetic = Arithmetic::double_precision;

    const LSystem& main() const { return systems.front(); }
};

}  // namespace espalier::lsystem
