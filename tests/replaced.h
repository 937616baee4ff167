// A text with one part of it changed.
#pragma once

#include <stdexcept>
#include <string>

/// With the first `part` of the text replaced. Throws std::runtime_error where there is none.
inline std::string replaced(std::string text, const std::string& part, const std::string& by) {
    const std::size_t at = text.find(part);
    if (at == std::string::npos) throw std::runtime_error("the text has no '" + part + "'");
    return text.replace(at, part.size(), by);
}
