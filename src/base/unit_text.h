// Units as files write them.
#pragma once

#include <string>
#include <string_view>

namespace espalier {

/// With the letters that stand on every keyboard: "umol m-2 s-1" of "\u00b5mol m\u207b\u00b2 s\u207b\u00b9", in UTF-8
/// or Latin-1.
std::string plain_unit(std::string_view unit);

/// "global" and "W m-2" of "global (W m-2)" or "global [W m-2]"; no unit where there are no brackets.
struct NameAndUnit {
    std::string name, unit;
};
NameAndUnit name_and_unit(std::string_view cell);

}  // namespace espalier
