// How much memory a run may take, and how it is shared out.
#pragma once

#include "espalier/turtle/interpretation.h"

#include <cstddef>
#include <string>

namespace espalier {

/// A budget divided between the plants and the fields of the processes.
struct MemoryShares {
    std::size_t plants;   ///< strings, old and new, what is drawn of them, and its way to the timeline
    std::size_t string;   ///< the strings of any one plant, which it asks for before anyone else can look
    std::size_t process;  ///< the fields of each process
};
MemoryShares share_memory(std::size_t budget, std::size_t processes);

/// Bytes of the modules, without the room that the columns have besides.
std::size_t content(const ModuleString& string);

/// What plants hold, in bytes: their strings, and what was drawn of them. How much room their memory really has depends
/// on the threads and on which frames are still read; where a run ends must not: told from what is in it.
struct PlantMemory {
    std::size_t strings = 0, internodes = 0, others = 0;

    void set_drawn(const Interpretation& interpretation);
    void add(const PlantMemory& plant) {
        strings += plant.strings;
        internodes += plant.internodes;
        others += plant.others;
    }
    /// With so many times as much drawn.
    PlantMemory grown(double factor) const;
    /// With the copy and the meshes that the timeline makes.
    std::size_t recorded() const;
};

/// ", most of them F, which the production at plant.l:4:1 writes most of": what a plant grew too large by.
std::string commonest_module(const Model& model, const ModuleString& string);

}  // namespace espalier
