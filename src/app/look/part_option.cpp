#include "part_option.h"

#include "espalier/base/error.h"

#include "base/number.h"

#include <fmt/format.h>

namespace espalier::app {

PartOption::PartOption(CLI::App& command, const std::string& work, const std::string& group) {
    command
        .add_option("--list", list_,
                    fmt::format("print so many commands that {} a part each, and do nothing else", work))
        ->check(CLI::Range(1, 100000))
        ->group(group);
    command.add_option("--part", part_, fmt::format("NUMBER/OF: {} only this part", work))->group(group);
}

std::pair<std::size_t, std::size_t> PartOption::part() const {
    if (part_.empty()) return {0, 1};
    const std::size_t slash = part_.find('/');
    const auto number = whole_text_as<int>(part_.substr(0, slash));
    const auto of = whole_text_as<int>(slash == part_.npos ? "" : part_.substr(slash + 1));
    if (number && of && *number >= 1 && *number <= *of) {
        return {static_cast<std::size_t>(*number - 1), static_cast<std::size_t>(*of)};
    }
    throw UserError(fmt::format("--part {}: expected NUMBER/OF, such as 3/20", part_));
}

}  // namespace espalier::app
