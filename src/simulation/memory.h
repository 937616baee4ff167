// How much memory a run may take, and how it is shared out.
#pragma once

#include <cstddef>

namespace espalier {

/// A budget divided between the plants' strings, their geometry and the fields of the processes.
struct MemoryShares {
    std::size_t strings;  ///< all strings together, old and new
    std::size_t process;  ///< the fields of each process
};
MemoryShares share_memory(std::size_t budget, std::size_t processes);

}  // namespace espalier
