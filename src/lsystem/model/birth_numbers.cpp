#include "lsystem/model/birth_numbers.h"

#include "base/bytes.h"

#include <algorithm>
#include <vector>

namespace espalier::lsystem {
namespace {

/// The rows of a step are the last ones of the table.
std::size_t first_row_of(std::uint32_t step, const SiblingTable& rows) {
    std::size_t row = rows.size();
    while (row > 0 && rows[row - 1].step == step) --row;
    return row;
}

/// Writes numbers into the rows of siblings from one on. Siblings whose numbers do not follow each other, because a
/// decomposition came between them, get several rows.
class NumberWriter {
public:
    NumberWriter(ModuleString& string, std::size_t first_row)
        : string_(string), first_row_(first_row), rows_now_(string.siblings.size() - first_row, none) {}

    void put(std::size_t module, std::uint64_t number) {
        Birth& birth = string_.births[module];
        std::uint32_t& row = rows_now_[birth.siblings - first_row_];
        const std::uint64_t first = number - birth.place;
        if (row == none) {
            row = birth.siblings;
            // A row that is right already may be read by others.
            if (string_.siblings[row].first_number != first) string_.siblings.added(row).first_number = first;
        } else if (first_number_of(row) != first) {
            Siblings more = string_.siblings[birth.siblings];
            more.first_number = first;
            row = static_cast<std::uint32_t>(string_.siblings.size() + more_.size());
            more_.push_back(more);
        }
        birth.siblings = row;
    }

    void finish() {
        const std::size_t rows = string_.siblings.size();
        string_.siblings = string_.siblings.grown(more_.size());
        for (std::size_t k = 0; k < more_.size(); ++k) string_.siblings.added(rows + k) = more_[k];
    }

private:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    std::uint64_t first_number_of(std::uint32_t row) const {
        const std::size_t rows = string_.siblings.size();
        return row < rows ? string_.siblings[row].first_number : more_[row - rows].first_number;
    }

    ModuleString& string_;
    const std::size_t first_row_;
    std::vector<std::uint32_t> rows_now_;  ///< by row: the one that its next module belongs to
    std::vector<Siblings> more_;
};

}  // namespace

std::size_t births_in(const ModuleString& string, std::uint32_t step) {
    const std::size_t first_row = first_row_of(step, string.siblings);
    if (first_row == string.siblings.size()) return 0;
    return static_cast<std::size_t>(std::count_if(string.births.begin(), string.births.end(),
                                                  [&](const Birth& birth) { return birth.siblings >= first_row; }));
}

void number_births(ModuleString& string, std::uint32_t step, std::uint64_t first) {
    const std::size_t first_row = first_row_of(step, string.siblings);
    NumberWriter writer(string, first_row);
    for (std::size_t module = 0; module < string.births.size(); ++module) {
        if (string.births[module].siblings >= first_row) writer.put(module, first++);
    }
    writer.finish();
}

std::size_t KeptNumbers::unknown(const ModuleString& string) const {
    std::size_t count = 0;
    for (std::size_t module = 0; module < string.births.size(); ++module) {
        count += !numbers_.contains(string.identity(module));
    }
    return count;
}

void KeptNumbers::number(ModuleString& string, std::uint64_t first) {
    NumberWriter writer(string, 0);
    for (std::size_t module = 0; module < string.births.size(); ++module) {
        const auto [number, is_new] = numbers_.emplace(string.identity(module), first);
        first += is_new;
        writer.put(module, number->second);
    }
    writer.finish();
}

void KeptNumbers::save(std::ostream& out) const {
    std::vector<std::pair<Identity, std::uint64_t>> sorted(numbers_.begin(), numbers_.end());
    std::sort(sorted.begin(), sorted.end());
    put(out, static_cast<std::uint64_t>(sorted.size()));
    for (const auto& [identity, number] : sorted) {
        put(out, identity);
        put(out, number);
    }
}

void KeptNumbers::restore(std::istream& in) {
    numbers_.clear();
    for (auto count = get<std::uint64_t>(in); count > 0; --count) {
        const auto identity = get<Identity>(in);
        numbers_[identity] = get<std::uint64_t>(in);
    }
}

}  // namespace espalier::lsystem
