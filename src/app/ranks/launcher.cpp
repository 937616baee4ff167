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
    bool is_plain = false;  ///< it told them nothing by which they could find each other
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
    const std::optional<int> open_mpi = number_in("OMPI_COMM_WORLD_SIZE"), pmi = number_in("PMI_SIZE");
    // PMIx tells a process its rank only; srun, which starts it so, tells how many there are.
    const std::optional<int> rank = number_in("PMIX_RANK");
    take("OMPI_COMM_WORLD_SIZE", open_mpi);
    take("PMI_SIZE", pmi);
    // A process that a launcher started alone may have this from the step of Slurm that the launcher is.
    const bool is_plain = !open_mpi && !pmi && !rank;
    if (rank || is_plain) take("SLURM_STEP_NUM_TASKS", number_in("SLURM_STEP_NUM_TASKS"));
    if (rank) take("PMIX_RANK", *rank < INT_MAX ? *rank + 1 : *rank);
    most.is_plain = is_plain && most.count > 1;
    return most;
}

// How ranks of that library are started.
std::string line_to_type(const std::string& library, int count) {
    const bool is_open_mpi = library.find("Open MPI") != std::string::npos;
    const bool is_mpich = library.find("MPICH") != std::string::npos;
    const std::string type = is_open_mpi ? "pmix" : is_mpich ? "pmi2" : "TYPE";
    return fmt::format(
        "`srun --mpi={} -n {} espalier ...` (if `srun --mpi=list` names {}), or `mpiexec -n {} espalier "
        "...` with the mpiexec of {}",
        type, count, type == "TYPE" ? "one that it knows" : type, count, library);
}

// Each process would be a run of its own, all into one folder.
[[noreturn]] void refuse_strangers(const Launched& launched, const std::string& library) {
    const std::string alone =
        launched.is_plain
            ? ". If each process is to grow a run of its own, start it with `env -u SLURM_STEP_NUM_TASKS espalier ...`"
            : "";
    throw UserError(
        fmt::format("a launcher started {} processes or more ({}), but {}, with which this program was "
                    "built, sees one: they are of different kinds. Start it with {}{}",
                    launched.count, launched.variable, library, line_to_type(library, launched.count), alone));
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
    if (started.is_plain) refuse_strangers(started, library());
    std::unique_ptr<Ranks> ranks(make());
    if (ranks->count() < 2) refuse_strangers(started, library());
    return ranks;
}

}  // namespace espalier::app
