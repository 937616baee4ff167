// The functions of the language by name.
#pragma once

#include "espalier/lsystem/expression.h"

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language {

struct FunctionEntry {
    std::string_view name;
    Function function;
    int least;  ///< number of arguments
    int most;
    bool takes_text = false;
    std::uint32_t index = 0;  ///< which edge of the view; of what is printed: 1 ends the run with it
};

inline constexpr int any_number = std::numeric_limits<int>::max();

/// Null if there is no such function.
const FunctionEntry* find_function(std::string_view name);
const std::vector<std::string>& function_names();

}  // namespace espalier::language
