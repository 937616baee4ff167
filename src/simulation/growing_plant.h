// A plant of a world, and the memory its strings take turns in.
#pragma once

#include "espalier/base/prefetch.h"
#include "espalier/lsystem/derivation.h"
#include "espalier/simulation/scene.h"
#include "espalier/turtle/interpretation.h"

#include "reusable.h"
#include "memory_budget.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace espalier {

/// Strings of at most so many modules may be written to memory that plants pass on to each other: ten thousand herbs
/// with two strings each would not fit into a cache.
inline constexpr std::size_t most_passed_on = 8192;

// What derivations know is kept here, as the last step left it: looking it up there costs more than a small plant's
// step.
struct Plant {
    std::uint32_t number = 0;
    std::uint32_t modules_before = 0;  ///< of the step that was done last
    const PlantDescription* description = nullptr;
    const Model* model = nullptr;
    const SymbolTable* symbols = nullptr;
    Derivation derivation;
    bool has_pictures = derivation.has_homomorphism();
    bool stopped = false;
    int length = 0;
    Lent<ModuleString> string = {};
    Lent<Interpretation> interpretation = {};
    PlantMemory memory = {};
    std::unique_ptr<Lent<ModuleString>> next = {};  ///< between steps the string before; null: its memory is passed on

    /// Makes the next string in the memory of `spare`, which gets that of the old one. Strings that are large, or that
    /// somebody reads, and all if `spare` is null, have a second memory of their own.
    template <class Rewrite>
    void rewrite(const Rewrite& rewrite, ModuleString* spare);
    /// With what derivation needs besides. Of small strings always as if there were two that fit: when memory gets
    /// scarce there will be.
    std::size_t bytes_of_strings() const;
    // Hints that a stage will soon come to this plant: whoever waits for its lines of memory one by one waits longer
    // than a small plant takes.
    void prefetch_derivation() const;
    void prefetch_interpretation() const;
};

inline void swap_columns(ModuleString& a, ModuleString& b) {
    a.letters.swap(b.letters);
    a.parameters.swap(b.parameters);
    a.identities.swap(b.identities);
    a.parents.swap(b.parents);
    a.births.swap(b.births);
}

/// Asks for a column's beginning; what follows the processor asks for itself.
template <class Column>
void prefetch_column(const Column& column) {
    constexpr std::size_t most = 1024;
    prefetch(column.data(), std::min(column.size() * sizeof(column[0]), most));
}

inline void Plant::prefetch_derivation() const {
    derivation.prefetch();
    prefetch_column(string->letters);
    prefetch_column(string->parameters);
    prefetch_column(string->identities);
    prefetch_column(string->parents);
    prefetch_column(string->births);
}

inline void Plant::prefetch_interpretation() const {
    prefetch(&description->turtle, sizeof(TurtleSettings));
    prefetch_column(string->letters);
    prefetch_column(string->parameters);
    prefetch_column(interpretation->geometry.internodes);
}

template <class Rewrite>
void Plant::rewrite(const Rewrite& rewrite, ModuleString* spare) {
    modules_before = static_cast<std::uint32_t>(string->size());
    if (spare && modules_before <= most_passed_on && !string.is_read()) {
        const std::size_t widest = 64 + 4 * string->size();
        if (spare->letters.capacity() > widest) *spare = {};
        next.reset();
        rewrite(*this, *spare);
        return swap_columns(*string, *spare);
    }
    const bool passed_on = !next;
    if (!next) next = std::make_unique<Lent<ModuleString>>();
    rewrite(*this, next->for_writing());
    std::swap(string, *next);
    const bool outgrows = modules_before <= most_passed_on && string->size() > most_passed_on;
    if (!passed_on && !outgrows) return;
    // How much room it had was chance; how large strings grow may depend on it.
    Lent<ModuleString> fitting;
    *fitting = ModuleString(**next);
    *next = std::move(fitting);
}

inline std::size_t Plant::bytes_of_strings() const {
    const bool small = modules_before <= most_passed_on || string->size() <= most_passed_on;
    const std::size_t before = small || !next ? string->content() : (*next)->content();
    // New columns have an eighth more room than they need: much memory at once stays untouched, little does not.
    const std::size_t room = small ? (string->content() + before) / 8 : 0;
    return string->content() + before + room + derivation.working_memory(*string);
}

/// Memory for strings that nobody holds now.
struct SpareStrings {
    std::mutex mutex;
    std::vector<ModuleString> strings;
};

/// One of them, as long as this lives.
struct SpareString {
    explicit SpareString(SpareStrings& others) : spares(others) {
        const std::lock_guard lock(spares.mutex);
        if (spares.strings.empty()) return;
        string = std::move(spares.strings.back());
        spares.strings.pop_back();
    }
    ~SpareString() {
        const std::lock_guard lock(spares.mutex);
        spares.strings.push_back(std::move(string));
    }
    SpareString(const SpareString&) = delete;
    SpareString& operator=(const SpareString&) = delete;

    SpareStrings& spares;
    ModuleString string;
};

}  // namespace espalier
