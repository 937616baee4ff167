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
#include "timeline/measures/module_quantities.h"

#include <fmt/format.h>

#include <map>
#include <optional>

namespace espalier::timeline {
namespace {

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
