#include "lsystem/contexts/neighbours.h"

#include "base/parallel.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace espalier::lsystem {
namespace {

template <class Work>
void for_each_part(std::size_t parts, const Work& work) {
    if (parts == 1) return work(0);
    for_in_parallel(std::size_t{0}, parts, work);
}

std::size_t parts_of(std::size_t modules, std::size_t grain) {
    return (modules + grain - 1) / grain;
}

/// Scans a string in one direction. A state is the neighbour of the next module: its position, or its class.
template <class Value, bool Forward>
class Scan {
public:
    Scan(const ContextSide& side, const ModuleString& string, Column<Value>& column, std::vector<Section<Value>>& parts)
        : side_(side), letters_(string.letters.data()), size_(string.size()), column_(column), parts_(parts) {}

    void run(bool ring, std::size_t grain) {
        split(grain);
        for_each_part(parts_.size(), [&](std::size_t k) { scan(parts_[k]); });
        complete(ring);
    }
    void split(std::size_t grain) {
        // One thread alone needs no parts, which cost the more the more branches reach from one into another.
        if (tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism) == 1) grain = size_;
        column_.resize(size_);
        parts_.resize(parts_of(size_, grain));
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            parts_[k].begin = k * grain;
            parts_[k].end = std::min(parts_[k].begin + grain, size_);
        }
    }
    void complete(bool ring) {
        join(ring);
        for_each_part(parts_.size(), [&](std::size_t k) { complete(parts_[k]); });
    }

    static constexpr bool is_class = sizeof(Value) == 1;
    /// What lies before the part, or before a branch that ends in it.
    static constexpr Value unknown = static_cast<Value>(is_class ? 0xFF : Neighbours::none - 1);

private:
    static constexpr Value none = is_class ? 0 : static_cast<Value>(Neighbours::none);
    static constexpr LetterId begins = Forward ? Alphabet::open_bracket : Alphabet::close_bracket;
    static constexpr LetterId ends = Forward ? Alphabet::close_bracket : Alphabet::open_bracket;

    static Value pass(Value state, std::uint16_t code, std::size_t module) {
        const auto becomes = static_cast<Value>(is_class ? code : module);
        return code == ContextSide::ignored ? state : becomes;
    }

    void scan(Section<Value>& part);
    void join(bool ring);
    void complete(const Section<Value>& part);

    const ContextSide& side_;
    const LetterId* letters_;
    std::size_t size_;
    Column<Value>& column_;
    std::vector<Section<Value>>& parts_;
};

template <class Value, bool Forward>
void Scan<Value, Forward>::scan(Section<Value>& part) {
    part.exits.clear();
    part.entries.resize(part.end - part.begin + 1);
    Value* const base = part.entries.data();
    Value* top = base;
    // Kept at hand: writing to a column of bytes might, for all the compiler knows, change the members.
    Value* const out = column_.data();
    const LetterId* const letters = letters_;
    const std::uint16_t* const codes = side_.codes.data();
    const LetterId enters = side_.branches ? begins : no_letter, leaves = side_.branches ? ends : no_letter;
    Value state = unknown;
    std::size_t i = Forward ? part.begin : part.end - 1;
    for (std::size_t n = part.end - part.begin; n > 0; --n, Forward ? ++i : --i) {
        const LetterId letter = letters[i];
        out[i] = state;
        if (letter != leaves) {
            *top = state;
            top += letter == enters;
            state = pass(state, codes[letter], i);
        } else if (top != base) {
            state = *--top;
        } else {
            part.exits.push_back(static_cast<std::uint32_t>(i));
            state = unknown;
        }
    }
    part.last = state;
    part.entries.resize(static_cast<std::size_t>(top - base));
}

/// Follows branches from part to part. A bracket that ends no branch lets nothing be seen beyond it.
template <class Value, bool Forward>
void Scan<Value, Forward>::join(bool ring) {
    std::vector<Value> branches;
    Value before = unknown;  // before the whole string: in a ring, what is seen from behind it
    for (std::size_t n = 0; n < parts_.size(); ++n) {
        Section<Value>& part = parts_[Forward ? n : parts_.size() - 1 - n];
        part.beyond.assign(part.exits.size() + 1, none);
        part.beyond[0] = before;
        const std::size_t ended = std::min(part.exits.size(), branches.size());
        std::copy_n(branches.rbegin(), ended, part.beyond.begin() + 1);
        branches.resize(branches.size() - ended);
        const Value beyond = part.beyond.back();
        const auto known = [beyond](Value value) { return value == unknown ? beyond : value; };
        std::transform(part.entries.begin(), part.entries.end(), std::back_inserter(branches), known);
        before = known(part.last);
    }
    const Value around = ring && before != unknown ? before : none;
    for (Section<Value>& part : parts_) std::replace(part.beyond.begin(), part.beyond.end(), unknown, around);
}

/// Fills in what lies before the part, and before the branches that end in it.
template <class Value, bool Forward>
void Scan<Value, Forward>::complete(const Section<Value>& part) {
    Value* const column = column_.data();
    std::size_t from = Forward ? part.begin : part.end;
    for (std::size_t k = 0; k < part.beyond.size(); ++k) {
        const Value beyond = part.beyond[k];
        const bool exits = k < part.exits.size();
        const std::size_t to = Forward ? exits ? part.exits[k] + 1 : part.end : exits ? part.exits[k] : part.begin;
        for (std::size_t i = std::min(from, to), end = std::max(from, to); i < end; ++i) {
            column[i] = column[i] == unknown ? beyond : column[i];
        }
        from = to;
    }
}

using ScanLeft = Scan<std::uint8_t, true>;

/// Scans for both sides: a module becomes the left neighbour of those that follow, and is entered as the right
/// neighbour of the last module that has none yet.
void scan_both(const ContextSides& sides, const LetterId* letters, Section<std::uint8_t>& part, PendingRight& pending,
               std::uint8_t* const lefts, std::uint8_t* const rights) {
    const std::uint16_t* const left_codes = sides.left.codes.data();
    const std::uint16_t* const right_codes = sides.right.codes.data();
    const auto end_of_branch = static_cast<std::uint8_t>(right_codes[Alphabet::close_bracket]);
    part.exits.clear();
    pending.firsts.clear();
    pending.branches.resize(part.end - part.begin + 1);
    PendingRight::Branch* const base = pending.branches.data();
    PendingRight::Branch* top = base;
    std::fill(rights + part.begin, rights + part.end, std::uint8_t{0});
    std::uint8_t* entry = &pending.first;
    std::uint8_t left = ScanLeft::unknown;
    for (std::size_t i = part.begin, end = part.end; i < end; ++i) {
        const LetterId letter = letters[i];
        lefts[i] = left;
        if (letter > Alphabet::close_bracket) {
            const bool keeps = left_codes[letter] == ContextSide::ignored;
            *(keeps ? &pending.no_module : entry) = static_cast<std::uint8_t>(right_codes[letter]);
            entry = keeps ? entry : rights + i;
            left = keeps ? left : static_cast<std::uint8_t>(left_codes[letter]);
        } else if (letter == Alphabet::open_bracket) {
            *top++ = {entry, left};
            entry = &pending.no_module;
        } else {
            *entry = end_of_branch;
            if (top != base) {
                --top;
                entry = top->entry;
                left = top->left;
                continue;
            }
            part.exits.push_back(static_cast<std::uint32_t>(i));
            pending.firsts.push_back(pending.first);
            entry = &pending.first;
            left = ScanLeft::unknown;
        }
    }
    part.last = left;
    pending.entry = entry;
    pending.branches.resize(static_cast<std::size_t>(top - base));
    part.entries.clear();
    for (const PendingRight::Branch& branch : pending.branches) part.entries.push_back(branch.left);
}

}  // namespace

void Neighbours::find_both(const ContextSides& sides, const ModuleString& string) {
    ScanLeft left_scan(sides.left, string, left_classes, classes_);
    left_scan.split(grain_);
    right_classes.resize(string.size());
    pending_.resize(classes_.size());
    for_each_part(classes_.size(), [&](std::size_t k) {
        scan_both(sides, string.letters.data(), classes_[k], pending_[k], left_classes.data(), right_classes.data());
    });
    left_scan.complete(false);
    join_pending();
}

/// Tells those that wait at the end of a part what the next ones show them. Whoever entry in vain has no neighbour.
void Neighbours::join_pending() {
    std::vector<std::uint8_t*> branches;
    std::uint8_t* entry = nullptr;  // before the part
    const auto enter = [&](std::uint8_t seen) {
        if (entry) *entry = seen;
    };
    for (const PendingRight& pending : pending_) {
        for (const std::uint8_t seen : pending.firsts) {
            enter(seen);
            entry = branches.empty() ? nullptr : branches.back();
            if (!branches.empty()) branches.pop_back();
        }
        const auto known = [&](std::uint8_t* end) {
            return end == &pending.first ? entry : end == &pending.no_module ? nullptr : end;
        };
        if ((pending.branches.empty() ? pending.entry : pending.branches[0].entry) != &pending.first)
            enter(pending.first);
        for (const PendingRight::Branch& branch : pending.branches) branches.push_back(known(branch.entry));
        entry = known(pending.entry);
    }
}

void Neighbours::find(const ContextSides& sides, const ModuleString& string) {
    if (string.empty()) return;
    if (sides.positions) {
        if (sides.left.wanted) Scan<std::uint32_t, true>(sides.left, string, left, positions_).run(sides.ring, grain_);
        if (sides.right.wanted)
            Scan<std::uint32_t, false>(sides.right, string, right, positions_).run(sides.ring, grain_);
        if (sides.next.wanted) Scan<std::uint32_t, false>(sides.next, string, next, positions_).run(sides.ring, grain_);
    } else if (sides.at_once) {
        find_both(sides, string);
    } else {
        if (sides.left.wanted)
            Scan<std::uint8_t, true>(sides.left, string, left_classes, classes_).run(sides.ring, grain_);
        if (sides.right.wanted)
            Scan<std::uint8_t, false>(sides.right, string, right_classes, classes_).run(sides.ring, grain_);
    }
}

std::size_t ParameterPlaces::find(const ModuleString& string, const std::uint16_t* arities) {
    within_.resize(string.size());
    bases_.resize(parts_of(string.size(), grain));
    for_each_part(bases_.size(), [&](std::size_t k) {
        std::uint32_t at = 0;
        const std::size_t begin = k * grain, end = std::min(begin + grain, string.size());
        for (std::size_t i = begin; i < end; ++i) {
            within_[i] = at;
            at += arities[string.letters[i]];
        }
        bases_[k] = at;
    });
    std::size_t at = 0;
    for (std::size_t& base : bases_) at += std::exchange(base, at);
    return at;
}

}  // namespace espalier::lsystem
