#include "launcher.h"

#include "espalier/base/error.h"

#include "app/module_file.h"
#include "base/platform.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

namespace espalier::app {
namespace {

// What Open MPI, MPICH and Slurm tell the processes that they start: how many there are.
constexpr std::array counts{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"};

int number_in(const char* variable) {
    const char* const value = std::getenv(variable);
    return value ? std::atoi(value) : 0;
}

int launched() {
    int most = 1;
    for (const char* name : counts) most = std::max(most, number_in(name));
    // PMIx tells a process its rank only; srun, which starts it so, tells how many there are.
    if (std::getenv("PMIX_RANK")) most = std::max(most, number_in("SLURM_STEP_NUM_TASKS"));
    return most;
}

}  // namespace

std::unique_ptr<Ranks> ranks_of_launcher() {
    const int count = launched();
    if (count < 2) return nullptr;
    const std::filesystem::path file = module_file("libespalier_ranks.so");
    if (file.empty()) {
        throw RunError(
            fmt::format("a launcher started {} processes, but this program was built without MPI: build it "
                        "with -DESPALIER_MPI=ON, or start it without mpiexec",
                        count));
    }
    std::string why;
    void* const module = platform::open_library(file, /*shared=*/true, why);
    if (!module) throw RunError("cannot open " + why);
    const auto make = reinterpret_cast<Ranks* (*)()>(platform::function_of(module, "espalier_ranks"));
    if (!make) throw RunError(fmt::format("{} has no ranks", file.string()));
    return std::unique_ptr<Ranks>(make());
}

}  // namespace espalier::app
