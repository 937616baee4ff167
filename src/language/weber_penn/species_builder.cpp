#include "language/weber_penn/species_builder.h"

#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace espalier::language::weber_penn {
namespace {

constexpr const char* other_name_of_bend = "LeafOrient";

/// Every other name that a file may use.
const std::map<std::string, const Parameter*>& known_names() {
    static const std::map<std::string, const Parameter*> names = [] {
        std::map<std::string, const Parameter*> all;
        for (const Parameter& each : parameters()) {
            const int count = static_cast<int>(each.standard.size());
            for (int k = 0; k < count; ++k) {
                all[written_name(each, each.has_levels() ? each.first_level + k : -1)] = &each;
            }
        }
        return all;
    }();
    return names;
}

}  // namespace

SpeciesBuilder::SpeciesBuilder(const std::string& text, std::string file, std::string notation)
    : file_(std::move(file)), notation_(std::move(notation)) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) lines_.push_back(line);
}

bool SpeciesBuilder::is_known(const std::string& written) {
    return written == other_name_of_bend || known_names().contains(written);
}

Diagnostic SpeciesBuilder::told(Diagnostic::Severity severity, At at, const std::string& message) const {
    const auto line = static_cast<std::size_t>(at.line);
    return {severity, Place{file_, at.line, at.column}, message,
            line >= 1 && line <= lines_.size() ? lines_[line - 1] : std::string()};
}

void SpeciesBuilder::mistake(At at, const std::string& message) {
    constexpr std::size_t most = 20;
    if (mistakes_.size() < most) mistakes_.push_back(told(Diagnostic::Severity::error, at, message));
}

void SpeciesBuilder::warn(At at, const std::string& message) {
    species_.warnings.push_back(told(Diagnostic::Severity::warning, at, message));
}

void SpeciesBuilder::set(const std::string& written, double value, At name_at, At value_at) {
    const std::string name = written == other_name_of_bend ? "LeafBend" : written;
    const auto found = known_names().find(name);
    if (found == known_names().end()) {
        std::vector<std::string> names;
        for (const auto& [known, parameter] : known_names()) names.push_back(known);
        return mistake(name_at, fmt::format("there is no parameter '{}'{}; 'espalier list notations {}' has them all",
                                            written, did_you_mean(written, names), notation_));
    }
    if (!seen_.insert(name).second) return mistake(name_at, fmt::format("'{}' is set twice", name));
    check_range(*found->second, written, value, value_at);
    species_.set(name, value, {0, name_at.line, name_at.column});
}

void SpeciesBuilder::check_range(const Parameter& parameter, const std::string& name, double number, At at) {
    const std::string unit = parameter.unit.empty() ? "" : " " + parameter.unit;
    if (parameter.is_whole && number != std::floor(number)) {
        mistake(at, fmt::format("'{}' is a whole number, not {}", name, format_general(number)));
    } else if (number < parameter.lowest || number > parameter.highest) {
        const std::string range =
            std::isfinite(parameter.highest)
                ? fmt::format("from {} to {}", format_general(parameter.lowest), format_general(parameter.highest))
                : fmt::format("at least {}", format_general(parameter.lowest));
        mistake(at, fmt::format("'{}' must be {}{}, not {}", name, range, unit, format_general(number)));
    }
}

void SpeciesBuilder::check_together() {
    if (!species_.prunes()) return;
    for (int level = 0; level < std::min(species_.levels(), highest_described_level + 1); ++level) {
        if (species_.value("CurveV", level) >= 0) continue;
        mistake({}, fmt::format("{}CurveV must not be negative while PruneRatio is more than 0: helices are not pruned",
                                level));
    }
}

Species SpeciesBuilder::finished() {
    if (mistakes_.empty()) check_together();
    if (!mistakes_.empty()) throw UserError(std::move(mistakes_));
    return species_;
}

}  // namespace espalier::language::weber_penn
