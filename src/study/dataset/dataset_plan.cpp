#include "study/dataset/dataset_plan.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/random.h"
#include "espalier/base/read_log.h"
#include "espalier/base/settings.h"

#include "study/fit/unknowns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace espalier::study {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_samples = 10'000'000;

Subject subject_of(const Settings& table) {
    if (table.has("model") == table.has("scene")) {
        throw UserError(table.place(), "a data set grows one thing: model = \"FILE.l\", or scene = \"FILE.toml\"");
    }
    Subject subject{table.path(table.has("scene") ? "scene" : "model")};
    if (!is_readable(subject.file)) {
        throw UserError(table.place(table.has("scene") ? "scene" : "model"),
                        fmt::format("cannot read {}: the file does not exist", subject.file.string()));
    }
    const Settings values = table.table("set");
    for (const std::string& key : values.keys()) subject.values.emplace_back(key, values.value_text(key));
    if (table.has("steps")) subject.steps = static_cast<int>(table.integer("steps", Range::between(0, 1e9)));
    return subject;
}

std::vector<Unknown> parameters_of(const Settings& table, const Subject& subject) {
    std::vector<Unknown> parameters;
    const Settings ranges = table.table("parameters");
    for (const std::string& key : ranges.keys()) {
        try {
            parameters.push_back(unknown_of(key + "=" + ranges.text(key), subject));
        } catch (const UserError& error) {
            throw UserError(ranges.place(key), error.what());
        }
        if (parameters.back().prior) continue;
        throw UserError(ranges.place(key), fmt::format("{}: expected a range, such as \"10:60\"", key));
    }
    return parameters;
}

std::vector<std::pair<std::string, double>> splits_of(const Settings& table) {
    if (!table.has("split")) return {{"train", 0.8}, {"validation", 0.1}, {"test", 0.1}};
    const Settings shares = table.table("split");
    std::vector<std::pair<std::string, double>> splits;
    double sum = 0;
    for (const std::string& name : shares.keys()) {
        splits.emplace_back(name, shares.number(name, Range::between(0, 1)));
        sum += splits.back().second;
    }
    if (std::abs(sum - 1) < 1e-9) return splits;
    throw UserError(table.place("split"), fmt::format("split: the shares add up to {:.6g}, not to 1", sum));
}

PicturePlan pictures_of(const Settings& table) {
    PicturePlan plan;
    const std::vector<double> size = table.numbers_or("size", {640, 480});
    if (size.size() != 2 || !(std::min(size[0], size[1]) >= 1) || !(std::max(size[0], size[1]) <= 8192)) {
        throw UserError(table.place("size"), "size: expected [width, height], 1 to 8192 pixels");
    }
    plan.size = {static_cast<int>(size[0]), static_cast<int>(size[1])};
    plan.azimuths = table.numbers_or("azimuths", plan.azimuths);
    if (plan.azimuths.empty()) throw UserError(table.place("azimuths"), "azimuths: expected one at least");
    plan.camera.elevation = table.number_or("elevation", plan.camera.elevation, Range::between(-90, 90));
    plan.camera.zoom = table.number_or("zoom", 1, Range::between(0.01, 1000));
    plan.camera.front_if_flat = false;
    const std::vector<double> sun = table.numbers_or("sun", {plan.style.sun_azimuth, plan.style.sun_elevation});
    if (sun.size() != 2 || std::abs(sun[1]) > 90) {
        throw UserError(table.place("sun"), "sun: expected [azimuth, elevation], degrees");
    }
    plan.style.sun_azimuth = sun[0], plan.style.sun_elevation = sun[1];
    plan.style.background.transparent = table.flag_or("transparent", false);
    plan.style.shading = table.flag_or("shade", true);
    plan.style.legend = false;
    plan.ground = table.flag_or("ground", false);
    plan.masks = table.flag_or("masks", true);
    if (!table.flag_or("light", false)) return plan;
    plan.style.light.emplace();
    plan.style.light->samples = static_cast<int>(table.integer_or("samples", 64, Range::between(1, 1e6)));
    plan.style.light->shows_sky = !plan.style.background.transparent;
    return plan;
}

/// A number with six digits, as a command line says it.
double six_digits(double value) {
    return std::stod(fmt::format("{:.6g}", value));
}

}  // namespace

std::vector<std::pair<std::string, double>> DatasetPlan::named(const std::vector<double>& values) const {
    std::vector<std::pair<std::string, double>> named;
    for (std::size_t k = 0; k < parameters.size(); ++k) named.emplace_back(parameters[k].name, values[k]);
    return named;
}

std::uint64_t DatasetPlan::digest() const {
    const ReadLog inputs;  // also what models include, and what a scene names
    static_cast<void>(growth.scene(named(samples_of(*this).front().values)));
    std::string all = fmt::format("{}\n{}\nsamples {} seed {}\n", ESPALIER_VERSION, text, samples, seed);
    for (const auto& [path, read] : inputs.files()) {
        all += fmt::format("{} {:016x}\n", path.filename().string(), read.digest);
    }
    return espalier::digest(all);
}

DatasetPlan read_dataset(const fs::path& file, const DatasetChoice& choice) {
    const Settings root = Settings::read_toml(file);
    const Settings table = root.table("dataset");
    const Subject grown = subject_of(table);
    DatasetPlan plan{file, read_text(file), {}, {}, Growth(grown), {}, {}, {}, {}, {}, {}};
    plan.title = table.text_or("title", file.stem().string());
    plan.licence = table.text_or("licence", "");
    plan.samples = static_cast<std::size_t>(table.integer_or("samples", 100, Range::between(1, most_samples)));
    plan.seed = static_cast<std::uint64_t>(table.integer_or("seed", 0, Range::between(0, 9e15)));
    plan.samples = choice.samples.value_or(plan.samples);
    plan.seed = choice.seed.value_or(plan.seed);
    Subject subject = grown;
    subject.seed = plan.seed;
    plan.growth = Growth(subject);
    plan.parameters = parameters_of(table, subject);
    plan.splits = splits_of(table);
    if (root.has("scan")) plan.scan = read_scan(root.table("scan"));
    if (root.has("pictures")) plan.pictures = pictures_of(root.table("pictures"));
    root.reject_unread();
    return plan;
}

std::vector<DatasetSample> samples_of(const DatasetPlan& plan) {
    const std::uint64_t salt = digest("espalier dataset");
    std::vector<DatasetSample> samples;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t number = 0; number < plan.samples; ++number) {
        RandomSamples random(RandomKey(plan.seed, 0, Stream::process, salt), number, 0);
        order.emplace_back(random.uniform(), number);
        DatasetSample& sample = samples.emplace_back();
        sample.number = number;
        sample.seed = plan.seed + number;
        for (const Unknown& parameter : plan.parameters) {
            const double share = std::clamp(random.uniform(), 1e-12, 1 - 1e-12);
            sample.values.push_back(six_digits(parameter.prior->quantile(share)));
        }
    }
    std::sort(order.begin(), order.end());
    double share = 0;
    std::size_t begin = 0;
    for (const auto& [name, of_split] : plan.splits) {
        share += of_split;
        const auto end = static_cast<std::size_t>(std::lround(share * static_cast<double>(plan.samples)));
        for (std::size_t i = begin; i < std::min(end, order.size()); ++i) samples[order[i].second].split = name;
        begin = std::max(begin, end);
    }
    return samples;
}

}  // namespace espalier::study
