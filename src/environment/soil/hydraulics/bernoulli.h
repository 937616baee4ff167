// The function x / (exp(x) - 1) and its inverse.
#pragma once

namespace espalier::environment {

struct ValueAndSlope {
    double value, slope;
};

/// B(x) = x / (exp(x) - 1): 1 at 0, falling from infinity to 0.
ValueAndSlope bernoulli(double x);

/// The x at which B(x) = b, b > 0; to about 1e-10.
ValueAndSlope inverse_bernoulli(double b);

}  // namespace espalier::environment
