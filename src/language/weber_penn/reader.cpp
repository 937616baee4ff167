#include "base/characters.h"
#include "base/number.h"
#include "base/text.h"
#include "language/weber_penn/species.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace espalier::language::weber_penn {
namespace {

/// A parameter of a level, or of the tree.
struct Named {
    const Parameter* parameter = nullptr;
    int level = -1;
};

/// Every name that a file may use.
const std::map<std::string, Named>& known_names() {
    static const std::map<std::string, Named> names = [] {
        std::map<std::string, Named> all;
        for (const Parameter& each : parameters()) {
            const int count = static_cast<int>(each.standard.size());
            for (int k = 0; k < count; ++k) {
                const int level = each.has_levels() ? each.first_level + k : -1;
                all[written_name(each, level)] = {&each, level};
            }
        }
        return all;
    }();
    return names;
}

/// A part of a line between commas, with its column, which counts from 0.
struct LinePart {
    std::string text;
    std::size_t column;
};

std::vector<LinePart> parts_between_commas(const std::string& line, std::size_t begin, std::size_t end) {
    std::vector<LinePart> parts;
    for (std::size_t from = begin; from <= end;) {
        const std::size_t comma = std::min(line.find(',', from), end);
        std::size_t first = from, last = comma;
        while (first < last && is_blank(line[first])) ++first;
        while (last > first && is_blank(line[last - 1])) --last;
        parts.push_back({line.substr(first, last - first), first});
        from = comma + 1;
    }
    return parts;
}

class SpeciesReader {
public:
    SpeciesReader(const std::string& text, const std::string& file) : file_(file), source_(text) {}

    Species read() {
        std::istringstream original(source_), bare(without_comments(source_));
        for (std::string line; std::getline(bare, line);) {
            std::getline(original, shown_);
            ++number_;
            if (std::any_of(line.begin(), line.end(), [](char c) { return !is_blank(c); })) read_line(line);
        }
        if (mistakes_.empty()) check_together();
        if (!mistakes_.empty()) throw UserError(std::move(mistakes_));
        return species_;
    }

private:
    /// The text with blanks instead of comments.
    static std::string without_comments(std::string text) {
        for (std::size_t k = 0; k < text.size(); ++k) {
            const bool is_block = text.compare(k, 2, "/*") == 0;
            if (!is_block && text.compare(k, 2, "//") != 0) continue;
            const std::size_t close = is_block ? text.find("*/", k + 2) : text.find('\n', k);
            const std::size_t end = close == std::string::npos ? text.size() : close + (is_block ? 2 : 0);
            for (; k < end; ++k) {
                if (text[k] != '\n') text[k] = ' ';
            }
        }
        return text;
    }

    void mistake(std::size_t column, const std::string& message) {
        constexpr std::size_t most = 20;
        if (mistakes_.size() == most) return;
        const Place place{file_, number_, static_cast<int>(column) + 1};
        mistakes_.push_back({Diagnostic::Severity::error, place, message, shown_});
    }

    void read_line(const std::string& line) {
        const std::size_t equals = line.find('=');
        if (equals == std::string::npos) {
            return mistake(line.size(), "expected '=' between the names of parameters and their values");
        }
        const std::vector<LinePart> names = parts_between_commas(line, 0, equals);
        const std::vector<LinePart> values = parts_between_commas(line, equals + 1, line.size());
        if (names.size() != values.size()) {
            return mistake(values.front().column, fmt::format("as many values as names, which are {}, and not {}",
                                                              names.size(), values.size()));
        }
        for (std::size_t k = 0; k < names.size(); ++k) read_parameter(names[k], values[k]);
    }

    void read_parameter(const LinePart& name, const LinePart& value) {
        const auto found = known_names().find(name.text);
        if (found == known_names().end()) {
            std::vector<std::string> names;
            for (const auto& [known, parameter] : known_names()) names.push_back(known);
            return mistake(name.column, fmt::format("there is no parameter '{}'{}; 'espalier list notations species' "
                                                    "has them all",
                                                    name.text, did_you_mean(name.text, names)));
        }
        if (!seen_.insert(name.text).second) return mistake(name.column, fmt::format("'{}' is set twice", name.text));
        const std::optional<double> number = finite_number(value.text);
        if (!number) return mistake(value.column, fmt::format("'{}' is a number, not '{}'", name.text, value.text));
        check_range(*found->second.parameter, name.text, *number, value.column);
        species_.set(name.text, *number, {0, number_, static_cast<int>(name.column) + 1});
    }

    void check_range(const Parameter& parameter, const std::string& name, double number, std::size_t column) {
        const std::string unit = parameter.unit.empty() ? "" : " " + parameter.unit;
        if (parameter.is_whole && number != std::floor(number)) {
            mistake(column, fmt::format("'{}' is a whole number, not {}", name, format_general(number)));
        } else if (number < parameter.lowest || number > parameter.highest) {
            const std::string range =
                std::isfinite(parameter.highest)
                    ? fmt::format("from {} to {}", format_general(parameter.lowest), format_general(parameter.highest))
                    : fmt::format("at least {}", format_general(parameter.lowest));
            mistake(column, fmt::format("'{}' must be {}{}, not {}", name, range, unit, format_general(number)));
        }
    }

    void check_together() {
        if (!species_.prunes()) return;
        for (int level = 0; level < std::min(species_.levels(), highest_described_level + 1); ++level) {
            if (species_.value("CurveV", level) >= 0) continue;
            number_ = 0;
            shown_.clear();
            mistake(0,
                    fmt::format("{}CurveV must not be negative while PruneRatio is more than 0: helices are not pruned",
                                level));
        }
    }

    std::string file_, source_, shown_;
    int number_ = 0;
    Species species_;
    std::set<std::string> seen_;
    std::vector<Diagnostic> mistakes_;
};

}  // namespace

Species parse(const std::string& text, const std::string& name) {
    return SpeciesReader(text, name).read();
}

}  // namespace espalier::language::weber_penn
