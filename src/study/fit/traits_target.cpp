// Measured traits: a table with a row for each plant, or the measured plants themselves, whose form is taken.
#include "espalier/base/error.h"
#include "espalier/language/measured_plants.h"
#include "espalier/lsystem/derivation.h"

#include "base/csv_rows.h"
#include "base/text.h"
#include "study/fit/form.h"
#include "study/fit/target.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::study {
namespace {

namespace fs = std::filesystem;
constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

/// Traits are figures of the form, or columns of statistics.csv at the end.
class Traits final : public Target {
public:
    Traits(std::vector<std::string> names, const std::vector<std::vector<double>>& rows)
        : names_(std::move(names)), worlds_(rows.size()), statistics_(names_, rows) {
        for (const std::string& name : names_) {
            const auto found = std::find(form_names().begin(), form_names().end(), name);
            figures_.push_back(found == form_names().end() ? none
                                                           : static_cast<std::size_t>(found - form_names().begin()));
        }
    }

    /// Of measured plants: where the first of them is.
    void set_places(MeasuredPlaces places) { places_ = std::move(places); }

    const std::vector<Statistic>& statistics() const override { return statistics_.measured(); }
    MeasuredPlaces places() const override { return places_; }
    std::size_t worlds() const override { return worlds_; }
    Needs needs() const override {
        return {std::any_of(figures_.begin(), figures_.end(), [](std::size_t figure) { return figure != none; }),
                false};
    }

    std::vector<double> of(std::span<const Grown> worlds) const override {
        std::vector<std::vector<double>> rows;
        for (const Grown& world : worlds) {
            std::vector<std::vector<double>> forms(world.plants.size());
            if (needs().geometry) forms = forms_of(world);
            for (const std::vector<double>& form : forms) rows.push_back(row_of(world, form));
        }
        return statistics_.of(rows);
    }

private:
    static constexpr std::size_t none = -1;

    std::vector<double> row_of(const Grown& world, const std::vector<double>& form) const {
        std::vector<double> row;
        for (std::size_t i = 0; i < names_.size(); ++i) {
            if (figures_[i] != none) {
                row.push_back(form[figures_[i]]);
                continue;
            }
            const auto column = std::find(world.columns.begin(), world.columns.end(), names_[i]);
            if (column == world.columns.end()) throw UserError(unknown_trait(names_[i], world.columns));
            row.push_back(world.course.back()[static_cast<std::size_t>(column - world.columns.begin())]);
        }
        return row;
    }

    static std::string unknown_trait(const std::string& name, std::vector<std::string> known) {
        known.insert(known.end(), form_names().begin(), form_names().end());
        return fmt::format("what has grown has no trait '{}'{}; it has {}", name, did_you_mean(name, known),
                           fmt::join(known, ", "));
    }

    std::vector<std::string> names_;
    std::vector<std::size_t> figures_;  ///< the number of each among those of forms
    std::size_t worlds_;
    RowStatistics statistics_;
    MeasuredPlaces places_;
};

/// The axes of a plant.
MeasuredPlaces places_of(const PlantGeometry& plant) {
    MeasuredPlaces places;
    const glm::dvec3* before = nullptr;
    for (const Internode& internode : plant.internodes) {
        const glm::dvec3& foot = plant.internodes.front().base;
        if (!before || *before != internode.base) places.lines.push_back({internode.base - foot});
        places.lines.back().push_back(internode.tip - foot);
        before = &internode.tip;
    }
    return places;
}

bool is_name_of_plants(const std::string& column) {
    return column == "plant" || column == "name" || column == "id" || column == "species";
}

/// Columns of numbers, each of which is a trait; a column of names may stand beside them.
std::shared_ptr<Target> read_table(const fs::path& file) {
    if (file.extension() != ".csv" && file.extension() != ".tsv") return nullptr;
    const CsvRows table(file);
    if (table.rows().size() < 2) return nullptr;
    const std::vector<std::string>& header = table.rows().front().cells;
    const auto has = [&](const char* name) { return std::find(header.begin(), header.end(), name) != header.end(); };
    if (has("step") || has("time") || (has("x") && has("y"))) return nullptr;  // a course, points
    std::vector<std::string> names;
    std::vector<std::vector<double>> rows(table.rows().size() - 1);
    for (std::size_t column = 0; column < header.size(); ++column) {
        if (is_name_of_plants(header[column])) continue;
        names.push_back(header[column]);
        for (std::size_t row = 1; row < table.rows().size(); ++row) {
            const CsvRow& cells = table.rows()[row];
            const auto number = cells.number(column);
            if (!number) {
                throw UserError(
                    table.place(cells, column),
                    fmt::format("expected a number of '{}'; a plant whose traits are not all measured is left "
                                "out of the table",
                                header[column]));
            }
            rows[row - 1].push_back(*number);
        }
    }
    if (names.empty()) throw UserError(Place{file.string(), 1, 0}, "expected columns with the traits of plants");
    return std::make_shared<Traits>(std::move(names), rows);
}

/// The form of each plant in a file of measured plants, but for what was not measured: nothing is 0 everywhere.
std::shared_ptr<Target> read_measured(const fs::path& file) {
    if (!holds_measured_plants(file)) return nullptr;
    const MeasuredPlants plants = read_measured_plants(file);
    Scene scene;
    Plant& plant = scene.plants.emplace_back();
    std::vector<std::vector<double>> all;
    MeasuredPlaces places;
    for (std::size_t i = 0; i < plants.plants.size(); ++i) {
        plant.model = compile(measured_model(plants, i));
        const auto grown = Growth(Subject{file}).grow(scene, 0, {true, false});
        if (!grown) throw UserError(fmt::format("{}: plant {} has more than a million modules", file.string(), i));
        if (i == 0) places = places_of(grown->first->geometry);
        for (std::vector<double>& form : forms_of(*grown)) all.push_back(std::move(form));
    }
    std::vector<std::string> names, absent;
    std::vector<std::vector<double>> rows(all.size());
    for (std::size_t figure = 0; figure < form_names().size(); ++figure) {
        const auto is_measured = [&](const auto& row) { return std::isfinite(row[figure]) && row[figure] != 0; };
        if (!std::all_of(all.begin(), all.end(), is_measured)) {
            absent.push_back(form_names()[figure]);
            continue;
        }
        names.push_back(form_names()[figure]);
        for (std::size_t row = 0; row < all.size(); ++row) rows[row].push_back(all[row][figure]);
    }
    auto traits = std::make_shared<Traits>(std::move(names), rows);
    traits->set_places(std::move(places));
    for (const Diagnostic& warning : plants.warnings) traits->notes.push_back(warning.message);
    if (!absent.empty())
        traits->notes.push_back(fmt::format("has no {}, which are not compared", fmt::join(absent, ", ")));
    return traits;
}

const Registered<TargetType> table_entry{
    {"traits", "a table (.csv) with a row for each measured plant: columns of statistics.csv, or figures of the form",
     read_table}};
const Registered<TargetType> measured_entry{
    {"measured-plants", "measured plants, as `espalier import` reads them: their form is compared", read_measured}};

}  // namespace
}  // namespace espalier::study
