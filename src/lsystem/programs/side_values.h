// What expressions ask of the files that stand beside a model: functions, curves, the view volume.
#pragma once

#include "espalier/lsystem/expression.h"
#include "espalier/lsystem/resources.h"

#include <functional>
#include <span>

namespace espalier::lsystem {

/// Extents are numbered vvXmin, vvXmax, vvYmin, vvYmax, vvZmin, vvZmax, vvScale.
double extent_of_view(const Resources& resources, std::uint32_t which);

/// func, curveX, curveY, curveZ and curveGAL; `resources` may be null. A wrong id has the value 0, and `warn` is
/// called.
double side_value(const Resources* resources, Function function, std::span<const double> values,
                  const std::function<void(const std::string&)>& warn);

}  // namespace espalier::lsystem
