#include "espalier/lsystem/expression.h"

namespace espalier::lsystem {

Expression Expression::number(double value, Place place) {
    Expression expression;
    expression.value = value;
    expression.place = std::move(place);
    return expression;
}

}  // namespace espalier::lsystem
