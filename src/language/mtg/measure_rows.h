// What the rows of a multiscale tree graph measure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace espalier::language::mtg {

/// What of a row is read.
enum Measure { x, y, z, top, bottom, length, day, measures };

/// In the file's units, `day` from the first date of the file; NaN where a row has no number.
using Measures = std::array<double, measures>;

/// Rows of which only the measures that some column has take memory.
class MeasureRows {
public:
    /// Before the first row.
    void keep(const std::vector<Measure>& kept);
    void add(const Measures& values);

    std::size_t size() const { return kept_.empty() ? 0 : values_.size() / kept_.size(); }
    /// NaN for a measure that no column has.
    double at(std::size_t row, Measure which) const;
    Measures row(std::size_t row) const;
    /// Counts days from the first one.
    void count_from_first_day();

private:
    static constexpr std::size_t nowhere = measures;

    std::vector<Measure> kept_;
    std::array<std::size_t, measures> place_{};  ///< of each measure in a row
    std::vector<double> values_;
};

}  // namespace espalier::language::mtg
