#include "study/dataset/dataset.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/stop.h"

#include "base/csv_file.h"
#include "base/folder.h"
#include "base/json_text.h"
#include "study/dataset/dataset_card.h"
#include "study/dataset/measured_sample.h"
#include "study/fit/form.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace espalier::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* whole = "sample.json";  // the last file of a sample

Json number_or_null(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json description(const DatasetPlan& plan, const DatasetSample& sample, const GrownSample& grown) {
    Json json{{"sample", sample.number}, {"split", sample.split}, {"seed", sample.seed}};
    for (std::size_t k = 0; k < plan.parameters.size(); ++k) {
        json["parameters"][plan.parameters[k].name] = sample.values[k];
    }
    json["arguments"] = {"run", plan.growth.subject().file.filename().string()};
    for (const std::string& word : plan.growth.options(plan.named(sample.values))) json["arguments"].push_back(word);
    json["arguments"].insert(json["arguments"].end(), {"--seed", std::to_string(sample.seed)});
    if (!grown.failure.empty()) json["failed"] = grown.failure;
    for (std::size_t i = 0; i < grown.forms.size(); ++i) {
        Json plant{{"name", grown.run->plants()[i].name}};
        for (std::size_t k = 0; k < form_names().size(); ++k)
            plant[form_names()[k]] = number_or_null(grown.forms[i][k]);
        json["plants"].push_back(plant);
    }
    return json;
}

}  // namespace

Dataset::Dataset(DatasetPlan plan, fs::path folder)
    : plan_(std::move(plan)), folder_(std::move(folder)), samples_(samples_of(plan_)) {
    make_folder(folder_ / "samples");
    const fs::path mark = folder_ / "of";
    const std::string own = fmt::format("{:016x}\n", plan_.digest());
    if (!is_readable(mark)) {
        write_text(folder_ / "dataset.toml", plan_.text);
        write_text(mark, own);
    }
    if (read_text(mark) == own) return;
    throw UserError(fmt::format(
        "{} holds another data set: the file, what it names, or the program has changed since; give another --output, "
        "or remove the folder",
        folder_.string()));
}

fs::path Dataset::folder_of(const DatasetSample& sample) const {
    return folder_ / "samples" / fmt::format("{:06}", sample.number);
}

std::vector<const DatasetSample*> Dataset::to_do(const DatasetPart& part) const {
    std::vector<const DatasetSample*> left;
    for (std::size_t i = part.number; i < samples_.size(); i += part.of) {
        if (!is_readable(folder_of(samples_[i]) / whole)) left.push_back(&samples_[i]);
    }
    return left;
}

void Dataset::make(const DatasetPart& part, const Progress& progress) const {
    const std::vector<const DatasetSample*> left = to_do(part);
    const std::size_t together = 2 * static_cast<std::size_t>(std::max(1, tbb::this_task_arena::max_concurrency()));
    const StopRequest* const stop = StopRequest::current();
    for (std::size_t begin = 0; begin < left.size(); begin += together) {
        std::vector<GrownSample> grown(std::min(together, left.size() - begin));
        tbb::parallel_for(std::size_t{0}, grown.size(), [&](std::size_t i) {
            const StopRequest::Scope scope(stop);
            if (stop && stop->is_asked()) throw Stopped();
            grown[i] = grown_sample(plan_, *left[begin + i]);
        });
        for (std::size_t i = 0; i < grown.size(); ++i) {
            if (stop && stop->is_asked()) throw Stopped();
            const DatasetSample& sample = *left[begin + i];
            make_folder(folder_of(sample));
            MeasuredSample measured;
            try {
                if (grown[i].failure.empty()) measured = measure(plan_, sample, grown[i], folder_of(sample));
            } catch (const UserError& error) {
                grown[i].failure = error.what();  // nothing to draw
            }
            Json json = description(plan_, sample, grown[i]);
            json["points"] = measured.points;
            json["pictures"] = measured.pictures;
            write_text(folder_of(sample) / whole, json_text(json) + "\n");
            progress(begin + i + 1, left.size());
        }
    }
}

Dataset::Summary Dataset::write_card() const {
    Summary summary{samples_.size(), 0, 0, 0};
    std::string table = "sample,split,seed";
    for (const Unknown& parameter : plan_.parameters) table.append(",").append(csv_text(parameter.name));
    table += ",plant";
    for (const std::string& name : form_names()) table.append(",").append(name);
    table += ",points,pictures,failed\n";
    for (const DatasetSample& sample : samples_) {
        const Json json = read_json<Json>(read_text(folder_of(sample) / whole));
        if (json.is_discarded()) {
            throw UserError(fmt::format("{} is damaged: remove it", (folder_of(sample) / whole).string()));
        }
        std::string head = fmt::format("{},{},{}", sample.number, csv_text(sample.split), sample.seed);
        for (const double value : sample.values) head.append(",").append(csv_number(value));
        const std::string failure = json.value("failed", "");
        summary.failed += failure.empty() ? 0 : 1;
        summary.points += json.value("points", std::size_t{0});
        summary.pictures += json.value("pictures", std::size_t{0});
        const auto add = [&](const Json& plant) {
            table += head + "," + csv_text(plant.value("name", ""));
            for (const std::string& name : form_names()) {
                table += ",";
                if (plant.contains(name) && plant[name].is_number()) table += csv_number(plant[name].get<double>());
            }
            table += fmt::format(",{},{},{}\n", json.value("points", std::size_t{0}),
                                 json.value("pictures", std::size_t{0}), csv_text(failure));
        };
        if (!json.contains("plants")) add(Json::object());
        if (json.contains("plants")) std::for_each(json["plants"].begin(), json["plants"].end(), add);
    }
    write_text(folder_ / "dataset.csv", table);
    write_text(folder_ / "card.json", card_json(plan_, samples_, summary));
    write_text(folder_ / "README.md", card_page(plan_, samples_, summary));
    return summary;
}

}  // namespace espalier::study
