// What a plant holds, in bytes.
#pragma once

#include "espalier/timeline/recorder.h"
#include "espalier/turtle/interpretation.h"

#include <cstddef>

namespace espalier::simulation {

/// Counted from the values, not from the memory they lie in: how much room that has depends on the threads and on which
/// frames are still read; where a run ends must not.
struct PlantMemory {
    std::size_t strings = 0;       ///< old and new, and what derivation needs besides
    std::size_t drawn = 0;         ///< the interpretation, and its queries on their way
    std::size_t drawn_before = 0;  ///< that of the frame on its way to the files
    RecordedMemory recorded = {};  ///< memory of what is kept, the sum of all steps

    /// Strings of at most so many modules may be written in memory that plants pass on to each other.
    static constexpr std::size_t most_of_small = 8192;
    /// `before` may be null, if that string was small. `working`: what derivation holds besides the two strings.
    void set_strings(const ModuleString* before, std::size_t modules_before, const ModuleString& now,
                     std::size_t working);
    /// The queries of many plants are copied.
    void set_drawn(const Interpretation& interpretation, bool many_plants);
    /// After set_drawn(): the copy that geometry stages have changed.
    void add_staged(const Interpretation& staged);
    /// After set_drawn(): what recording this step takes, the frame before being still on its way.
    void set_recorded(const RecordedMemory& now, std::size_t before);
    void add(const PlantMemory& plant);
    /// With so many times as much drawn, `is_recorded` or not.
    PlantMemory grown(double factor, bool is_recorded) const;
    std::size_t total() const;
};

}  // namespace espalier::simulation
