#include "study/fit/target.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include <fmt/format.h>

#include <cmath>

namespace espalier::study {
namespace {

constexpr std::size_t enough_for_deviations = 3;
constexpr double scale_of_one = 0.05, no_deviation = 1e-6;  // of the value

struct Moments {
    double mean = 0, deviation = 0;
};

Moments moments(const std::vector<std::vector<double>>& rows, std::size_t column) {
    const auto count = static_cast<double>(rows.size());
    Moments found;
    for (const auto& row : rows) found.mean += row[column] / count;
    for (const auto& row : rows) found.deviation += (row[column] - found.mean) * (row[column] - found.mean);
    found.deviation = rows.size() < 2 ? 0 : std::sqrt(found.deviation / (count - 1));
    return found;
}

}  // namespace

std::shared_ptr<Target> read_target(const std::filesystem::path& file) {
    if (!is_readable(file)) throw UserError(fmt::format("cannot read {}: the file does not exist", file.string()));
    std::string kinds;
    for (const auto& [name, type] : registered<TargetType>()) {
        if (auto target = type->read(file)) return target;
        kinds += fmt::format("\n  {}: {}", name, type->summary);
    }
    throw UserError(fmt::format("{} is nothing that plants are compared with; what they are:{}", file.string(), kinds));
}

RowStatistics::RowStatistics(const std::vector<std::string>& names, const std::vector<std::vector<double>>& measured)
    : columns_(names.size()) {
    std::vector<Statistic> deviations;
    const auto count = static_cast<double>(measured.size());
    for (std::size_t column = 0; column < columns_; ++column) {
        const Moments found = moments(measured, column);
        const bool deviates = found.deviation > no_deviation * std::abs(found.mean);
        const double usual = found.mean != 0 ? scale_of_one * std::abs(found.mean) : 1;
        const double scale = deviates ? found.deviation / std::sqrt(count) : usual;
        statistics_.push_back({names[column], found.mean, scale});
        if (!deviates || measured.size() < enough_for_deviations) continue;
        deviating_.push_back(column);
        deviations.push_back({names[column] + ".deviation", found.deviation, scale});
    }
    statistics_.insert(statistics_.end(), deviations.begin(), deviations.end());
}

std::vector<double> RowStatistics::of(const std::vector<std::vector<double>>& rows) const {
    std::vector<double> values;
    for (std::size_t column = 0; column < columns_; ++column) values.push_back(moments(rows, column).mean);
    for (const std::size_t column : deviating_) values.push_back(moments(rows, column).deviation);
    return values;
}

}  // namespace espalier::study
