// The memory of the machine and of this process.
#include "espalier/simulation/simulation.h"

#include "base/link_mark.h"
#include "base/platform.h"
#include "base/usable_memory.h"
#include "simulation/run/allowed_memory.h"

#include <algorithm>

namespace espalier::simulation {

std::size_t default_memory(std::size_t processes) {
    return usable_memory() / 2 / std::max<std::size_t>(processes, 1);
}

std::size_t allowed_memory(std::size_t asked, const std::filesystem::path& what, std::size_t processes) {
    if (asked > 0) return asked;
    std::error_code unknown;
    const std::filesystem::path whole = std::filesystem::absolute(what, unknown);
    const std::size_t bytes = default_memory(processes);
    return folder_of_link(whole) ? std::min(memory_of_links, bytes) : bytes;
}

std::size_t peak_memory() {
    return platform::peak_memory();
}

}  // namespace espalier::simulation
