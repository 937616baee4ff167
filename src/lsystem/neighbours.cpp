#include "neighbours.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace espalier {
namespace {

template <class Work>
void for_each_part(std::size_t parts, const Work& work) {
    if (parts == 1) return work(0);
    tbb::parallel_for(std::size_t{0}, parts, work);
}

std::size_t parts_of(std::size_t modules) {
    return (modules + Neighbours::grain - 1) / Neighbours::grain;
}

/// Looks along a string in one direction. A state is what the next module sees: a neighbour's position, or its class.
template <class Value, bool Forward>
class Look {
public:
    Look(const Gaze& gaze, const ModuleString& string, Column<Value>& column, std::vector<Section<Value>>& parts)
        : gaze_(gaze), letters_(string.letters.data()), size_(string.size()), column_(column), parts_(parts) {}

    void run(bool ring) {
        column_.resize(size_);
        parts_.resize(parts_of(size_));
        for_each_part(parts_.size(), [&](std::size_t k) { scan(k); });
        join(ring);
        for_each_part(parts_.size(), [&](std::size_t k) { complete(parts_[k]); });
    }

private:
    static constexpr bool is_class = sizeof(Value) == 1;
    static constexpr Value none = is_class ? 0 : static_cast<Value>(Neighbours::none);
    /// What lies before the part, or before a branch that ends in it.
    static constexpr Value unknown = static_cast<Value>(is_class ? 0xFF : Neighbours::none - 1);
    static constexpr LetterId enters = Forward ? Alphabet::open_bracket : Alphabet::close_bracket;

    /// The n-th module of a part that begins, in the direction of looking, with module `first`.
    static std::size_t at(std::size_t first, std::size_t n) { return Forward ? first + n : first - n; }
    static std::size_t first_of(const Section<Value>& part) { return Forward ? part.begin : part.end - 1; }

    Value pass(Value state, LetterId letter, std::size_t module) const {
        const std::uint16_t code = gaze_.codes[letter];
        if constexpr (is_class) return static_cast<Value>((state & (code >> 8)) | code);
        return code == Gaze::keeps ? state : static_cast<Value>(module);
    }

    void scan(std::size_t k);
    void join(bool ring);
    void complete(const Section<Value>& part);

    const Gaze& gaze_;
    const LetterId* letters_;
    std::size_t size_;
    Column<Value>& column_;
    std::vector<Section<Value>>& parts_;
};

template <class Value, bool Forward>
void Look<Value, Forward>::scan(std::size_t k) {
    Section<Value>& part = parts_[k];
    part.begin = k * Neighbours::grain;
    part.end = std::min(part.begin + Neighbours::grain, size_);
    part.exits.clear();
    part.entries.resize(part.end - part.begin);
    Value* const base = part.entries.data();
    Value* top = base;
    Value* const out = column_.data();
    const LetterId brackets = gaze_.branches ? 2 : 0;
    Value state = unknown;
    const std::size_t first = first_of(part), count = part.end - part.begin;
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t i = at(first, n);
        const LetterId letter = letters_[i];
        out[i] = state;
        if (letter >= brackets) {
            state = pass(state, letter, i);
        } else if (letter == enters) {
            *top++ = state;
            state = pass(state, letter, i);
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
void Look<Value, Forward>::join(bool ring) {
    std::vector<Value> branches;
    Value before = unknown;  // of the whole string: in a ring, what is seen from behind it
    for (std::size_t n = 0; n < parts_.size(); ++n) {
        Section<Value>& part = parts_[Forward ? n : parts_.size() - 1 - n];
        part.beyond.assign(1, before);
        for (std::size_t k = 0; k < part.exits.size(); ++k) {
            part.beyond.push_back(branches.empty() ? none : branches.back());
            if (!branches.empty()) branches.pop_back();
        }
        const auto known = [&](Value value) { return value == unknown ? part.beyond.back() : value; };
        for (const Value entry : part.entries) branches.push_back(known(entry));
        before = known(part.last);
    }
    const Value around = ring && before != unknown ? before : none;
    for (Section<Value>& part : parts_) std::replace(part.beyond.begin(), part.beyond.end(), unknown, around);
}

/// Fills in what lies before the part, and before the branches that end in it.
template <class Value, bool Forward>
void Look<Value, Forward>::complete(const Section<Value>& part) {
    const std::size_t first = first_of(part), count = part.end - part.begin;
    for (std::size_t k = 0; k < part.beyond.size(); ++k) {
        const auto distance = [&](std::size_t exit) { return Forward ? exit - first : first - exit; };
        const std::size_t stop = k < part.exits.size() ? distance(part.exits[k]) + 1 : count;
        std::size_t depth = 0;
        for (std::size_t n = k == 0 ? 0 : distance(part.exits[k - 1]) + 1; n < stop; ++n) {
            const std::size_t i = at(first, n);
            if (column_[i] == unknown)
                column_[i] = part.beyond[k];
            else if (depth == 0)
                break;
            if (!gaze_.branches || letters_[i] > Alphabet::close_bracket) continue;
            depth = letters_[i] == enters ? depth + 1 : depth - (depth > 0);
        }
    }
}

}  // namespace

void Neighbours::find(const Gazes& gazes, const ModuleString& string) {
    if (string.empty()) return;
    if (gazes.positions) {
        if (gazes.left.wanted) Look<std::uint32_t, true>(gazes.left, string, left, positions_).run(gazes.ring);
        if (gazes.right.wanted) Look<std::uint32_t, false>(gazes.right, string, right, positions_).run(gazes.ring);
        if (gazes.next.wanted) Look<std::uint32_t, false>(gazes.next, string, next, positions_).run(gazes.ring);
    } else {
        if (gazes.left.wanted) Look<std::uint8_t, true>(gazes.left, string, left_classes, classes_).run(gazes.ring);
        if (gazes.right.wanted) Look<std::uint8_t, false>(gazes.right, string, right_classes, classes_).run(gazes.ring);
    }
}

std::size_t ParameterPlaces::find(const ModuleString& string, const std::uint16_t* arities) {
    within_.resize(string.size());
    bases_.resize(parts_of(string.size()));
    for_each_part(bases_.size(), [&](std::size_t k) {
        std::uint32_t at = 0;
        const std::size_t begin = k * Neighbours::grain, end = std::min(begin + Neighbours::grain, string.size());
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

}  // namespace espalier
