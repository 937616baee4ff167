// Simulations of a fit in the files of a folder: made once, by as many processes as there are, and read by all.
#pragma once

#include "study/fit/abc.h"
#include "study/fit/prior.h"
#include "study/fit/target.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::study {

/// What is fitted to what.
struct FitTask {
    Growth growth;
    std::vector<Unknown> unknowns;
    std::vector<std::shared_ptr<const Target>> targets;

    /// Of all targets, one after the other.
    std::vector<Statistic> statistics() const;
    Needs needs() const;
    /// How many worlds stand for all that was measured.
    std::size_t worlds() const;
    std::vector<std::pair<std::string, double>> named(std::span<const double> values) const;
    /// The statistics of `worlds` worlds from number `first` on, on as many threads as there are; NaN where growth
    /// failed or a plant grew too large. Throws UserError for values that the model refuses.
    std::vector<double> simulated(std::span<const double> values, std::uint64_t first, std::size_t worlds) const;
    /// Changes with everything that simulations depend on.
    std::uint64_t digest() const;
};

/// Which of the files this process makes: every `of`-th.
struct Part {
    std::size_t number = 0, of = 1;
};

class Simulations {
public:
    /// `folder`: where the files lie; made if it is not there. Throws UserError if it holds those of another task.
    Simulations(const FitTask& task, std::filesystem::path folder, std::size_t per_generation);

    using Progress = std::function<void(std::size_t done, std::size_t all)>;
    /// Makes what is missing of a generation, the first from the priors, each other from `proposal`. Returns false if
    /// it was told to stop; what is whole then stays.
    bool make(std::size_t generation, const Proposal* proposal, const Part& part, const Progress& progress) const;
    /// How many of a generation are there.
    std::size_t made(std::size_t generation, const Proposal* proposal) const;
    SimulationTable read(std::size_t generation, const Proposal* proposal) const;

private:
    std::filesystem::path file(std::size_t generation, const Proposal* proposal, std::size_t chunk) const;
    std::size_t chunks() const;
    std::string rows(std::size_t generation, const Proposal* proposal, std::size_t chunk) const;

    const FitTask& task_;
    std::filesystem::path folder_;
    std::size_t per_generation_;
};

}  // namespace espalier::study
