// Modules that are put into a plant's string while it grows.
#pragma once

#include "espalier/lsystem/module_string.h"
#include "espalier/simulation/scene.h"

#include <set>
#include <vector>

namespace espalier::simulation {

/// "X(1)@5": at the beginning of the string of step 5; "X(1)@5:F" before its first F; "X(1)@5:F.3" before the third.
/// Throws UserError at `place` for anything else.
Insertion read_insertion(const std::string& text, const Place& place);

/// A plant's insertions, in the letters of its model.
class Insertions {
public:
    /// Throws UserError for modules that the model does not know.
    explicit Insertions(const Plant& plant);

    std::set<LetterId> letters() const;
    /// Those of the step. The modules are born in it, of no parent. Throws UserError if there is no such place.
    void apply(int step, ModuleString& string) const;

private:
    struct Modules {
        const Insertion* insertion;
        std::vector<LetterId> letters;
        std::vector<double> parameters;
    };
    std::size_t place_of(const Insertion& insertion, const ModuleString& string) const;
    void put(const Modules& modules, std::uint64_t number, std::size_t at, ModuleString& string) const;

    const Alphabet& alphabet_;
    std::uint32_t stream_;
    std::vector<Modules> all_;
};

}  // namespace espalier::simulation
