// Text inside XML.
#pragma once

#include <string>
#include <string_view>

namespace espalier {

/// As the value of an attribute, or between tags.
std::string xml_text(std::string_view text);

}  // namespace espalier
