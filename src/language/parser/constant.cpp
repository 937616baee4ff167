#include "language/parser/constant.h"

#include "lsystem/programs/constant.h"

#include <cmath>

namespace espalier::language {

std::optional<double> constant_value(const Expression& expression) {
    const std::optional<double> value = espalier::constant_value(expression, Arithmetic::double_precision);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace espalier::language
