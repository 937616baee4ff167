// JSON as text, and texts of others as JSON.
#pragma once

#include <string>
#include <string_view>

namespace espalier {

/// `indent`: blanks for each level; -1: all in one line. Bytes that are no UTF-8, which names of files may hold, become
/// U+FFFD: the library would throw at them.
template <class Json>
std::string json_text(const Json& json, int indent = 2) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// The most objects and lists that lie within each other.
constexpr int deepest_json = 64;
bool is_deeper_than_json_may_be(std::string_view text);

/// What a file of others holds; discarded (`is_discarded()`) if it is no JSON, or nested so deep that whoever copies or
/// writes it could run out of stack.
template <class Json>
Json read_json(std::string_view text) {
    if (is_deeper_than_json_may_be(text)) return Json(Json::value_t::discarded);
    return Json::parse(text, nullptr, /*allow_exceptions=*/false);
}

/// The text with U+FFFD for each escaped surrogate that has lost its other half, as a browser writes half of a
/// character; the library would take the whole text for no JSON.
std::string with_whole_surrogates(std::string_view json);

}  // namespace espalier
