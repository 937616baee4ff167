#include "language/mtg/measure_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::language::mtg {

void MeasureRows::keep(const std::vector<Measure>& kept) {
    kept_ = kept;
    place_.fill(nowhere);
    for (std::size_t i = 0; i < kept.size(); ++i) place_[kept[i]] = i;
}

void MeasureRows::add(const Measures& values) {
    for (const Measure which : kept_) values_.push_back(values[which]);
}

double MeasureRows::at(std::size_t row, Measure which) const {
    if (place_[which] == nowhere) return std::numeric_limits<double>::quiet_NaN();
    return values_[row * kept_.size() + place_[which]];
}

Measures MeasureRows::row(std::size_t row) const {
    Measures values;
    for (std::size_t i = 0; i < measures; ++i) values[i] = at(row, static_cast<Measure>(i));
    return values;
}

void MeasureRows::count_from_first_day() {
    if (place_[day] == nowhere) return;
    double first = INFINITY;
    for (std::size_t at = place_[day]; at < values_.size(); at += kept_.size()) {
        if (!std::isnan(values_[at])) first = std::min(first, values_[at]);
    }
    for (std::size_t at = place_[day]; at < values_.size(); at += kept_.size()) values_[at] -= first;
}

}  // namespace espalier::language::mtg
