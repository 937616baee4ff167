// Whether a launcher of parallel programs, mpiexec or srun, started this process as one of several ranks.
#pragma once

#include "espalier/simulation/ranks.h"

#include <memory>

namespace espalier::app {

/// The ranks that the launcher started; null if none did, or a single one. MPI is a module, opened only here. Throws
/// RunError if there are ranks but no module, UserError if that module's MPI knows nothing of the launcher's others.
std::unique_ptr<Ranks> ranks_of_launcher();

}  // namespace espalier::app
