// Dates as multiscale tree graphs write them.
#pragma once

#include <optional>
#include <string_view>

namespace espalier::language::mtg {

/// Whether FEATURES declares a column of dates by this word: DD/MM, DD/MM/YY, MM/YY or DD/MM-TIME.
bool is_type_of_dates(std::string_view type);

/// Days from 1 January 1970 for 31/12/2007, 31/12/07 and 12/2007; for 31/12 and 31/12-14:30, which name no year, from 1
/// January of one without leap day. A column of the type MM/YY holds months and years. None for what is no date.
std::optional<double> days_of(std::string_view text, std::string_view type);

}  // namespace espalier::language::mtg
