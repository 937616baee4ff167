#include "study/fit/prior.h"

#include "espalier/base/math.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::study {
namespace {

/// a[0] + a[1] x + ... by Horner's rule.
template <std::size_t n>
double polynomial(const std::array<double, n>& a, double x) {
    double sum = 0;
    for (std::size_t i = n; i-- > 0;) sum = sum * x + a[i];
    return sum;
}

// Wichura (1988), algorithm AS 241, PPND16: quotients of polynomials for the middle, the flanks and the far tails.
constexpr std::array middle_above{3.387132872796366608,  133.14166789178437745, 1971.5909503065514427,
                                  13731.693765509461125, 45921.953931549871457, 67265.770927008700853,
                                  33430.575583588128105, 2509.0809287301226727};
constexpr std::array middle_below{1.0,
                                  42.313330701600911252,
                                  687.1870074920579083,
                                  5394.1960214247511077,
                                  21213.794301586595867,
                                  39307.89580009271061,
                                  28729.085735721942674,
                                  5226.495278852545925};
constexpr std::array flank_above{1.42343711074968357734,   4.6303378461565452959,   5.7694972214606914055,
                                 3.64784832476320460504,   1.27045825245236838258,  0.24178072517745061177,
                                 0.0227238449892691845833, 7.7454501427834140764e-4};
constexpr std::array flank_below{1.0,
                                 2.05319162663775882187,
                                 1.6763848301838038494,
                                 0.68976733498510000455,
                                 0.14810397642748007459,
                                 0.0151986665636164571966,
                                 5.475938084995344946e-4,
                                 1.05075007164441684324e-9};
constexpr std::array tail_above{6.6579046435011037772,     5.4637849111641143699,    1.7848265399172913358,
                                0.29656057182850489123,    0.026532189526576123093,  0.0012426609473880784386,
                                2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr std::array tail_below{1.0,
                                0.59983220655588793769,
                                0.13692988092273580531,
                                0.0148753612908506148525,
                                7.868691311456132591e-4,
                                1.8463183175100546818e-5,
                                1.4215117583164458887e-7,
                                2.04426310338993978564e-15};

}  // namespace

double normal_share(double x) {
    return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

double normal_quantile(double share) {
    const double q = share - 0.5;
    if (std::abs(q) <= 0.425) {
        const double r = 0.180625 - q * q;
        return q * polynomial(middle_above, r) / polynomial(middle_below, r);
    }
    const double r = std::sqrt(-math::log(q < 0 ? share : 1 - share));
    const double x = r <= 5 ? polynomial(flank_above, r - 1.6) / polynomial(flank_below, r - 1.6)
                            : polynomial(tail_above, r - 5) / polynomial(tail_below, r - 5);
    return q < 0 ? -x : x;
}

Prior Prior::uniform(double low, double high, bool whole) {
    Prior prior;
    prior.kind_ = whole ? Kind::whole : Kind::uniform;
    prior.low_ = whole ? std::ceil(low) : low;
    prior.high_ = whole ? std::floor(high) : high;
    return prior;
}

Prior Prior::log_uniform(double low, double high) {
    Prior prior = uniform(low, high);
    prior.kind_ = Kind::log_uniform;
    return prior;
}

Prior Prior::normal(double mean, double deviation, double low, double high) {
    Prior prior = uniform(low, high);
    prior.kind_ = Kind::normal;
    prior.mean_ = mean;
    prior.deviation_ = deviation;
    return prior;
}

double Prior::quantile(double u) const {
    switch (kind_) {
        case Kind::whole:
            return std::min(high_, low_ + std::floor(u * (high_ - low_ + 1)));
        case Kind::log_uniform:
            return low_ * math::pow(high_ / low_, u);
        case Kind::normal: {
            const double below = normal_share((low_ - mean_) / deviation_);
            const double above = normal_share((high_ - mean_) / deviation_);
            return std::clamp(mean_ + deviation_ * normal_quantile(below + u * (above - below)), low_, high_);
        }
        case Kind::uniform:
            break;
    }
    return low_ + u * (high_ - low_);
}

double Prior::share_below(double value) const {
    switch (kind_) {
        case Kind::whole:
            return (value - low_ + 0.5) / (high_ - low_ + 1);
        case Kind::log_uniform:
            return math::log(value / low_) / math::log(high_ / low_);
        case Kind::normal: {
            const double below = normal_share((low_ - mean_) / deviation_);
            const double above = normal_share((high_ - mean_) / deviation_);
            return (normal_share((value - mean_) / deviation_) - below) / (above - below);
        }
        case Kind::uniform:
            break;
    }
    return (value - low_) / (high_ - low_);
}

std::string Prior::text() const {
    switch (kind_) {
        case Kind::whole:
            return fmt::format("a whole number from {:.6g} to {:.6g}", low_, high_);
        case Kind::log_uniform:
            return fmt::format("log-uniform from {:.6g} to {:.6g}", low_, high_);
        case Kind::normal:
            return fmt::format("normal, mean {:.6g}, deviation {:.6g}", mean_, deviation_);
        case Kind::uniform:
            break;
    }
    return fmt::format("uniform from {:.6g} to {:.6g}", low_, high_);
}

std::vector<double> values_of_scores(std::span<const Unknown> unknowns, std::span<const double> scores) {
    std::vector<double> values;
    for (std::size_t k = 0; k < scores.size(); ++k) {
        const double share = std::clamp(normal_share(scores[k]), 1e-12, 1 - 1e-12);
        values.push_back(unknowns[k].prior->quantile(share));
    }
    return values;
}

}  // namespace espalier::study
