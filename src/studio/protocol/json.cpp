#include "studio/protocol/json.h"

#include "base/json_text.h"
#include "studio/protocol/description.h"

#include <fmt/ranges.h>

namespace espalier::studio {
namespace {

constexpr int deepest = 16;

/// The words that stand between blanks.
std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        words.emplace_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

}  // namespace

Json read_request(const std::string& text) {
    // Whoever walks through what is nested without limit runs out of stack.
    const auto require_shallow = [](int depth, Json::parse_event_t, Json&) {
        if (depth > deepest) throw UserError(fmt::format("the request is nested more than {} deep", deepest));
        return true;
    };
    Json request;
    try {
        request = Json::parse(with_whole_surrogates(text), require_shallow);
    } catch (const Json::exception& error) {
        throw UserError(fmt::format("the request is no JSON: {}", error.what()));
    }
    if (!request.is_object()) throw UserError("the request is no object");
    if (!request.contains("id") || !request["id"].is_number_integer()) throw UserError("'id' is no whole number");
    return request;
}

std::string union_of_words(std::string_view words) {
    return fmt::format("\"{}\"", fmt::join(words_of(words), "\" | \""));
}

bool is_among(std::string_view word, std::string_view words) {
    const std::vector<std::string> all = words_of(words);
    return std::find(all.begin(), all.end(), word) != all.end();
}

void require_within(std::string_view key, double number, Allowed allowed) {
    if (number < allowed.lowest)
        throw UserError(fmt::format("'{}' is {}, but must be at least {}", key, number, allowed.lowest));
    if (number > allowed.highest)
        throw UserError(fmt::format("'{}' is {}, but must be at most {}", key, number, allowed.highest));
}

void require_word(std::string_view key, std::string_view word, Allowed allowed) {
    if (allowed.words.empty() || is_among(word, allowed.words)) return;
    throw UserError(
        fmt::format("'{}' is '{}', but must be one of: {}", key, word, fmt::join(words_of(allowed.words), ", ")));
}

}  // namespace espalier::studio
