// A smooth curve through values at equal distances that never overshoots them (Steffen 1990).
#pragma once

#include <span>

namespace espalier {

/// The curve through values at 0, 1, 2, ...; of a closed one the first value comes again behind the last. Between two
/// values it stays between them, so it is monotonic there. Open curves end at their first and last value.
double monotone_curve(std::span<const double> values, double x, bool closed);

}  // namespace espalier
