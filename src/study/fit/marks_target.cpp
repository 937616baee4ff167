// Axes that were marked on a picture: lengths of internodes and angles of branches, by order and place along the axis.
#include "espalier/base/error.h"

#include "analysis/marked_plant.h"
#include "base/csv_rows.h"
#include "study/fit/target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::study {
namespace {

namespace fs = std::filesystem;

constexpr double degrees_of_a_radian = 180 / std::numbers::pi;

class Marks final : public Target {
public:
    explicit Marks(const fs::path& file)
        : plant_(analysis::read_marked_plant(file)), measures_(measures_of(plant_, plant_.has_scale)) {
        double mean = 0;
        for (const auto& [cell, length] : measures_.lengths) {
            mean += length / static_cast<double>(measures_.lengths.size());
        }
        for (const auto& [cell, length] : measures_.lengths) {
            statistics_.push_back({fmt::format("length.{}.{}", cell.first, cell.second), length, mean});
        }
        for (const auto& [cell, angle] : measures_.angles) {
            statistics_.push_back({fmt::format("angle.{}.{}", cell.first, cell.second), angle, degrees_of_a_radian});
        }
    }

    const std::vector<Statistic>& statistics() const override { return statistics_; }

    std::vector<double> of(std::span<const Grown> worlds) const override {
        std::vector<double> values(statistics_.size(), 0);
        for (const Grown& world : worlds) {
            const AxisMeasures grown = measures_of(seen(world), plant_.has_scale);
            std::size_t i = 0;
            const auto add = [&](const auto& ours, const auto& theirs) {
                for (const auto& [cell, value] : ours) {
                    const auto found = theirs.find(cell);  // what is not there has no length
                    values[i++] += (found == theirs.end() ? 0 : found->second) / static_cast<double>(worlds.size());
                }
            };
            add(measures_.lengths, grown.lengths);
            add(measures_.angles, grown.angles);
        }
        return values;
    }

    /// Upright in the plane of the picture, the base of the main axis at 0.
    MeasuredPlaces places() const override {
        MeasuredPlaces places;
        const glm::dvec2 foot = plant_.axes.front().nodes.front();
        for (const MarkedAxis& axis : plant_.axes) {
            auto& line = places.lines.emplace_back();
            for (const glm::dvec2& node : axis.nodes) line.emplace_back(node - foot, 0);
        }
        places.has_scale = plant_.has_scale;
        return places;
    }

    std::string overlay(const Grown& world) const override { return analysis::overlay_of(plant_, seen(world)); }

private:
    static MarkedPlant seen(const Grown& world) {
        MarkedPlant plant = analysis::seen_from_the_front(world.first->geometry);
        if (plant.axes.empty()) throw UserError("the model draws no internode that marks could be compared with");
        return plant;
    }

    MarkedPlant plant_;
    AxisMeasures measures_;
    std::vector<Statistic> statistics_;
};

bool has_columns_of_marks(const fs::path& file) {
    const CsvRows table(file);
    if (table.rows().empty()) return false;
    const std::vector<std::string>& header = table.rows().front().cells;
    const auto has = [&](const char* name) { return std::find(header.begin(), header.end(), name) != header.end(); };
    return has("axis") && has("x") && has("y") && !has("z");
}

std::shared_ptr<Target> read_marks(const fs::path& file) {
    const bool is_marks = file.extension() == ".svg" || (file.extension() == ".csv" && has_columns_of_marks(file));
    return is_marks ? std::make_shared<Marks>(file) : nullptr;
}

const Registered<TargetType> marks_entry{
    {"marks", "axes marked on a picture: .svg, or .csv with the columns axis, x and y in metres", read_marks}};

}  // namespace
}  // namespace espalier::study
