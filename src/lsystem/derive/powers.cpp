#include "lsystem/derive/powers.h"

#include "lsystem/derive/rewriting.h"

#include <algorithm>

namespace espalier {
namespace {

/// The words that letters become: where each stands in the new string for the first time, to be copied from there.
class Powers {
public:
    Powers(const Plans& plans, const ModuleString& from, int steps);

    bool has_parameters() const { return parameters_; }
    /// The length of the string after so many steps, at most `BranchLinks::none`.
    std::size_t size_after(int steps) const;
    void write(ModuleString& to);

private:
    static constexpr std::size_t most = BranchLinks::none;
    static constexpr std::size_t unwritten = std::size_t(-1);

    void find_letters();
    void find_lengths(int steps);
    void write(LetterId letter, std::size_t steps);
    void append(const LetterId* from, std::size_t count);
    std::size_t word(LetterId letter, std::size_t steps) const { return steps * plans_.of_letter.size() + letter; }

    const Plans& plans_;
    const ModuleString& from_;
    int steps_;
    bool parameters_ = false;
    std::vector<LetterId> letters_;             ///< that the strings may hold
    std::vector<std::size_t> lengths_, first_;  ///< of words
    LetterId *begin_ = nullptr, *out_ = nullptr;
};

Powers::Powers(const Plans& plans, const ModuleString& from, int steps) : plans_(plans), from_(from), steps_(steps) {
    find_letters();
    if (!parameters_) find_lengths(steps);
}

void Powers::find_letters() {
    std::vector<bool> seen(plans_.of_letter.size());
    const auto see = [&](LetterId letter) {
        if (seen[letter]) return;
        seen[letter] = true;
        letters_.push_back(letter);
    };
    for (const LetterId letter : from_.letters) see(letter);
    for (std::size_t k = 0; k < letters_.size(); ++k) {
        const Plan& plan = plans_.of_letter[letters_[k]];
        parameters_ |= plan.arity > 0;
        if (!plan.production) continue;
        for (std::uint32_t i = 0; i < plan.length; ++i) see(plan.letters[i]);
    }
}

void Powers::find_lengths(int steps) {
    const auto levels = static_cast<std::size_t>(steps) + 1;
    lengths_.assign(levels * plans_.of_letter.size(), 1);
    first_.assign(levels * plans_.of_letter.size(), unwritten);
    for (std::size_t k = 1; k < levels; ++k) {
        for (const LetterId letter : letters_) {
            const Plan& plan = plans_.of_letter[letter];
            if (!plan.production) continue;
            std::size_t length = 0;
            for (std::uint32_t i = 0; i < plan.length && length < most; ++i)
                length += lengths_[word(plan.letters[i], k - 1)];
            lengths_[word(letter, k)] = std::min(length, most);
        }
    }
}

std::size_t Powers::size_after(int steps) const {
    std::size_t size = 0;
    for (const LetterId letter : from_.letters) {
        size += lengths_[word(letter, static_cast<std::size_t>(steps))];
        if (size >= most) return most;
    }
    return size;
}

void Powers::append(const LetterId* from, std::size_t count) {
    out_ = std::copy_n(from, count, out_);
}

void Powers::write(LetterId letter, std::size_t steps) {
    const std::size_t length = lengths_[word(letter, steps)];
    std::size_t& first = first_[word(letter, steps)];
    if (first != unwritten) return append(begin_ + first, length);
    first = static_cast<std::size_t>(out_ - begin_);
    const Plan& plan = plans_.of_letter[letter];
    if (steps == 0 || !plan.production) {
        *out_++ = letter;
    } else if (steps == 1) {
        append(plan.letters, plan.length);
    } else {
        for (std::uint32_t i = 0; i < plan.length; ++i) write(plan.letters[i], steps - 1);
    }
}

void Powers::write(ModuleString& to) {
    begin_ = out_ = to.letters.data();
    for (const LetterId letter : from_.letters) write(letter, static_cast<std::size_t>(steps_));
}

}  // namespace

bool has_powers(const CompiledModel& model) {
    const CompiledSystem& main = model.main();
    return !model.nested && main.plans.all_known && !main.plans.spelled && main.decomposition.empty() &&
           !main.ordered() && !main.may_cut && main.start_each.empty() && main.end_each.empty() && main.end.empty();
}

bool raise_to_power(const CompiledSystem& model, const ModuleString& from, int steps, std::size_t memory,
                    ModuleString& to) {
    if (!from.parameters.empty()) return false;
    Powers powers(model.plans, from, steps);
    if (powers.has_parameters()) return false;
    std::size_t before = from.size();
    for (int k = 1; k <= steps; ++k) {
        const std::size_t size = powers.size_after(k);
        // Strings have an eighth more room than they need.
        const std::size_t bytes =
            bytes_needed({before + before / 8}, Ancestry::none) + bytes_needed({size}, Ancestry::none);
        if (size >= BranchLinks::none || bytes > memory) return false;
        before = size;
    }
    if (from.bytes() + bytes_needed({before}, Ancestry::none) > memory) return false;
    resize(to, {before}, Ancestry::none);
    powers.write(to);
    return true;
}

}  // namespace espalier
