// ray-light as cpfg's programs QuasiMC, MonteCarlo and radiosity answer, by their parameter files.
#pragma once

#include "espalier/environment/environment_process.h"

#include <memory>
#include <string>

namespace espalier::environment {

/// What ray-light is where it has `parameters`. Throws UserError.
std::unique_ptr<EnvironmentProcess> make_program_rays(Settings& settings, const EnvironmentContext& context);

/// What users read of it.
const std::string& program_rays_help();

}  // namespace espalier::environment
