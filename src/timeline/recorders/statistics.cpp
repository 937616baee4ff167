// statistics.csv: one row per step and plant, whatever `every` says.
//
// Parameters: statistics (true or false, default true); quantities ({ mass = "sum(Stem.2)" }: columns of one's own).
// Columns: step, time (in the scene's unit), plant (its number), name; modules (of the string, brackets included);
// queries; internodes; organs (polygons included); length (m, of all internodes); height (m, highest point above the
// base of the first internode); volume (m3, of all internodes); born, died (modules since the step before, brackets
// included); then the processes' quantities and one's own, empty where there is none.
#include "espalier/timeline/recorder.h"

#include "base/bytes.h"
#include "base/csv_file.h"
#include "base/text.h"
#include "timeline/measures/highest_point.h"
#include "timeline/meshes/chosen_parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::timeline {
namespace {

/// A sum, mean, least or greatest value of a parameter over the modules of a plant, or their number.
class ModuleQuantities {
public:
    /// Reads the table. Throws UserError for text that is not FUNCTION(SYMBOL.NUMBER).
    explicit ModuleQuantities(const Settings& table);

    std::vector<std::string> names() const;
    /// Throws UserError for symbols that no model has.
    void require_known(std::span<const Model* const> models) const;
    /// In the order of the names. NaN: the mean, least and greatest value where there is no such module.
    std::vector<double> of(const PlantFrame& plant) const;

private:
    enum class Function { sum, mean, min, max, count };

    std::vector<ChosenParameter> parameters_;
    std::vector<Function> functions_;
};

const std::vector<std::string> functions{"sum", "mean", "min", "max", "count"};

/// Sums up the values met so far.
struct Total {
    double sum = 0, least = std::numeric_limits<double>::infinity(), greatest = -least;
    std::size_t count = 0;

    void add(double value) {
        sum += value;
        least = std::min(least, value);
        greatest = std::max(greatest, value);
        ++count;
    }
};

ModuleQuantities::ModuleQuantities(const Settings& table) {
    for (const std::string& name : table.keys()) {
        const std::string text = table.text(name);
        const Place place = table.place(name);
        const std::size_t open = text.find('(');
        if (open == std::string::npos || !text.ends_with(')')) {
            throw UserError(place, fmt::format("'{}' must be a function of a parameter, as in \"sum(F.2)\", not \"{}\"",
                                               name, text));
        }
        const std::string function = text.substr(0, open);
        const auto found = std::find(functions.begin(), functions.end(), function);
        if (found == functions.end()) {
            throw UserError(place, fmt::format("there is no function '{}'{}; there are {}", function,
                                               did_you_mean(function, functions), fmt::join(functions, ", ")));
        }
        functions_.push_back(static_cast<Function>(found - functions.begin()));
        parameters_.push_back(chosen_parameter(text.substr(open + 1, text.size() - open - 2), name, place));
    }
}

std::vector<std::string> ModuleQuantities::names() const {
    std::vector<std::string> names;
    for (const ChosenParameter& parameter : parameters_) names.push_back(parameter.name);
    return names;
}

void ModuleQuantities::require_known(std::span<const Model* const> models) const {
    timeline::require_known(parameters_, models);
}

std::vector<double> ModuleQuantities::of(const PlantFrame& plant) const {
    if (parameters_.empty()) return {};
    const Alphabet& alphabet = plant.model->alphabet;
    std::vector<ParameterSlots> slots;
    for (const ChosenParameter& parameter : parameters_) slots.emplace_back(parameter, alphabet);
    std::vector<Total> totals(slots.size());
    const double* values = plant.string->parameters.data();
    for (std::size_t module = 0; module < plant.string->size(); ++module) {
        for (std::size_t k = 0; k < slots.size(); ++k) {
            const int slot = slots[k].find(*plant.string, module);
            if (slot >= 0) totals[k].add(values[slot]);
        }
        values += alphabet.arity(plant.string->letters[module]);
    }
    std::vector<double> results;
    for (std::size_t k = 0; k < totals.size(); ++k) {
        const Total& total = totals[k];
        const auto count = static_cast<double>(total.count);
        const double values_of[] = {total.sum, total.sum / count, total.least, total.greatest, count};
        const bool is_none = total.count == 0 && functions_[k] != Function::sum && functions_[k] != Function::count;
        results.push_back(is_none ? std::numeric_limits<double>::quiet_NaN()
                                  : values_of[static_cast<std::size_t>(functions_[k])]);
    }
    return results;
}

std::vector<std::string> quantity_names(const PlantFrame& plant) {
    std::vector<std::string> names;
    for (const Quantity& quantity : plant.quantities) names.push_back(quantity.name);
    return names;
}

double height(const PlantGeometry& geometry) {
    const std::optional<double> top = highest_point(geometry);
    if (!top) return 0;
    const double base = geometry.internodes.empty() ? geometry.bounds.lower.y : geometry.internodes.front().base.y;
    return *top - base;
}

// Modules whose life began after `step`.
std::size_t born_after(const ModuleString& string, int step) {
    std::size_t born = 0;
    for (std::size_t module = 0; module < string.births.size(); ++module) {
        born += static_cast<std::int64_t>(string.step_of_birth(module)) > step;
    }
    return born;
}

class Statistics final : public Recorder {
public:
    Statistics(const Settings& settings, const RecorderContext& context)
        : path_(context.folder / "statistics.csv"), own_(settings.table("quantities")) {}

    bool sees_every_step() const override { return true; }

    void record(const Frame& frame) override {
        if (previous_step_ < 0 && frame.begins) own_.require_known(frame.models);
        if (!file_) begin(frame);
        for (const PlantFrame& plant : frame.plants) rows_ += row(frame, plant);
        if (!frame.ends) return;
        file_->append(std::exchange(rows_, {}));
        previous_step_ = frame.step;
    }

    void finish() override {}

    void save(std::ostream& out) const override {
        if (file_) file_->keep();
        put(out, static_cast<std::uint64_t>(file_ ? file_->size() : 0));
        put(out, previous_step_);
        put(out, static_cast<std::uint64_t>(quantities_.size()));
        for (const std::string& name : quantities_) put_text(out, name);
        put(out, static_cast<std::uint64_t>(modules_.size()));
        for (const auto& [plant, modules] : modules_) {
            put(out, plant);
            put(out, static_cast<std::uint64_t>(modules));
        }
    }

    void restore(std::istream& in) override {
        if (const auto size = get<std::uint64_t>(in)) file_.emplace(path_, size);
        previous_step_ = get<int>(in);
        for (auto names = get<std::uint64_t>(in); names > 0; --names) quantities_.push_back(get_text(in, 1 << 16));
        for (auto plants = get<std::uint64_t>(in); plants > 0; --plants) {
            const auto plant = get<std::uint32_t>(in);
            modules_[plant] = get<std::uint64_t>(in);
        }
    }

private:
    void begin(const Frame& frame) {
        std::string header = "step,time,plant,name,modules,queries,internodes,organs,length,height,volume,born,died";
        if (!frame.plants.empty()) quantities_ = quantity_names(frame.plants.front());
        for (const std::string& name : quantities_) header.append(",").append(csv_text(name));
        for (const std::string& name : own_.names()) header.append(",").append(csv_text(name));
        file_.emplace(path_, header);
    }

    std::string row(const Frame& frame, const PlantFrame& plant) {
        if (quantity_names(plant) != quantities_) {
            throw RunError(fmt::format("the quantities of plant '{}' at step {} are not the columns of {}", plant.name,
                                       frame.step, path_.string()));
        }
        const PlantGeometry& geometry = plant.interpretation->geometry;
        const std::size_t modules = plant.string->size();
        const std::size_t queries = plant.interpretation->queries.size() + plant.interpretation->answers.size();
        std::string row =
            fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}", frame.step, format_exact(frame.time), plant.plant,
                        csv_text(plant.name), modules, queries, geometry.internodes.size(),
                        geometry.organs.size() + geometry.polygons.size(), format_exact(total_length(geometry)),
                        format_exact(height(geometry)), format_exact(total_volume(geometry)), turnover(plant));
        for (const Quantity& quantity : plant.quantities) row.append(",").append(csv_number(quantity.value));
        for (const double value : own_.of(plant)) row.append(",").append(csv_number(value));
        return row + "\n";
    }

    // "born,died". Every module was here one step ago or is born since; those that were and are not have died.
    std::string turnover(const PlantFrame& plant) {
        const std::size_t now = plant.string->size();
        const std::size_t before = std::exchange(modules_[plant.plant], now);
        if (!plant.string->has_lineage() && now > 0) return ",";
        const std::size_t born = born_after(*plant.string, previous_step_);
        return fmt::format("{},{}", born, before + born - now);
    }

    std::filesystem::path path_;
    std::optional<CsvFile> file_;
    std::vector<std::string> quantities_;
    ModuleQuantities own_;
    std::string rows_;                              ///< of the frame so far
    std::map<std::uint32_t, std::size_t> modules_;  ///< per plant, one step ago
    int previous_step_ = -1;
};

const Registered<RecorderType> entry{
    {"statistics", "statistics.csv: a row per step and plant",
     "statistics  true; false: the file is not written\n"
     "quantities  {}; columns of your own, as { mass = \"sum(Stem.2)\" }: the sum, mean, min, max or count of a "
     "parameter\n"
     "            over the modules of a plant; parameters are counted from 1",
     [](Settings& settings, const RecorderContext& context) -> std::unique_ptr<Recorder> {
         if (!settings.flag_or("statistics", true)) return nullptr;
         return std::make_unique<Statistics>(settings, context);
     }}};

}  // namespace
}  // namespace espalier::timeline
