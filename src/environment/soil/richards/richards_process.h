// The process soil-water with model = "richards", and with model = "still", whose heads are given.
#pragma once

#include "espalier/environment/environment_process.h"

#include <memory>

namespace espalier::environment {

std::unique_ptr<EnvironmentProcess> make_richards_soil(Settings& settings, const EnvironmentContext& context,
                                                       Fields& fields, bool is_still);

}  // namespace espalier::environment
