// JSON as text. The library would throw at bytes that are no UTF-8, which names of files may hold.
#pragma once

#include <string>

namespace espalier {

/// `indent`: blanks for each level; -1: all in one line. Bytes that are no UTF-8 become U+FFFD.
template <class Json>
std::string json_text(const Json& json, int indent = 2) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace espalier
