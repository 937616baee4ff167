#include "launcher.h"

#include "espalier/base/error.h"

#include "app/module_file.h"
#include "base/number.h"
#include "base/platform.h"

#include <climits>
#include <fmt/format.h>

#include <cstdlib>
#include <optional>
#include <string>

namespace espalier::app {
namespace {

/// How many processes a launcher started, at least, and the variable that says so.
struct Launched {
    int count = 1;
    std::string variable;
};

std::optional<int> number_in(const char* variable) {
    const char* const value = std::getenv(variable);
    return value ? whole_text_as<int>(value) : std::nullopt;
}

// What Open MPI, MPICH and Slurm tell the processes that they start.
Launched launched() {
    Launched most;
    const auto take = [&](const char* variable, std::optional<int> count) {
        if (count > most.count) most = {*count, fmt::format("{}={}", variable, *number_in(variable))};
    };
    take("OMPI_COMM_WORLD_SIZE", number_in("OMPI_COMM_WORLD_SIZE"));
    take("PMI_SIZE", number_in("PMI_SIZE"));
    // PMIx tells a process its rank only; srun, which starts it so, tells how many there are.
    const std::optional<int> rank = number_in("PMIX_RANK");
    if (!rank) return most;
    take("SLURM_STEP_NUM_TASKS", number_in("SLURM_STEP_NUM_TASKS"));
    take("PMIX_RANK", *rank < INT_MAX ? *rank + 1 : *rank);
    return most;
}

// Each process would be a run of its own, all into one folder.
void require_all(const Ranks& ranks, const Launched& launched, const std::string& library) {
    if (ranks.count() > 1) return;
    throw UserError(fmt::format(
        "a launcher started {} processes or more ({}), but {}, with which this program was built, sees one: they are "
        "of different kinds. Start it with the mpiexec of that library; or, if Slurm starts it, with the --mpi that "
        "the library knows (`srun --mpi=list`)",
        launched.count, launched.variable, library));
}

}  // namespace

std::unique_ptr<Ranks> ranks_of_launcher() {
    const Launched started = launched();
    if (started.count < 2) return nullptr;
    const std::filesystem::path file = module_file("libespalier_ranks.so");
    if (file.empty()) {
        throw RunError(
            fmt::format("a launcher started {} processes, but this program was built without MPI: build it "
                        "with -DESPALIER_MPI=ON, or start it without mpiexec",
                        started.count));
    }
    std::string why;
    void* const module = platform::open_library(file, /*shared=*/true, why);
    if (!module) throw RunError("cannot open " + why);
    const auto make = reinterpret_cast<Ranks* (*)()>(platform::function_of(module, "espalier_ranks"));
    const auto library = reinterpret_cast<const char* (*)()>(platform::function_of(module, "espalier_mpi_library"));
    if (!make || !library) throw RunError(fmt::format("{} has no ranks", file.string()));
    std::unique_ptr<Ranks> ranks(make());
    require_all(*ranks, started, library());
    return ranks;
}

}  // namespace espalier::app
