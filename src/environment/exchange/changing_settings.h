// Settings that keyframes change, as most processes have them: members that are read anew in every step.
#pragma once

#include "espalier/environment/environment_process.h"

#include <string>

namespace espalier::environment {

/// `value` lives as long as the process.
inline ChangingSetting changing(std::string key, Range range, double& value) {
    return {std::move(key), range, [&value](double changed) { value = changed; }};
}

}  // namespace espalier::environment
