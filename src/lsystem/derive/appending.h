// Rewriting one module after the other, appending what replaces it: with decomposition, or where the order matters.
#pragma once

#include "lsystem/derive/expansion.h"
#include "lsystem/derive/step.h"

#include <atomic>
#include <deque>

namespace espalier::lsystem {

/// A part of the new string, which grows within the step's memory. Rows of siblings come behind those of the old
/// string; of parts that are joined, each counts its own from there.
class GrowingPart {
public:
    /// Modules of the old string that live on.
    struct Run {
        std::size_t begin, end;
        const double* values;
        std::size_t parameters;
        std::size_t modules_before, parameters_before;  ///< of the part's own string
    };
    /// Whether long runs of them are copied at once, or when the parts are joined: then they are copied only once.
    enum class Runs { copied, joined };

    /// `bytes` counts what all strings of this step hold.
    GrowingPart(ModuleString& string, const StepInput& input, std::atomic<std::size_t>& bytes, Runs runs);

    void append(LetterId letter, const double* values, std::size_t arity, const Birth& birth) {
        if (string_.letters.size() == modules_ || parameters_ - string_.parameters.size() < arity) grow(1, arity);
        string_.letters.push_back(letter);
        string_.parameters.insert(string_.parameters.end(), values, values + arity);
        if (input_.lineage) string_.births.push_back(birth);
    }
    /// Appends modules of the old string that live on; `parameters` begin at `values`.
    void append_run(std::size_t begin, std::size_t end, const double* values, std::size_t parameters);

    const std::vector<Run>& runs() const { return runs_; }
    /// Of the part's own string, and of the runs.
    Extent extent() const;

    AddedSiblings siblings;
    std::vector<std::uint64_t> uses;  ///< by production of the main L-system, for when memory runs out

private:
    void grow(std::size_t modules, std::size_t parameters);

    ModuleString& string_;
    const StepInput& input_;
    std::atomic<std::size_t>& bytes_;
    const bool joins_runs_;
    std::vector<Run> runs_;
    std::size_t modules_ = 0, parameters_ = 0;  ///< so many have room
    std::size_t held_ = 0;                      ///< bytes of that
};

/// Rewrites ranges of the string by the rules of one L-system.
class Appending {
public:
    Appending(const StepInput& input, Machine& machine, Services& services, GrowingPart& out);

    /// Returns where it ended: a predecessor of several modules that names `%` may reach beyond `end`.
    std::size_t run(std::size_t begin, std::size_t end, std::size_t parameters_at);
    /// The same, but modules from `end` on are another L-system's, as is what stands between ?() and $ in successors.
    void run_within(std::size_t begin, std::size_t end, std::size_t parameters_at, const Enclosure& enclosure);
    /// Takes random numbers from the stream of the seed at hand, which a block may have set.
    void follow_seed();
    bool reached_limit() const { return decomposition_.reached_limit(); }

private:
    std::size_t rewrite(const Site& site);
    const CompiledProduction* decomposition_of(Site site);
    bool lives_on(LetterId letter) const { return !system_.rules.has(letter) && !system_.decomposition.has(letter); }
    Lineage lineage(std::size_t module) const {
        return input_.lineage ? Lineage{input_.from.identity(module), input_.from.births[module]} : Lineage{};
    }
    void decompose(const Site& site);
    void decompose_within(const Site& site);
    void follow_reseeding();

    const StepInput& input_;
    const CompiledSystem& system_;
    Machine& machine_;
    Services& services_;
    GrowingPart& out_;
    Matcher matcher_;
    Expansion rewriting_, decomposition_;
    ModuleStack stack_;
    std::vector<Lineage> strict_;
    std::vector<double> values_;
    const Enclosure* enclosure_ = nullptr;
    bool decomposing_ = false;
    StopCheck<64> check_stop_;
};

/// Makes `to` of parts, in their order, while `held` bytes are held besides.
void join(const StepInput& input, const std::vector<ModuleString>& pieces, const std::deque<GrowingPart>& parts,
          std::size_t held, ModuleString& to);
/// Gives a string that was written as a whole the rows of its siblings.
void add_siblings(const StepInput& input, const GrowingPart& part, ModuleString& to);

}  // namespace espalier::lsystem
