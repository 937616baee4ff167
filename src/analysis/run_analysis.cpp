#include "espalier/analysis/run_analysis.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "analysis/plant_analysis.h"
#include "analysis/water.h"
#include "base/csv_file.h"
#include "base/json_text.h"
#include "base/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

namespace espalier::analysis {

struct RunAnalysis::Frame {
    int step = 0;
    double time = 0;
    std::vector<PlantAnalysis> plants;
    std::vector<std::string> symbols;  ///< that the frame knows

    /// Plants lie whole in one of the frame's files.
    static Frame read(const RecordedRun& run, const RecordedFrame& from, std::span<const std::uint32_t> plants,
                      const AnalysisOptions& options);
};

const std::vector<MeasureDescription>& measure_descriptions() {
    static const std::vector<MeasureDescription> all = [] {
        std::vector<MeasureDescription> descriptions;
        for (const Measure& measure : measures()) descriptions.push_back(measure.description);
        return descriptions;
    }();
    return all;
}

RunAnalysis::Frame RunAnalysis::Frame::read(const RecordedRun& run, const RecordedFrame& from,
                                            std::span<const std::uint32_t> plants, const AnalysisOptions& options) {
    Frame frame{from.step, from.time, {}, {}};
    std::map<std::uint32_t, PlantAnalysis> found;
    const auto add = [&](const FrameGeometry& geometry, const std::vector<std::uint32_t>& some) {
        for (PlantAnalysis& plant : analyse(geometry, some, options, run.folder()))
            found[plant.plant] = std::move(plant);
    };
    for (const RecordedFrame& piece : from.pieces()) {
        const FrameGeometry geometry = run.geometry(piece);
        const std::set<std::uint32_t> there(geometry.of_points.plants.begin(), geometry.of_points.plants.end());
        std::vector<std::uint32_t> here;
        std::copy_if(plants.begin(), plants.end(), std::back_inserter(here),
                     [&](std::uint32_t plant) { return there.contains(plant); });
        add(geometry, here);
        frame.symbols = geometry.symbol_names;
    }
    std::vector<std::uint32_t> without_points;
    std::copy_if(plants.begin(), plants.end(), std::back_inserter(without_points),
                 [&](std::uint32_t plant) { return !found.contains(plant); });
    add({}, without_points);
    for (const std::uint32_t plant : plants) frame.plants.push_back(found.at(plant));
    return frame;
}

RunAnalysis::~RunAnalysis() = default;

RunAnalysis::RunAnalysis(const RecordedRun& run, std::span<const RecordedFrame* const> frames,
                         std::span<const std::uint32_t> plants, const AnalysisOptions& options)
    : scene_(run.scene()),
      ground_(options.ground > 0 ? options.ground : run.ground_area().value_or(0)),
      frames_(frames.size()) {
    const std::set<std::uint32_t> wanted(plants.begin(), plants.end());
    for (const RecordedPlant& plant : run.plants()) {
        names_.push_back(plant.name);
        if (wanted.contains(plant.number)) plants_.push_back(plant);
    }
    tbb::parallel_for(std::size_t{0}, frames.size(),
                      [&](std::size_t i) { frames_[i] = Frame::read(run, *frames[i], plants, options); });
    align_layers(options);
    if (!run.folder().empty() && is_readable(run.folder() / "statistics.csv")) {
        stress_ = water_stress(run.statistics(), run.dt());
        std::erase_if(stress_, [&](const WaterStress& each) { return !wanted.contains(each.plant); });
    }
    std::vector<std::string> known;
    for (const Frame& frame : frames_) known.insert(known.end(), frame.symbols.begin(), frame.symbols.end());
    for (const std::string& symbol : options.leaf_symbols) {
        if (std::find(known.begin(), known.end(), symbol) == known.end()) {
            throw UserError(
                fmt::format("{} has no symbol '{}'{}", run.folder().string(), symbol, did_you_mean(symbol, known)));
        }
    }
}

// The same layers for all, also where a plant has nothing: who takes means over plants, steps and runs needs the zeros.
void RunAnalysis::align_layers(const AnalysisOptions& options) {
    double low = options.low, high = options.high;
    for (const Frame& frame : frames_) {
        for (const PlantAnalysis& plant : frame.plants) {
            if (plant.layers.empty()) continue;
            low = std::min(low, plant.layers.front().from);
            high = std::max(high, plant.layers.back().to);
        }
    }
    if (!(low < high)) return;
    const double thickness = options.layer > 0 ? options.layer : convenient_thickness(high - low);
    for (Frame& frame : frames_) {
        for (PlantAnalysis& plant : frame.plants) {
            plant.layers = merged_layers(plant.layers, thickness, low, high, plant.shadow, ground_);
        }
    }
}

RecordedTable RunAnalysis::table() const {
    RecordedTable table{{"step", "time", "plant"}, {}};
    for (const Measure& measure : measures()) table.columns.push_back(measure.description.name);
    for (const Frame& frame : frames_) {
        for (const PlantAnalysis& plant : frame.plants) {
            std::vector<double>& row = table.rows.emplace_back();
            row = {static_cast<double>(frame.step), frame.time, static_cast<double>(plant.plant)};
            for (const Measure& measure : measures()) row.push_back(measure.value(plant));
        }
    }
    return table;
}

RecordedTable RunAnalysis::stress() const {
    RecordedTable table{{"plant", "first_time", "time", "transpired", "demanded"}, {}};
    for (const WaterStress& each : stress_) {
        table.rows.push_back(
            {static_cast<double>(each.plant), each.first_time, each.time, each.transpired, each.demanded});
    }
    return table;
}

RecordedTable RunAnalysis::last_layers() const {
    RecordedTable table{
        {"step", "plant", "height", "length", "surface", "leaf_area", "density", "ground_density", "uptake"}, {}};
    if (frames_.empty()) return table;
    for (const PlantAnalysis& plant : frames_.back().plants) {
        for (const Layer& layer : plant.layers) {
            table.rows.push_back({static_cast<double>(frames_.back().step), static_cast<double>(plant.plant),
                                  (layer.from + layer.to) / 2, layer.length, layer.surface, layer.leaf_area,
                                  layer.density, layer.ground_density, layer.uptake});
        }
    }
    return table;
}

namespace {

/// Lines of comma-separated values behind what tells the plant; NaN is an empty cell.
class CsvText {
public:
    explicit CsvText(const std::string& header) : text_("step,time,plant,name," + header + "\n") {}

    template <class... Values>
    void add(const std::string& plant, Values... values) {
        add_all(plant, {static_cast<double>(values)...});
    }
    void add_all(const std::string& plant, const std::vector<double>& values) {
        text_ += plant;
        for (const double value : values) text_.append(",").append(csv_number(value));
        text_ += "\n";
    }
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

using Json = nlohmann::ordered_json;

Json number(double value) {
    if (!std::isfinite(value)) return nullptr;
    return value == std::floor(value) && std::abs(value) < 1e15 ? Json(static_cast<std::int64_t>(value)) : Json(value);
}

Json orders_json(const PlantAnalysis& plant) {
    Json orders = Json::array();
    for (std::size_t i = 0; i < plant.streams.size(); ++i) {
        const StreamOrder& of = plant.streams[i];
        orders.push_back({{"order", i + 1},
                          {"streams", of.streams},
                          {"internodes", of.internodes},
                          {"mean_length", number(of.mean_length)},
                          {"mean_diameter", number(of.mean_diameter)}});
    }
    return orders;
}

Json ramification_json(const PlantAnalysis& plant) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < plant.ramification.rows.size(); ++i) {
        Json parts = Json::array();
        for (const double part : plant.ramification.rows[i]) parts.push_back(number(part));
        rows.push_back({{"order", i + 2}, {"forks", plant.ramification.forks[i]}, {"parts", std::move(parts)}});
    }
    return rows;
}

Json layers_json(const PlantAnalysis& plant) {
    Json layers = Json::array();
    for (const Layer& layer : plant.layers) {
        layers.push_back({{"from", number(layer.from)},
                          {"to", number(layer.to)},
                          {"length", number(layer.length)},
                          {"surface", number(layer.surface)},
                          {"leaf_area", number(layer.leaf_area)},
                          {"density", number(layer.density)},
                          {"ground_density", number(layer.ground_density)},
                          {"uptake", number(layer.uptake)}});
    }
    return layers;
}

Json lengths_json(const PlantAnalysis& plant) {
    Json bins = Json::array();
    for (const LengthBin& bin : plant.lengths.bins) {
        bins.push_back({{"from", number(bin.from)}, {"to", number(bin.to)}, {"internodes", bin.internodes}});
    }
    return bins;
}

}  // namespace

std::string RunAnalysis::stress_text() const {
    std::string text = "plant,name,first_time,time,transpired,demanded\n";
    for (const WaterStress& each : stress_) {
        text +=
            fmt::format("{},{},{},{},{},{}\n", each.plant, csv_text(names_[each.plant]), csv_number(each.first_time),
                        csv_number(each.time), csv_number(each.transpired), csv_number(each.demanded));
    }
    return text;
}

void RunAnalysis::write_csv(const std::filesystem::path& folder) const {
    std::string names;
    for (const Measure& measure : measures()) names += (names.empty() ? "" : ",") + measure.description.name;
    CsvText measured(names);
    CsvText orders("order,streams,internodes,mean_length,mean_diameter");
    CsvText ramification("order,forks,column,part");
    CsvText layers("from,to,length,surface,leaf_area,density,ground_density,uptake");
    CsvText internodes("from,to,internodes");
    for (const Frame& frame : frames_) {
        for (const PlantAnalysis& of : frame.plants) {
            const std::string plant =
                fmt::format("{},{},{},{}", frame.step, csv_number(frame.time), of.plant, csv_text(names_[of.plant]));
            std::vector<double> values;
            for (const Measure& measure : measures()) values.push_back(measure.value(of));
            measured.add_all(plant, values);
            for (std::size_t i = 0; i < of.streams.size(); ++i) {
                const StreamOrder& order = of.streams[i];
                orders.add(plant, i + 1, order.streams, order.internodes, order.mean_length, order.mean_diameter);
            }
            for (std::size_t i = 0; i < of.ramification.rows.size(); ++i) {
                for (std::size_t j = 0; j < of.ramification.rows[i].size(); ++j) {
                    ramification.add(plant, i + 2, of.ramification.forks[i], j + 1, of.ramification.rows[i][j]);
                }
            }
            for (const Layer& layer : of.layers) {
                layers.add(plant, layer.from, layer.to, layer.length, layer.surface, layer.leaf_area, layer.density,
                           layer.ground_density, layer.uptake);
            }
            for (const LengthBin& bin : of.lengths.bins) {
                internodes.add(plant, bin.from, bin.to, bin.internodes);
            }
        }
    }
    write_text(folder / "analysis.csv", measured.text());
    write_text(folder / "orders.csv", orders.text());
    write_text(folder / "ramification.csv", ramification.text());
    write_text(folder / "layers.csv", layers.text());
    write_text(folder / "internodes.csv", internodes.text());
    if (!stress_.empty()) write_text(folder / "stress.csv", stress_text());
}

void RunAnalysis::write_json(const std::filesystem::path& folder) const {
    Json plants = Json::array(), frames = Json::array();
    for (const RecordedPlant& plant : plants_) {
        plants.push_back({{"plant", plant.number}, {"name", plant.name}, {"model", plant.model}});
    }
    for (const Frame& frame : frames_) {
        Json measured = Json::array();
        for (const PlantAnalysis& plant : frame.plants) {
            Json of = {{"plant", plant.plant}};
            for (const Measure& measure : measures()) of[measure.description.name] = number(measure.value(plant));
            of["orders"] = orders_json(plant);
            of["ramification"] = ramification_json(plant);
            of["layers"] = layers_json(plant);
            of["internode_lengths"] = lengths_json(plant);
            measured.push_back(std::move(of));
        }
        frames.push_back({{"step", frame.step}, {"time", number(frame.time)}, {"plants", std::move(measured)}});
    }
    Json json = {{"scene", scene_}, {"plants", std::move(plants)}, {"frames", std::move(frames)}};
    for (const WaterStress& each : stress_) {
        json["stress"].push_back({{"plant", each.plant},
                                  {"first_time", number(each.first_time)},
                                  {"time", number(each.time)},
                                  {"transpired", number(each.transpired)},
                                  {"demanded", number(each.demanded)}});
    }
    write_text(folder / "analysis.json", json_text(json, 1) + "\n");
}

}  // namespace espalier::analysis
