// What the names of an L-system mean: formal parameters, constants, arrays, variables.
#pragma once

#include "espalier/lsystem/lsystem.h"

#include "language/source.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace espalier::language {

/// Any name assigned somewhere is a global variable, wherever it is read; which names are never assigned is known
/// at the end of the L-system only.
class Names {
public:
    Names(const Sources& sources, Mistakes& mistakes, const std::set<std::string>& macros)
        : sources_(sources), mistakes_(mistakes), macros_(macros) {}

    void begin(LSystem& system);
    /// Reports variables that are read and never assigned; puts in pi and e.
    void finish();

    /// Null outside productions.
    void set_formals(const std::vector<std::string>* formals) { formals_ = formals; }
    /// While set, only constants may be read.
    void set_constants_only(bool only) { constants_only_ = only; }
    void define_constant(std::string_view name, double value, Location at);
    void add_external(std::string_view name);
    void add_array(ArrayDeclaration array) { system_->arrays.push_back(std::move(array)); }

    Expression read(std::string_view name, Location at);
    /// A variable to be assigned. Reports names that cannot be.
    Expression assigned(std::string_view name, Location at);
    /// Counts the names that a skipped piece of text assigns as assigned, so that one mistake does not beget others.
    void note_skipped(std::string_view text);
    std::optional<std::uint32_t> array(std::string_view name) const;
    std::size_t dimensions(std::uint32_t array) const { return system_->arrays[array].dimensions.size(); }
    /// " (did you mean 'x'?)" among everything that may be read here.
    std::string suggestion(std::string_view name) const;

    Place place(Location at) const { return sources_.place(at); }

private:
    struct Variable {
        bool assigned = false;
        std::optional<Location> read;
        std::vector<std::string> formals;  // where it was first read
    };
    std::uint32_t variable(std::string_view name);
    std::vector<std::string> known_names(const std::vector<std::string>* formals) const;
    std::string unknown(std::string_view name, const std::vector<std::string>* formals) const;
    void put_in_constants();

    const Sources& sources_;
    Mistakes& mistakes_;
    const std::set<std::string>& macros_;
    LSystem* system_ = nullptr;
    const std::vector<std::string>* formals_ = nullptr;
    bool constants_only_ = false;
    std::map<std::string, double, std::less<>> constants_;
    std::unordered_map<std::string, std::uint32_t> ids_;
    std::vector<Variable> variables_;
};

}  // namespace espalier::language
