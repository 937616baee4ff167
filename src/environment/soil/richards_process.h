// The process soil-water with model = "richards".
#pragma once

#include "espalier/environment/environment_process.h"

#include <memory>

namespace espalier::environment {

std::unique_ptr<EnvironmentProcess> make_richards_soil(Settings& settings, const EnvironmentContext& context,
                                                       Fields& fields);

}  // namespace espalier::environment
