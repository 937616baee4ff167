// What a text in Szemla's skeleton description language says: components, rules, and the fibres they become.
// L. Szemla, "3D models generator simulating a grow of natural objects for virtual reality", Brno 1999.
#pragma once

#include "language/text/source.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace espalier::language::sdl {

/// A number, or an expression of the model's language. `text` is written so that it can stand in a sum; its words are
/// marked with their places.
struct Formula {
    std::string text = "0";
    std::optional<double> number = 0;  ///< its value, if it is known
    bool is_product = true;            ///< may stand in a product without parentheses
};

/// An attribute of a component, relative to its master: a middle value and the largest deviation from it.
struct Attribute {
    Formula middle;
    std::optional<Formula> deviation;  ///< mutating
    Location at;
};

struct Component {
    enum Feature { beginning, length, vertical, horizontal };
    static constexpr std::array<const char*, 4> feature_names{"beginning", "length", "vertical angle",
                                                              "horizontal angle"};

    std::string name;
    bool is_null = false;       ///< has no curve: its slaves hang on its master
    bool constant_ver = false;  ///< its vertical angle is not relative to the master
    bool constant_hor = false;  ///< the same of the horizontal angle
    std::array<Attribute, 4> features;
    Location at;
};

/// A component on the right side of a rule, and those it is the master of.
struct Slave {
    std::string component;
    int count = 1;  ///< turns of a cycle
    std::vector<Slave> slaves;
    Location at;
};

/// One of the right sides of a rule.
struct RightSide {
    std::vector<Slave> slaves;
    std::optional<Formula> weight;
};

struct Rule {
    std::string master;
    std::vector<RightSide> right_sides;
    Location at;
};

/// How the skeleton of some components is developed.
struct Fibre {
    enum class Type { wooden, leaf };
    struct Correction {
        double amplitude = 0, bumps = 0;
    };

    Type type = Type::wooden;
    std::vector<std::string> components;  ///< empty: all that no other set names
    bool is_flat = false;
    Formula width{"0.05 * length", {}, true}, thickness{"0.05 * length", {}, true};
    std::vector<std::vector<double>> rings;  ///< strengths of the magnets, from the beginning to the end of the fibre
    std::vector<double> contour;             ///< degrees that equal parts of the fibre bend by
    std::optional<Correction> correction;
    int sections = 6, magnets = 8;  ///< quality: rings along the fibre, magnets per ring
    std::optional<double> colour, texture;
    Location at;
};

struct Skeleton {
    std::vector<Component> components;
    std::vector<Rule> rules;
    std::vector<Fibre> fibres;
    int generations = 5;
    bool says_generations = false;
    Location generations_at;

    const Component* component(const std::string& name) const;
    const Rule* rule_of(const std::string& master) const;
    /// That a component becomes; null for one that stays a line.
    const Fibre* fibre_of(const std::string& component) const;
    /// The left side of the first rule, or the first component, which there must be.
    const Component& start() const;
};

/// Throws UserError with every mistake found, each at its own place.
Skeleton parse(const std::string& text, const std::string& file);

/// The text of a skeleton, which parses as the same skeleton.
std::string to_text(const Skeleton& skeleton);

}  // namespace espalier::language::sdl
