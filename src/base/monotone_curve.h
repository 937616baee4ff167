// A smooth curve through values that never overshoots them (Steffen 1990).
#pragma once

#include <span>

namespace espalier {

/// The curve through values at 0, 1, 2, ...; of a closed one the first value comes again behind the last. Between two
/// values it stays between them, so it is monotonic there. Open curves end at their first and last value.
double monotone_curve(std::span<const double> values, double x, bool closed);

/// The slope at a value between two pieces that rise by `before` and `after` per unit of their spans.
double monotone_slope(double before, double after, double span_before = 1, double span_after = 1);

}  // namespace espalier
