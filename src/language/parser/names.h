// What the names of an L-system mean: formal parameters, constants, arrays, variables.
#pragma once

#include "espalier/lsystem/lsystem.h"

#include "language/text/source.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace espalier::language {

/// Any name assigned somewhere is a global variable of its L-system, wherever it is read; which names are never
/// assigned is known at the end only, because other L-systems of the file may share them.
class Names {
public:
    Names(const Sources& sources, Mistakes& mistakes, const std::set<std::string>& macros)
        : sources_(sources), mistakes_(mistakes), macros_(macros) {}

    /// `number` is the L-system's place in the model.
    void begin(LSystem& system, std::size_t number = 0);
    /// At the end of an L-system: puts in pi and e.
    void finish();
    /// At the end of the file: warns of variables that are read and never assigned, gives external arrays their sizes.
    void finish_model(Model& model);

    /// Null outside productions.
    void set_formals(const std::vector<std::string>* formals) { formals_ = formals; }
    /// While set, only constants may be read.
    void set_constants_only(bool only) { constants_only_ = only; }
    void define_constant(std::string_view name, double value, Location at);
    void add_external(std::string_view name);
    void add_array(ArrayDeclaration array, Location at);

    Expression read(std::string_view name, Location at);
    /// A variable to be assigned. Reports names that cannot be.
    Expression assigned(std::string_view name, Location at);
    /// Counts the names that a skipped piece of text assigns as assigned, so that one mistake does not beget others.
    void note_skipped(std::string_view text);
    std::optional<std::uint32_t> array(std::string_view name) const;
    /// The same, where `name` stands before a subscript: an external name becomes an array by that.
    std::optional<std::uint32_t> subscripted(std::string_view name, Location at);
    /// Reports a wrong number of subscripts; of an external array at the end, when its declaration is known.
    void check_subscripts(std::uint32_t array, std::size_t count, Location at);
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
    /// True if the production at hand has a parameter of this name, which `result` then is.
    bool take_formal(std::string_view name, Expression& result) const;
    std::vector<std::string> known_names(const std::vector<std::string>* formals) const;
    std::string unknown(std::string_view name, const std::vector<std::string>* formals) const;
    void put_in_constants();
    static void size_external_array(const Model& model, ArrayDeclaration& array);
    void wrong_subscripts(const ArrayDeclaration& array, std::size_t count, Location at);

    /// An external array whose declaration stands elsewhere, or its use with `count` subscripts.
    struct ExternalElement {
        std::size_t system;
        std::uint32_t array;
        std::size_t count;
        Location at;
    };
    /// A variable that is read and not assigned in its own L-system.
    struct Unassigned {
        Location at;
        std::string name;
        std::string message;
    };

    const Sources& sources_;
    Mistakes& mistakes_;
    const std::set<std::string>& macros_;
    LSystem* system_ = nullptr;
    const std::vector<std::string>* formals_ = nullptr;
    bool constants_only_ = false;
    std::map<std::string, double, std::less<>> constants_;
    std::unordered_map<std::string, std::uint32_t> ids_;
    std::unordered_map<std::string, std::uint32_t> array_ids_;
    std::vector<Variable> variables_;
    std::size_t system_number_ = 0;
    std::vector<Unassigned> unassigned_;
    std::vector<ExternalElement> external_elements_;
    std::set<std::string> shared_;  // names some L-system calls external
};

}  // namespace espalier::language
