// Numbers modules in the order of their births. Identities are as large as 64 bits and mean nothing by themselves;
// these numbers are small, so that programs that keep a number as a float tell modules apart.
#pragma once

#include "espalier/lsystem/module_string.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace espalier::lsystem {

/// How many modules of a string with lineage were born in `step`, the last that it has seen.
std::size_t births_in(const ModuleString& string, std::uint32_t step);
/// Gives them numbers from `first` on, in the order of the string. To do so again changes nothing.
void number_births(ModuleString& string, std::uint32_t step, std::uint64_t first);

/// The numbers of a plant that grows anew in every step: a module that was there before keeps its number, whatever
/// else is born before it this time.
class KeptNumbers {
public:
    /// How many modules of the string have none yet.
    std::size_t unknown(const ModuleString& string) const;
    /// Those that have none yet get the numbers from `first` on.
    void number(ModuleString& string, std::uint64_t first);

    void save(std::ostream& out) const;
    void restore(std::istream& in);

private:
    std::unordered_map<Identity, std::uint64_t> numbers_;
};

}  // namespace espalier::lsystem
