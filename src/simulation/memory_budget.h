// How much memory a run may take, and how it is shared out.
#pragma once

#include "espalier/timeline/recorder.h"
#include "espalier/turtle/interpretation.h"

#include <cstddef>
#include <string>

namespace espalier {

/// Has memory that was freed go back to the system, if it was more than a little at once. For the whole process.
void give_back_what_is_large();

/// A budget divided between the plants and the fields of the processes.
struct MemoryShares {
    std::size_t plants;   ///< strings, old and new, what is drawn of them, and what recording takes
    std::size_t frames;   ///< frames that wait to be written, if there are several
    std::size_t process;  ///< the fields of each process
};
MemoryShares share_memory(std::size_t budget, std::size_t processes);

/// What plants hold, in bytes. How much room their memory really has depends on the threads and on which frames are
/// still read; where a run ends must not: told from what is in it.
struct PlantMemory {
    std::size_t strings = 0;       ///< old and new, and what derivation needs besides
    std::size_t drawn = 0;         ///< the interpretation, and its questions on their way
    std::size_t drawn_before = 0;  ///< that of the frame on its way to the files
    RecordedMemory recorded = {};  ///< of what is kept, the sum of all steps

    /// Of many plants the questions are copied.
    void set_drawn(const Interpretation& interpretation, bool many_plants);
    /// After set_drawn(): what recording this step takes, the frame before being still on its way.
    void set_recorded(const RecordedMemory& now, std::size_t before);
    void add(const PlantMemory& plant);
    /// With so many times as much drawn, `is_recorded` or not.
    PlantMemory grown(double factor, bool is_recorded) const;
    std::size_t total() const;
};

/// ", most of them F, which the production at plant.l:4:1 writes most of": what a plant grew too large by.
std::string commonest_module(const Model& model, const ModuleString& string);

}  // namespace espalier
