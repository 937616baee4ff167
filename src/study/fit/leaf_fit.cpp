#include "study/fit/leaf_fit.h"

#include "espalier/base/error.h"

#include "analysis/least_squares.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::study {
namespace {

using namespace environment::leaf;

/// A parameter that can be fitted.
struct LeafParameter {
    const char* name;  ///< its key in leaf-exchange
    const char* unit;
    double& (*of)(LeafKind&);
    double lowest, highest;
    bool is_of_stomata = false;
};

const std::vector<LeafParameter>& all_parameters() {
    constexpr const char* rate = "umol m-2 s-1";
    static const std::vector<LeafParameter> all{
        {"v", rate, [](LeafKind& leaf) -> double& { return leaf.photosynthesis.carboxylation.at_25; }, 0.01, 2000},
        {"vp", rate, [](LeafKind& leaf) -> double& { return leaf.photosynthesis.carboxylation_pep.at_25; }, 0.01, 4000},
        {"jmax", rate, [](LeafKind& leaf) -> double& { return leaf.photosynthesis.electron_transport.at_25; }, 0.01,
         4000},
        {"rd", rate, [](LeafKind& leaf) -> double& { return leaf.photosynthesis.respiration.at_25; }, 0, 50},
        {"tpu", rate, [](LeafKind& leaf) -> double& { return leaf.photosynthesis.phosphate_use; }, 0.01, 100},
        {"g0", "mol m-2 s-1", [](LeafKind& leaf) -> double& { return leaf.stomata.least; }, 0, 2, true},
        {"g1", "kPa^0.5", [](LeafKind& leaf) -> double& { return leaf.stomata.slope; }, 0, 200, true},
    };
    return all;
}

const LeafParameter& parameter_named(const std::string& name, const LeafKind& leaf) {
    const std::vector<std::string> known = names_to_fit(leaf);
    if (std::find(known.begin(), known.end(), name) == known.end()) {
        throw UserError(fmt::format("'{}' cannot be fitted: this leaf has {}{}", name, fmt::join(known, ", "),
                                    did_you_mean(name, known)));
    }
    return *std::find_if(all_parameters().begin(), all_parameters().end(),
                         [&](const LeafParameter& one) { return one.name == name; });
}

double photons_of(const LeafRecord& row, const LeafFitChoices& choices) {
    return std::max(0.0, std::isfinite(row.absorbed) ? row.absorbed : choices.absorptance * row.incident);
}

Limits limits_in(const LeafRecord& row, const LeafFitChoices& choices, const LeafKind& leaf) {
    return limits_of(leaf.photosynthesis, photons_of(row, choices), row.temperature, row.pressure);
}

/// Without a boundary layer in the file, the air of the chamber counts as that at the surface.
AtSurface surface_of(const LeafRecord& row, const LeafKind& leaf) {
    const double air = row.boundary > 0 ? row.boundary : std::numeric_limits<double>::infinity();
    const double outside = std::isfinite(row.carbon_dioxide)
                               ? row.carbon_dioxide
                               : row.internal + vapour_to_carbon * row.assimilation / row.conductance;
    AtSurface at;
    at.assimilation = row.assimilation;
    at.carbon_dioxide = outside - 1.37 * row.assimilation / air;
    at.deficit = std::isfinite(air) ? row.deficit * air / (air + row.conductance) : row.deficit;
    at.saturation = saturation_pressure(row.temperature);
    at.compensation = limits_of(leaf.photosynthesis, 0, row.temperature, row.pressure).compensation;
    return at;
}

bool tells_stomata(const LeafRecord& row) {
    return row.assimilation > 0 && row.conductance > 0 && row.deficit > 0;
}

const char* limit_of(const LeafRecord& row, const LeafFitChoices& choices, const LeafKind& leaf) {
    static constexpr std::array c3{"Rubisco", "light", "phosphates"};
    static constexpr std::array c4{"PEP carboxylase", "PEP regeneration", "Rubisco", "light", "light"};
    const Limits limits = limits_in(row, choices, leaf);
    std::size_t least = 0;
    for (std::size_t i = 1; i < limits.count; ++i) {
        if (limits.limits[i].at(row.internal) < limits.limits[least].at(row.internal)) least = i;
    }
    return leaf.photosynthesis.pathway == Pathway::c4 ? c4[least] : c3[least];
}

/// Searches some parameters of one leaf.
class Search {
public:
    Search(std::vector<const LeafParameter*> parameters, const LeafKind& start)
        : parameters_(std::move(parameters)), start_(start) {}

    LeafKind with(const std::vector<double>& values) const {
        LeafKind leaf = start_;
        for (std::size_t i = 0; i < parameters_.size(); ++i) parameters_[i]->of(leaf) = values[i];
        return leaf;
    }

    /// From several starts: what limits a row jumps where parameters move, so that there are several minima.
    template <typename Residual>
    analysis::LeastSquares best(const std::vector<const LeafRecord*>& rows, Residual residual) const {
        analysis::LeastSquares best;
        for (const auto& [capacity, light] : starts()) {
            std::vector<analysis::FreeParameter> free;
            for (const LeafParameter* one : parameters_) {
                LeafKind leaf = start_;
                const std::string name = one->name;
                const double factor = name == "v" || name == "vp" ? capacity : name == "jmax" ? light : 1;
                const double value = std::isfinite(one->of(leaf)) ? one->of(leaf) : 10;
                free.push_back({std::clamp(value * factor, one->lowest, one->highest), one->lowest, one->highest});
            }
            const analysis::LeastSquares fit =
                analysis::fit_least_squares(free, [&](const std::vector<double>& values) {
                    const LeafKind leaf = with(values);
                    std::vector<double> all;
                    for (const LeafRecord* row : rows) all.push_back(residual(*row, leaf));
                    return all;
                });
            if (best.values.empty() || fit.residual < best.residual) best = fit;
        }
        return best;
    }

    void tell(const analysis::LeastSquares& fit, LeafFit& found) const {
        constexpr double confused = 0.95;
        found.leaf = with(fit.values);
        for (std::size_t i = 0; i < parameters_.size(); ++i) {
            const std::string name = parameters_[i]->name;
            const bool has_unit = name != "g1" || start_.stomata.form == Stomata::Form::medlyn;
            found.numbers.push_back({name, has_unit ? parameters_[i]->unit : "", fit.values[i], fit.errors[i]});
            for (std::size_t j = 0; j < i; ++j) {
                if (std::abs(fit.correlations[i][j]) < confused) continue;
                found.pairs.push_back({parameters_[j]->name, parameters_[i]->name, fit.correlations[i][j]});
            }
        }
    }

private:
    std::vector<std::pair<double, double>> starts() const {
        const bool has_capacity = std::any_of(parameters_.begin(), parameters_.end(), [](const LeafParameter* one) {
            return std::string(one->name).starts_with("v");
        });
        if (!has_capacity) return {{1, 1}};
        return {{1, 1}, {0.3, 0.3}, {0.3, 1}, {1, 0.5}, {1, 2}, {2, 1}, {2, 4}, {4, 2}};
    }

    std::vector<const LeafParameter*> parameters_;
    LeafKind start_;
};

std::vector<const LeafRecord*> rows_where(const LeafRecords& records, bool (*holds)(const LeafRecord&)) {
    std::vector<const LeafRecord*> rows;
    for (const LeafRecord& row : records.rows) {
        if (holds(row)) rows.push_back(&row);
    }
    return rows;
}

}  // namespace

std::vector<std::string> names_to_fit(const LeafKind& leaf) {
    return leaf.photosynthesis.pathway == Pathway::c4 ? std::vector<std::string>{"v", "vp", "jmax", "rd", "g0", "g1"}
                                                      : std::vector<std::string>{"v", "jmax", "rd", "tpu", "g0", "g1"};
}

double modelled_assimilation(const LeafRecord& row, const LeafFitChoices& choices, const LeafKind& leaf) {
    return limits_in(row, choices, leaf).at(row.internal);
}

double modelled_conductance(const LeafRecord& row, const LeafKind& leaf) {
    return tells_stomata(row) ? leaf.stomata.opening(surface_of(row, leaf)) : not_measured;
}

LeafFit fit_leaf(const LeafRecords& records, const LeafFitChoices& choices) {
    std::vector<const LeafParameter*> of_rates, of_stomata;
    for (const std::string& name : choices.fitted) {
        const LeafParameter& one = parameter_named(name, choices.leaf);
        (one.is_of_stomata ? of_stomata : of_rates).push_back(&one);
    }
    LeafFit found;
    found.leaf = choices.leaf;
    if (!of_rates.empty()) {
        const std::vector<const LeafRecord*> rows = rows_where(records, [](const LeafRecord&) { return true; });
        const Search search(of_rates, found.leaf);
        const analysis::LeastSquares fit = search.best(rows, [&](const LeafRecord& row, const LeafKind& leaf) {
            return modelled_assimilation(row, choices, leaf) - row.assimilation;
        });
        search.tell(fit, found);
        found.rows_of_assimilation = rows.size();
        found.residual_of_assimilation = fit.residual;
        for (const LeafRecord* row : rows) ++found.limits[limit_of(*row, choices, found.leaf)];
    }
    const std::vector<const LeafRecord*> open = rows_where(records, tells_stomata);
    if (!of_stomata.empty() && open.size() >= of_stomata.size()) {
        const Search search(of_stomata, found.leaf);
        const analysis::LeastSquares fit = search.best(open, [](const LeafRecord& row, const LeafKind& leaf) {
            return modelled_conductance(row, leaf) - row.conductance;
        });
        search.tell(fit, found);
        found.rows_of_conductance = open.size();
        found.residual_of_conductance = fit.residual;
    }
    return found;
}

}  // namespace espalier::study
