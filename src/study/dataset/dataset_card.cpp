#include "study/dataset/dataset_card.h"

#include "base/json_text.h"
#include "study/fit/form.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace espalier::study {
namespace {

using Json = nlohmann::ordered_json;

std::size_t samples_in(const std::vector<DatasetSample>& samples, const std::string& split) {
    return static_cast<std::size_t>(
        std::count_if(samples.begin(), samples.end(), [&](const DatasetSample& one) { return one.split == split; }));
}

std::string command_of(const DatasetPlan& plan) {
    return fmt::format("espalier dataset {} --samples {} --seed {}", plan.file.filename().string(), plan.samples,
                       plan.seed);
}

/// A column of dataset.csv: its unit, and what it tells.
struct DatasetColumn {
    std::string name, unit, meaning;
};

std::vector<DatasetColumn> columns_of(const DatasetPlan& plan) {
    std::vector<DatasetColumn> columns{{"sample", "", "number of the sample, and of its folder in samples/"},
                                       {"split", "", "the part that it belongs to"},
                                       {"seed", "", "seed of its random numbers"}};
    for (const Unknown& parameter : plan.parameters) columns.push_back({parameter.name, "", parameter.prior->text()});
    columns.push_back({"plant", "", "name of the plant in its scene"});
    for (const std::string& name : form_names()) columns.push_back({name, unit_of_form(name), "of the grown plant"});
    columns.push_back({"points", "", "of the scan"});
    columns.push_back({"pictures", "", "of the sample"});
    columns.push_back({"failed", "", "why the sample has no measurements; empty: it has"});
    return columns;
}

/// The files of a sample, and what they hold.
std::vector<std::pair<std::string, std::string>> files_of(const DatasetPlan& plan) {
    std::vector<std::pair<std::string, std::string>> files;
    if (plan.scan) {
        files.emplace_back("points" + plan.scan->extension,
                           "the points of the scan, metres; `organ` is a row of organs.csv");
        files.emplace_back("organs.csv", "plant, identity, symbol, order, birth and age (steps) of each organ");
    }
    if (plan.pictures) files.emplace_back("view-N.png", "a picture from the N-th azimuth");
    if (plan.pictures && plan.pictures->masks) {
        files.emplace_back("view-N-depth.npy", "float32, metres along the direction of view; 0: nothing is there");
        files.emplace_back("view-N-normal.npy", "float32, x, y, z of the surface's normal; 0: nothing is there");
        files.emplace_back("view-N-organ.npy", "int32, a row of view-N-organs.csv; -1: none");
        files.emplace_back("view-N-plant.png, view-N-symbol.png", "16 bits, the number plus 1; 0: none");
        files.emplace_back("view-N-camera.json", "K and world_to_camera, in OpenCV's axes");
    }
    files.emplace_back("sample.json", "the values above, and the arguments of `espalier` that grow the plant again");
    return files;
}

}  // namespace

std::string card_json(const DatasetPlan& plan, const std::vector<DatasetSample>& samples,
                      const Dataset::Summary& summary) {
    Json json{{"title", plan.title},
              {"licence", plan.licence},
              {"program", fmt::format("espalier {}", ESPALIER_VERSION)},
              {"grown", plan.growth.subject().file.filename().string()},
              {"seed", plan.seed},
              {"samples", summary.samples},
              {"failed", summary.failed},
              {"points", summary.points},
              {"pictures", summary.pictures}};
    for (const auto& [name, share] : plan.splits) {
        json["splits"][name] = {{"share", share}, {"samples", samples_in(samples, name)}};
    }
    for (const Unknown& parameter : plan.parameters) json["parameters"][parameter.name] = parameter.prior->text();
    for (const auto& [name, unit, meaning] : columns_of(plan)) {
        json["columns"].push_back({{"name", name}, {"unit", unit}, {"meaning", meaning}});
    }
    for (const auto& [name, meaning] : files_of(plan)) json["files"][name] = meaning;
    if (plan.scan) {
        const ScanOptions& scan = plan.scan->options;
        json["scan"] = {{"beams", plan.scan->beams.size()},      {"range", scan.range},
                        {"divergence", scan.divergence},         {"rays", scan.rays},
                        {"distance_noise", scan.distance_noise}, {"angle_noise", scan.angle_noise},
                        {"columns", plan.scan->points.columns},  {"up", std::string(1, plan.scan->points.up)}};
    }
    json["again"] = command_of(plan);
    return json_text(json) + "\n";
}

std::string card_page(const DatasetPlan& plan, const std::vector<DatasetSample>& samples,
                      const Dataset::Summary& summary) {
    std::string page = fmt::format("# {}\n\n", plan.title);
    page += fmt::format(
        "{} samples of `{}`, grown by Espalier {}{}.\n", summary.samples,
        plan.growth.subject().file.filename().string(), ESPALIER_VERSION,
        summary.failed > 0 ? fmt::format("; {} of them failed, as `dataset.csv` says", summary.failed) : "");
    if (!plan.licence.empty()) page += fmt::format("\nLicence: {}\n", plan.licence);
    page += "\n## Splits\n\nThe samples of each are drawn at random.\n\n| split | samples |\n|---|---|\n";
    for (const auto& split : plan.splits) {
        page += fmt::format("| `{}` | {} |\n", split.first, samples_in(samples, split.first));
    }
    page += "\n## dataset.csv\n\nA row for each plant of each sample.\n\n| column | unit | |\n|---|---|---|\n";
    for (const auto& [name, unit, meaning] : columns_of(plan)) {
        page += fmt::format("| `{}` | {} | {} |\n", name, unit, meaning);
    }
    page += "\n## samples/NNNNNN\n\n| file | holds |\n|---|---|\n";
    for (const auto& [name, meaning] : files_of(plan)) page += fmt::format("| `{}` | {} |\n", name, meaning);
    page += "\nPlaces are metres, y upwards.";
    if (plan.scan) page += fmt::format(" A scan has {} beams.", plan.scan->beams.size());
    page += fmt::format(
        "\n\n## Again\n\n`dataset.toml` is the file that this was made from. With what it names beside it, this makes "
        "the "
        "same again:\n\n```sh\n{}\n```\n\nTables, points and masks are the same bytes everywhere, pictures where the "
        "same library draws them.\n",
        command_of(plan));
    return page;
}

}  // namespace espalier::study
