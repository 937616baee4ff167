// What is known of a parameter before anything is measured.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::study {

/// A distribution of numbers, given by its quantiles, so that priors of all forms are sampled and compared alike.
class Prior {
public:
    /// All numbers between two are equally probable. Whole numbers: each of them.
    static Prior uniform(double low, double high, bool whole = false);
    /// Their logarithms are; both above 0.
    static Prior log_uniform(double low, double high);
    /// Normal, cut off at `low` and `high`, which may be infinite.
    static Prior normal(double mean, double deviation, double low, double high);

    /// The number below which lies the share `u` of the distribution, 0 < u < 1.
    double quantile(double u) const;
    /// The share that lies below a number; the inverse of `quantile` (of whole numbers, of their middles).
    double share_below(double value) const;
    /// A range that holds all but a share of 1e-4 of it.
    double lowest() const { return quantile(5e-5); }
    double highest() const { return quantile(1 - 5e-5); }
    bool is_whole() const { return kind_ == Kind::whole; }
    /// "uniform from 10 to 60"
    std::string text() const;

private:
    enum class Kind { uniform, whole, log_uniform, normal };
    Kind kind_ = Kind::uniform;
    double low_ = 0, high_ = 1, mean_ = 0, deviation_ = 1;
};

/// The standard normal distribution: the share below x, and its inverse (Wichura 1988, AS 241).
double normal_share(double x);
double normal_quantile(double share);

/// A parameter that is sought: a #define of the model, or a key of the scene.
struct Unknown {
    std::string name;
    double start = 0;
    double lowest = -std::numeric_limits<double>::infinity(), highest = std::numeric_limits<double>::infinity();
    std::optional<Prior> prior = {};  ///< none: nothing is known but the bounds
};

/// Values of the parameters at normal scores: of each prior, the value below which the score's share lies.
std::vector<double> values_of_scores(std::span<const Unknown> unknowns, std::span<const double> scores);

}  // namespace espalier::study
