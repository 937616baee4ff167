#include "lsystem/derive/small_step.h"

#include "lsystem/derive/lanes.h"
#include "lsystem/derive/writing.h"

#include <array>

namespace espalier {
namespace {

template <class T>
bool has_spare(const Column<T>& column, std::size_t spare) {
    return column.capacity() - column.size() >= spare;
}

bool is_roomy(const ModuleString& string, bool valued) {
    return has_spare(string.letters, spare_letters) && (!valued || has_spare(string.parameters, spare_values)) &&
           has_spare(string.identities, spare_lineage) && has_spare(string.parents, spare_lineage) &&
           has_spare(string.births, spare_lineage);
}

/// Modules that become others.
struct Changes {
    std::array<Change, PackedSizes::most> changes;  // unwritten
    std::size_t count = 0;
};

/// Writes in whole blocks; false if a value is not finite.
template <bool valued>
bool write_modules(const Plans& all, const ModuleString& from, ModuleString& to, Changes& changes) {
    const Plan* const plans = all.of_letter.data();
    const LetterId* in = from.letters.data();
    const LetterId* const end = in + from.size();
    const double* values = from.parameters.data();
    LetterId* out = to.letters.data();
    double* out_values = to.parameters.data();
    for (; in != end; ++in) {
        const Plan& plan = plans[*in];
        if (plan.production && !plan.inherits) {
            Change& change = changes.changes[changes.count++];
            change.module = static_cast<std::uint32_t>(in - from.letters.data());
            change.plan = static_cast<std::uint32_t>(plan.choices - all.choices.data());
        }
        copy_run<letter_block>(plan.length > letter_block ? plan.letters : plan.block.data(), out, plan.length);
        if constexpr (valued) {
            if (plan.kind == Plan::Kind::lanes) {
                if (!write_lanes(plan, values, out_values)) return false;
            } else if (plan.kind != Plan::Kind::bare) {
                copy_run<value_block>(values, out_values, plan.parameters);
            }
            values += plan.reads;
            out_values += plan.parameters;
        }
        out += plan.length;
    }
    return true;
}

}  // namespace

bool has_small_steps(const CompiledModel& model) {
    const CompiledSystem& main = model.main();
    return !model.nested && main.in_two_passes() && main.start_each.empty() && main.end_each.empty();
}

bool rewrite_small(const Plans& plans, const ModuleString& from, std::uint32_t step, std::size_t memory,
                   ModuleString& to) {
    const bool valued = plans.valued();
    if (from.size() > PackedSizes::most || !from.has_lineage() || !is_roomy(from, valued)) return false;
    std::uint64_t sizes = 0;
    for (const LetterId letter : from.letters) sizes += plans.sizes[letter];
    const Extent extent{sizes >> PackedSizes::bits & PackedSizes::mask, sizes >> 2 * PackedSizes::bits};
    // A string of many modules is written in parts, which say what the next step will do; a column without elements has
    // no room for blocks.
    const bool fits = extent.modules > 0 && extent.modules <= PackedSizes::most && (!valued || extent.parameters > 0) &&
                      (sizes & PackedSizes::mask) == from.parameters.size();
    const Extent before{from.size(), from.parameters.size()};
    if (!fits || bytes_needed(before, Ancestry::whole) + bytes_needed(extent, Ancestry::whole) > memory) return false;
    resize(to, extent, Ancestry::whole);
    Changes changes;
    const bool finite =
        valued ? write_modules<true>(plans, from, to, changes) : write_modules<false>(plans, from, to, changes);
    if (finite) write_lineage(plans, {changes.changes.data(), changes.count}, from, step, to);
    return finite;
}

}  // namespace espalier
