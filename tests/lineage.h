// Lineages for strings that are made by hand.
#pragma once

#include "espalier/lsystem/module_string.h"

namespace espalier::test {

/// The value that mix() turns into this one.
constexpr std::uint64_t unmixed(std::uint64_t value) {
    const auto undo_shift = [](std::uint64_t shifted, int by) {
        std::uint64_t made = shifted;
        for (int k = by; k < 64; k += by) made = shifted ^ (made >> by);
        return made;
    };
    value = undo_shift(value, 31) * 0x319642B2D24D8EC3u;
    value = undo_shift(value, 27) * 0x96DE1B173F119089u;
    return undo_shift(value, 30) - 0x9E3779B97F4A7C15u;
}
static_assert(unmixed(mix(12345)) == 12345);

/// Makes a module one of any identity, parent and step of birth.
inline void set_lineage(ModuleString& string, std::size_t module, Identity identity, Identity parent,
                        std::uint32_t step) {
    const std::uint64_t place = unmixed(identity) ^ mix(parent, step);
    const std::size_t row = string.siblings.size();
    string.siblings = string.siblings.grown(1);
    string.siblings.added(row) = {parent, step, static_cast<std::uint32_t>(place >> 32), /*first_number=*/0};
    string.births[module] = {static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(place)};
}

/// The same for the first module that has no lineage yet.
inline void append_lineage(ModuleString& string, Identity identity, Identity parent, std::uint32_t step) {
    string.births.push_back({0, 0});
    set_lineage(string, string.births.size() - 1, identity, parent, step);
}

}  // namespace espalier::test
