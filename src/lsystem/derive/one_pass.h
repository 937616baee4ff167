// Rewriting in string order, appending.
#pragma once

#include "lsystem/derive/expansion.h"
#include "lsystem/derive/rewriting.h"

#include <atomic>

namespace espalier {

/// A string that grows within the step's memory.
class GrowingString {
public:
    /// Of memory that is lent only what is used counts: how much there is depends on who had it before.
    enum class Room { own, lent };

    /// `bytes` counts what all strings that grow in this step hold.
    GrowingString(ModuleString& string, const StepInput& input, std::atomic<std::size_t>& bytes, Room room = Room::own);

    void append(LetterId letter, const double* values, std::size_t arity, const Lineage& lineage) {
        if (string_.letters.size() == modules_ || parameters_ - string_.parameters.size() < arity) grow(1, arity);
        string_.letters.push_back(letter);
        string_.parameters.insert(string_.parameters.end(), values, values + arity);
        if (input_.ancestry == Ancestry::none) return;
        string_.identities.push_back(lineage.identity);
        if (input_.ancestry == Ancestry::identities) return;
        string_.parents.push_back(lineage.parent);
        string_.births.push_back(lineage.birth);
    }

    /// Appends modules of the old string that live on; `parameters` begin at `values`.
    void append_run(std::size_t begin, std::size_t end, const double* values, std::size_t parameters);

    std::vector<std::uint64_t> uses;  ///< of each production of the main L-system, for when memory runs out

private:
    void grow(std::size_t modules, std::size_t parameters);

    ModuleString& string_;
    const StepInput& input_;
    std::atomic<std::size_t>& bytes_;
    std::size_t modules_ = 0, parameters_ = 0;  ///< so many have room
    std::size_t held_ = 0;                      ///< bytes of that
};

/// Rewrites ranges of the string by the rules of one L-system.
class OnePass {
public:
    OnePass(const StepInput& input, Machine& machine, Services& services, GrowingString& out);

    /// Returns where it ended: a predecessor of several modules that names `%` may reach beyond `end`.
    std::size_t run(std::size_t begin, std::size_t end, std::size_t parameters_at);
    /// The same, but modules from `end` on are another L-system's, as is what stands between ?() and $ in successors.
    void run_within(std::size_t begin, std::size_t end, std::size_t parameters_at, const Enclosure& enclosure);
    bool reached_limit() const { return decomposition_.reached_limit(); }

private:
    std::size_t rewrite(const Site& site);
    bool lives_on(LetterId letter) const { return !model_.rules.has(letter) && !model_.decomposition.has(letter); }
    Lineage lineage(std::size_t module) const {
        if (input_.ancestry == Ancestry::none) return {};
        if (input_.ancestry == Ancestry::identities) return {input_.from.identities[module]};
        return {input_.from.identities[module], input_.from.parents[module], input_.from.births[module]};
    }
    void decompose(const Site& site);
    void decompose_within(const Site& site);
    void follow_reseeding();
    void set_draws();

    const StepInput& input_;
    const CompiledSystem& model_;
    Machine& machine_;
    Services& services_;
    GrowingString& out_;
    Matcher matcher_;
    Expansion rewriting_, decomposition_;
    ModuleStack stack_;
    std::vector<Lineage> strict_;
    std::vector<double> values_;
    const Enclosure* enclosure_ = nullptr;
    bool decomposing_ = false;
};

}  // namespace espalier
