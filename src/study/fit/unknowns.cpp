#include "study/fit/unknowns.h"

#include "espalier/base/error.h"
#include "espalier/language/model_settings.h"

#include "base/csv_file.h"
#include "base/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::study {
namespace {

constexpr const char* forms = "NAME, NAME=START, NAME=LOW:HIGH, NAME=log:LOW:HIGH or NAME=normal:MEAN:DEVIATION";

/// What the model says of a #define: its value and the range in its comment.
void take_setting(Unknown& unknown, const Subject& subject, const std::string& start) {
    Defines defines;
    for (const auto& [key, value] : subject.values) defines[key] = value;
    const ModelSettings settings = ModelSettings::read(subject.file, defines);
    unknown.start = settings.value(unknown.name);
    if (!start.empty()) unknown.start = settings.value(start);
    for (const ModelSetting& setting : settings.list()) {
        if (setting.name != unknown.name) continue;
        unknown.lowest = setting.lowest;
        unknown.highest = setting.highest;
        if (std::isfinite(setting.highest - setting.lowest)) {
            unknown.prior = Prior::uniform(setting.lowest, setting.highest, setting.whole);
        }
    }
}

void require_range(double low, double high) {
    if (!(low < high)) throw UserError(fmt::format("{:.6g} is not below {:.6g}", low, high));
}

void take_prior(Unknown& unknown, const std::string& text) {
    const std::vector<std::string> words = csv_cells(text, ':');
    const bool has_kind = words.size() == 3;
    const auto low = finite_number(words[has_kind ? 1 : 0]), high = finite_number(words.back());
    if (!low || !high) throw UserError(fmt::format("expected {}", forms));
    if (!has_kind || words[0] == "log") {
        require_range(*low, *high);
        const bool whole = unknown.prior && unknown.prior->is_whole();
        if (has_kind && *low <= 0) throw UserError("numbers of a logarithmic range are above 0");
        unknown.prior = has_kind ? Prior::log_uniform(*low, *high) : Prior::uniform(*low, *high, whole);
        unknown.lowest = *low;
        unknown.highest = *high;
        unknown.start = has_kind ? std::sqrt(*low * *high) : (*low + *high) / 2;
        return;
    }
    if (words[0] != "normal" || *high <= 0) throw UserError(fmt::format("expected {}", forms));
    unknown.prior = Prior::normal(*low, *high, unknown.lowest, unknown.highest);
    unknown.lowest = std::max(unknown.lowest, unknown.prior->lowest());
    unknown.highest = std::min(unknown.highest, unknown.prior->highest());
    unknown.start = *low;
}

}  // namespace

Unknown unknown_of(const std::string& text, const Subject& subject) {
    const std::size_t equals = text.find('=');
    Unknown unknown{text.substr(0, equals)};
    const std::string value = equals == text.npos ? "" : text.substr(equals + 1);
    const std::size_t colons = static_cast<std::size_t>(std::count(value.begin(), value.end(), ':'));
    const bool is_define = !subject.is_scene() && unknown.name.find('.') == unknown.name.npos;
    try {
        if (unknown.name.empty() || colons > 2) throw UserError(fmt::format("expected {}", forms));
        if (is_define) take_setting(unknown, subject, colons == 0 ? value : "");
        if (!is_define && colons == 0) throw UserError("a key of a scene needs a range: KEY=LOW:HIGH");
        if (colons > 0) take_prior(unknown, value);
    } catch (const UserError& error) {
        throw UserError(fmt::format("--parameter {}: {}", text, error.what()));
    }
    return unknown;
}

std::vector<Unknown> usual_unknowns(const Subject& subject) {
    std::vector<Unknown> unknowns;
    if (subject.is_scene()) {
        const Settings parameters = Settings::read_toml(subject.file).table("fit").table("parameters");
        for (const std::string& key : parameters.keys()) {
            unknowns.push_back(unknown_of(key + "=" + parameters.text(key), subject));
        }
        if (!unknowns.empty()) return unknowns;
        throw UserError(fmt::format("{} has no [fit.parameters]: name what is sought with --parameter KEY=LOW:HIGH",
                                    subject.file.string()));
    }
    const ModelSettings settings = ModelSettings::read(subject.file);
    for (const ModelSetting& setting : settings.list()) {
        const bool is_given = std::any_of(subject.values.begin(), subject.values.end(),
                                          [&](const auto& value) { return value.first == setting.name; });
        if (!setting.whole && !is_given) unknowns.push_back(unknown_of(setting.name, subject));
    }
    if (!unknowns.empty()) return unknowns;
    throw UserError(fmt::format("{} has no settings: name its #defines with --parameter NAME", subject.file.string()));
}

std::vector<std::filesystem::path> usual_targets(const Subject& subject) {
    std::vector<std::filesystem::path> targets;
    if (!subject.is_scene()) return targets;
    const Settings fit = Settings::read_toml(subject.file).table("fit");
    for (const std::string& name : fit.texts_or("targets", {})) {
        targets.push_back(subject.file.parent_path() / name);
    }
    return targets;
}

}  // namespace espalier::study
