#include "environment/given/external/records.h"

#include "espalier/base/error.h"

#include "base/excerpt.h"
#include "base/number.h"
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace espalier::environment {
namespace {

constexpr std::string_view control = "Control:";

// cpfg sends a large step in several parts; this one is the first part and the last.
enum Flags { first_part = 1, last_part = 4, end_of_exchange = 8 };

std::string module_text(std::string_view name, std::span<const double> parameters, const Communication& communication) {
    std::string text(name);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        text += i == 0 ? '(' : ',';
        text += communication.text_of(parameters[i]);
    }
    if (!parameters.empty()) text += ')';
    return text;
}

// Without the question mark.
std::string_view name_of(const Query& query, const WorldView& world) {
    if (query.process < 0) return "E";
    return world.plants[query.plant].model->processes[static_cast<std::size_t>(query.process)];
}

[[noreturn]] void fail_at(std::string_view line, const std::string& why) {
    constexpr std::size_t most_shown = 80;
    throw RunError(
        fmt::format("the program answers '{}': {}", printable(std::string(line.substr(0, most_shown))), why));
}

/// "3 E(0.5,,1)" in its parts; of what is missing, nothing.
struct Record {
    std::size_t address = 0;
    std::string_view module;
    std::vector<std::string_view> values;
};

Record record_of(std::string_view line) {
    Record record;
    const std::size_t blank = line.find_first_of(" \t");
    const std::size_t open = std::min(line.find('('), line.size());
    const bool has_values = open < line.size();
    const auto address = whole_text_as<std::size_t>(line.substr(0, std::min(blank, line.size())));
    if (blank == std::string_view::npos || blank > open || !address || (has_values && line.back() != ')')) {
        fail_at(line, "a line is ADDRESS MODULE(VALUE,...), or Control: FLAGS at the end");
    }
    record.address = *address;
    record.module = trimmed(line.substr(blank, open - blank));
    if (!has_values) return record;
    std::string_view rest = line.substr(open + 1, line.size() - open - 2);
    for (std::size_t comma = 0; comma != std::string_view::npos;) {
        comma = rest.find(',');
        record.values.push_back(trimmed(rest.substr(0, comma)));
        rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
    }
    return record;
}

}  // namespace

std::string text_of_queries(const WorldView& world, Queries queries, const Communication& communication) {
    std::string text;
    for (std::size_t address = 0; address < queries.size(); ++address) {
        const Query& query = queries[address];
        fmt::format_to(std::back_inserter(text), "{} {}", address,
                       module_text(name_of(query, world), query.parameters, communication));
        if (communication.sends_following_module() && query.following != no_letter) {
            const Alphabet& alphabet = world.plants[query.plant].model->alphabet;
            text += module_text(alphabet.name(query.following), query.following_parameters, communication);
        }
        text += '\n';
        text += communication.turtle_text(query);
    }
    return text + fmt::format("{} {} {}\n", control, first_part | last_part, world.step);
}

std::string text_of_end(int step) {
    return fmt::format("{} {} {}\n", control, static_cast<int>(end_of_exchange), step);
}

bool AnswerReader::take(std::string_view line) {
    const std::string_view text = trimmed(line);
    if (text.starts_with(control)) return true;
    if (!text.empty()) answer(text);
    return false;
}

void AnswerReader::answer(std::string_view line) {
    const Record record = record_of(line);
    if (record.address >= queries_.size()) {
        fail_at(line, fmt::format("the queries of this step have the addresses 0 to {}", queries_.size() - 1));
    }
    if (answered_[record.address]) fail_at(line, "this address is answered already");
    answered_[record.address] = true;
    const std::string_view asked = name_of(queries_[record.address], world_);
    if (record.module != asked) fail_at(line, fmt::format("the module at this address is {}", asked));
    const Answer answer = answers_[record.address];
    if (record.values.size() > answer.size()) {
        fail_at(line, fmt::format("the query has {} parameter{}", answer.size(), answer.size() == 1 ? "" : "s"));
    }
    for (std::size_t i = 0; i < record.values.size(); ++i) {
        if (record.values[i].empty()) continue;
        const std::optional<double> value = whole_text_as<double>(record.values[i]);
        if (!value) fail_at(line, fmt::format("'{}' is no number", printable(std::string(record.values[i]))));
        answer[i] = *value;
    }
}

}  // namespace espalier::environment
