#include "lsystem/derive/small_step.h"

#include "lsystem/derive/lanes.h"
#include "lsystem/derive/write.h"

#include <algorithm>

namespace espalier::lsystem {
namespace {

template <class T>
bool has_spare(const Column<T>& column, std::size_t spare) {
    return column.capacity() - column.size() >= spare;
}

/// All columns can be read in whole blocks.
bool is_roomy(const ModuleString& string) {
    return has_spare(string.letters, spare_letters) && has_spare(string.parameters, spare_values) &&
           has_spare(string.births, spare_births);
}

/// Writes in whole blocks what replaces the modules of a string.
class SmallWriter {
public:
    SmallWriter(const ModuleString& from, std::uint32_t step, ModuleString& to)
        : from_(from), step_(step), row_(static_cast<std::uint32_t>(from.siblings.size())), to_(to) {}

    /// False if a value is not finite.
    template <bool Valued>
    bool run(const Plans& plans);

private:
    void bear(const Plan& plan, std::size_t module, Birth* births);

    const ModuleString& from_;
    const std::uint32_t step_;
    std::uint32_t row_;  ///< row of the next siblings
    ModuleString& to_;
};

template <bool Valued>
bool SmallWriter::run(const Plans& plans) {
    const double* values = from_.parameters.data();
    LetterId* letters = to_.letters.data();
    double* out_values = to_.parameters.data();
    Birth* births = to_.births.data();
    for (std::size_t i = 0; i < from_.size(); ++i) {
        const Plan& plan = plans.of_letter(from_.letters[i]);
        copy_run<letter_block>(plan.length > letter_block ? plan.letters : plan.block.data(), letters, plan.length);
        if constexpr (Valued) {
            if (plan.kind == Plan::Kind::copy)
                copy_run<value_block>(values, out_values, plan.parameters);
            else if (plan.kind == Plan::Kind::lanes && !write_lanes(plan, values, out_values))
                return false;
            values += plan.reads;
            out_values += plan.parameters;
        }
        if (plan.moves)
            bear(plan, i, births);
        else
            *births = from_.births[i];
        letters += plan.length;
        births += plan.length;
    }
    return true;
}

void SmallWriter::bear(const Plan& plan, std::size_t module, Birth* births) {
    const Descent& descent = plan.production->descent;
    if (plan.bears) {
        to_.siblings.added(row_) = {from_.identity(module), step_, 0, 0};
        for (std::size_t k = 0; k < plan.length; ++k) births[k] = {row_, descent.births[k].place};
        ++row_;
    }
    births[descent.heirs[0]] = from_.births[module];
}

}  // namespace

bool rewrite_small(const CompiledSystem& system, const ModuleString& from, std::uint32_t step, std::size_t memory,
                   ModuleString& to) {
    const Plans& plans = system.plans;
    if (from.size() > plans.sizes.at_once || !from.has_lineage() || !is_roomy(from)) return false;
    const PackedSizes::Sum sum = plans.sizes.add_up(from.letters.data(), from.size());
    if (!sum.simple || sum.reads != from.parameters.size()) return false;
    const bool valued = plans.valued();
    // A column without elements has no room for blocks.
    if (sum.becomes.modules == 0 || (valued && sum.becomes.parameters == 0)) return false;
    Extent held = sum.becomes;
    held.siblings += from.siblings.size();
    const Extent before{from.size(), from.parameters.size(), from.siblings.size()};
    if (bytes_needed(before, true) + bytes_needed(held, true) > memory) return false;
    resize(to, sum.becomes, true);
    to.siblings = from.siblings.grown(sum.becomes.siblings);
    SmallWriter writer(from, step, to);
    if (!(valued ? writer.run<true>(plans) : writer.run<false>(plans))) return false;
    drop_unused_siblings(to);
    return true;
}

}  // namespace espalier::lsystem
