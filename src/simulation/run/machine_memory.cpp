// The memory of the machine and of this process.
#include "espalier/simulation/simulation.h"

#include "base/platform.h"

namespace espalier::simulation {

std::size_t default_memory() {
    return platform::machine_memory() / 2;
}

std::size_t peak_memory() {
    return platform::peak_memory();
}

}  // namespace espalier::simulation
