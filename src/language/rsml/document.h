// Files of the Root System Markup Language (Lobet et al. 2015): roots as polylines with what is known of their nodes.
#pragma once

#include "espalier/language/measured_plants.h"

#include <string>

namespace espalier::language::rsml {

/// Throws UserError with the place of a mistake.
MeasuredPlants read(std::string text, const std::string& name, const MeasuredOptions& options);

}  // namespace espalier::language::rsml
