// The memory of the machine and of this process.
#include "espalier/simulation/simulation.h"

#include <algorithm>
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>

namespace espalier::simulation {

std::size_t default_memory() {
    std::size_t bytes =
        static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(sysconf(_SC_PAGE_SIZE));
    // A container's limit (control groups, version 2); "max" is no number and leaves the machine's.
    std::ifstream limit("/sys/fs/cgroup/memory.max");
    std::size_t allowed = 0;
    if (limit >> allowed) bytes = std::min(bytes, allowed);
    return bytes / 2;
}

std::size_t peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
    constexpr std::size_t unit = 1;
#else
    constexpr std::size_t unit = 1024;
#endif
    return static_cast<std::size_t>(usage.ru_maxrss) * unit;
}

}  // namespace espalier::simulation
