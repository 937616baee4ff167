#include "study/fit/simulations.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/random.h"
#include "espalier/base/read_log.h"
#include "espalier/base/stop.h"

#include "base/csv_file.h"
#include "base/csv_rows.h"
#include "base/folder.h"
#include "base/text.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace espalier::study {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t per_file = 100;
constexpr double nearly_one = 1 - 1e-12;

/// The random numbers of one simulation.
RandomSamples samples_of(std::uint64_t seed, std::size_t generation, std::size_t number) {
    const std::uint64_t salt = digest("espalier fit");
    return {RandomKey(seed, 0, Stream::process, salt), number, static_cast<std::uint32_t>(generation)};
}

std::vector<double> drawn_scores(RandomSamples samples, std::size_t unknowns, const Proposal* proposal) {
    std::vector<double> scores;
    if (!proposal) {
        for (std::size_t k = 0; k < unknowns; ++k) {
            scores.push_back(normal_quantile(std::clamp(samples.uniform(), 1 - nearly_one, nearly_one)));
        }
        return scores;
    }
    const double share = samples.uniform();
    for (std::size_t k = 0; k < unknowns; ++k) scores.push_back(samples.normal());
    return proposal->draw(share, scores);
}

std::string header(const FitTask& task) {
    std::string line = "number";
    for (const Unknown& unknown : task.unknowns) line.append(",").append(csv_text("score." + unknown.name));
    for (const Unknown& unknown : task.unknowns) line.append(",").append(csv_text(unknown.name));
    for (const Statistic& statistic : task.statistics()) line.append(",").append(csv_text(statistic.name));
    return line + "\n";
}

}  // namespace

std::vector<Statistic> FitTask::statistics() const {
    std::vector<Statistic> all;
    for (const auto& target : targets) {
        all.insert(all.end(), target->statistics().begin(), target->statistics().end());
    }
    return all;
}

Needs FitTask::needs() const {
    Needs all;
    for (const auto& target : targets) all = all | target->needs();
    return all;
}

std::size_t FitTask::worlds() const {
    std::size_t most = 1;
    for (const auto& target : targets) most = std::max(most, target->worlds());
    return most;
}

std::vector<std::pair<std::string, double>> FitTask::named(std::span<const double> values) const {
    std::vector<std::pair<std::string, double>> named;
    for (std::size_t k = 0; k < unknowns.size(); ++k) named.emplace_back(unknowns[k].name, values[k]);
    return named;
}

std::vector<double> FitTask::simulated(std::span<const double> values, std::uint64_t first, std::size_t worlds) const {
    const Scene scene = growth.scene(named(values));
    std::vector<Grown> grown(worlds);
    std::atomic<bool> all_there{true};
    const StopRequest* const stop = StopRequest::current();
    ReadLog* const reads = ReadLog::current();
    tbb::parallel_for(std::size_t{0}, worlds, [&](std::size_t i) {
        const StopRequest::Scope scope(stop);
        const ReadLog::Scope log(reads);
        try {
            auto world = growth.grow(scene, first + i, needs());
            world ? void(grown[i] = std::move(*world)) : void(all_there = false);
        } catch (const RunError&) {
            all_there = false;
        }
    });
    if (!all_there) return std::vector<double>(statistics().size(), std::numeric_limits<double>::quiet_NaN());
    std::vector<double> all;
    for (const auto& target : targets) {
        const std::vector<double> some = target->of(grown);
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

std::uint64_t FitTask::digest() const {
    const Subject& subject = growth.subject();
    std::vector<double> start;
    for (const Unknown& unknown : unknowns) start.push_back(unknown.start);
    const ReadLog inputs;  // also what models include, and what a scene names
    static_cast<void>(growth.scene(named(start)));
    std::string text;
    for (const auto& [path, file] : inputs.files()) text += fmt::format("{} {:016x}\n", path.string(), file.digest);
    for (const auto& [key, value] : subject.values) text += fmt::format("{}={}\n", key, value);
    text +=
        fmt::format("steps {} seed {} plant {}\n", subject.steps.value_or(-1), subject.seed.value_or(0), subject.plant);
    for (const Unknown& unknown : unknowns) text += fmt::format("{}: {}\n", unknown.name, unknown.prior->text());
    text += fmt::format("worlds {}\n", worlds());
    for (const Statistic& statistic : statistics()) text += statistic.name + "\n";
    return espalier::digest(text);
}

Simulations::Simulations(const FitTask& task, fs::path folder, std::size_t per_generation)
    : task_(task), folder_(std::move(folder)), per_generation_(per_generation) {
    make_folder(folder_);
    const fs::path mark = folder_ / "of";
    const std::string own = fmt::format("{:016x} {}\n", task_.digest(), per_generation_);
    if (!is_readable(mark)) write_text(mark, own);
    if (read_text(mark) == own) return;
    throw UserError(fmt::format("{} holds the simulations of another fit: give another --output, or remove the folder",
                                folder_.string()));
}

// Later generations depend on what was measured, and on how much was accepted.
fs::path Simulations::file(std::size_t generation, const Proposal* proposal, std::size_t chunk) const {
    const std::string of = proposal ? fmt::format("{:016x}-", proposal->digest()) : "";
    return folder_ / fmt::format("{}-{}{:05}.csv", generation, of, chunk);
}

std::size_t Simulations::chunks() const {
    return (per_generation_ + per_file - 1) / per_file;
}

std::string Simulations::rows(std::size_t generation, const Proposal* proposal, std::size_t chunk) const {
    const std::size_t begin = chunk * per_file, end = std::min(begin + per_file, per_generation_);
    const std::size_t worlds = task_.worlds();
    const std::uint64_t seed = task_.growth.subject().seed.value_or(0);
    std::vector<std::string> lines(end - begin);
    const StopRequest* const stop = StopRequest::current();
    tbb::parallel_for(begin, end, [&](std::size_t number) {
        const StopRequest::Scope scope(stop);
        if (stop && stop->is_asked()) throw Stopped();
        const std::vector<double> scores =
            drawn_scores(samples_of(seed, generation, number), task_.unknowns.size(), proposal);
        const std::vector<double> values = values_of_scores(task_.unknowns, scores);
        const std::uint64_t first = 1 + (generation * per_generation_ + number) * worlds;
        std::string& line = lines[number - begin] = std::to_string(number);
        for (const double score : scores) line.append(",").append(csv_number(score));
        for (const double value : values) line.append(",").append(csv_number(value));
        for (const double value : task_.simulated(values, first, worlds)) line.append(",").append(csv_number(value));
    });
    std::string text = header(task_);
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

bool Simulations::make(std::size_t generation, const Proposal* proposal, const Part& part,
                       const Progress& progress) const {
    for (std::size_t chunk = part.number; chunk < chunks(); chunk += part.of) {
        try {
            if (!is_readable(file(generation, proposal, chunk))) {
                write_text(file(generation, proposal, chunk), rows(generation, proposal, chunk));
            }
        } catch (const Stopped&) {
            return false;
        }
        progress(std::min((chunk + 1) * per_file, per_generation_), per_generation_);
    }
    return true;
}

std::size_t Simulations::made(std::size_t generation, const Proposal* proposal) const {
    std::size_t made = 0;
    for (std::size_t chunk = 0; chunk < chunks(); ++chunk) {
        if (!is_readable(file(generation, proposal, chunk))) continue;
        made += std::min(per_file, per_generation_ - chunk * per_file);
    }
    return made;
}

SimulationTable Simulations::read(std::size_t generation, const Proposal* proposal) const {
    SimulationTable table{task_.unknowns.size(), task_.statistics().size(), {}, {}, {}};
    for (std::size_t chunk = 0; chunk < chunks(); ++chunk) {
        const CsvRows rows(file(generation, proposal, chunk));
        for (std::size_t i = 1; i < rows.rows().size(); ++i) {
            const CsvRow& row = rows.rows()[i];
            for (std::size_t k = 0; k < table.unknowns; ++k) {
                const auto score = row.number(1 + k);
                if (!score) throw UserError(rows.place(row, 1 + k), "expected a number; remove the file");
                table.scores.push_back(*score);
            }
            for (std::size_t k = 0; k < table.statistics; ++k) {
                table.values.push_back(
                    row.number(1 + 2 * table.unknowns + k).value_or(std::numeric_limits<double>::quiet_NaN()));
            }
            const std::span<const double> scores{&table.scores[table.scores.size() - table.unknowns], table.unknowns};
            table.weights.push_back(proposal ? proposal->weight(scores) : 1);
        }
    }
    return table;
}

}  // namespace espalier::study
