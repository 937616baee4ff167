// statistics.csv: one row per step and plant, whatever `every` says.
//
// Parameters: statistics (true or false, default true); quantities ({ mass = "sum(Stem.2)" }: columns of one's own).
// Columns: step, time (in the scene's unit), plant (its number), name; then those of PlantStatistics, empty where there
// is none.
#include "espalier/timeline/recorder.h"

#include "base/bytes.h"
#include "base/csv_file.h"
#include "base/text.h"
#include "timeline/measures/plant_statistics.h"

#include <fmt/format.h>

#include <optional>

namespace espalier::timeline {
namespace {

class Statistics final : public Recorder {
public:
    Statistics(const Settings& settings, const RecorderContext& context)
        : path_(context.folder / "statistics.csv"), of_plants_(settings) {}

    bool sees_every_step() const override { return true; }

    void record(const Frame& frame) override {
        if (of_plants_.previous_step() < 0 && frame.begins) of_plants_.require_known(frame);
        if (!file_) begin(frame);
        for (const PlantFrame& plant : frame.plants) rows_ += row(frame, plant);
        if (!frame.ends) return;
        file_->append(std::exchange(rows_, {}));
        of_plants_.end_step(frame);
    }

    void finish() override {}

    void save(std::ostream& out) const override {
        if (file_) file_->keep();
        put(out, static_cast<std::uint64_t>(file_ ? file_->size() : 0));
        put(out, of_plants_.previous_step());
        put(out, static_cast<std::uint64_t>(quantities_.size()));
        for (const std::string& name : quantities_) put_text(out, name);
        of_plants_.save(out);
    }

    void restore(std::istream& in) override {
        if (const auto size = get<std::uint64_t>(in)) file_.emplace(path_, size);
        const auto previous_step = get<int>(in);
        for (auto names = get<std::uint64_t>(in); names > 0; --names) quantities_.push_back(get_text(in, 1 << 16));
        of_plants_.restore(in, previous_step);
    }

private:
    void begin(const Frame& frame) {
        std::string header = "step,time,plant,name";
        if (!frame.plants.empty()) quantities_ = quantity_names(frame.plants.front());
        for (const std::string& name : of_plants_.columns(quantities_)) header.append(",").append(csv_text(name));
        file_.emplace(path_, header);
    }

    std::string row(const Frame& frame, const PlantFrame& plant) {
        if (quantity_names(plant) != quantities_) {
            throw RunError(fmt::format("the quantities of plant '{}' at step {} are not the columns of {}", plant.name,
                                       frame.step, path_.string()));
        }
        std::string row =
            fmt::format("{},{},{},{}", frame.step, format_exact(frame.time), plant.plant, csv_text(plant.name));
        for (const double value : of_plants_.of(plant)) row.append(",").append(csv_number(value));
        return row + "\n";
    }

    std::filesystem::path path_;
    std::optional<CsvFile> file_;
    std::vector<std::string> quantities_;
    PlantStatistics of_plants_;
    std::string rows_;  ///< of the frame so far
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
