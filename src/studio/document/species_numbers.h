// The numbers of a file of tree parameters (.species), which writes several in a line: names, an equals sign, values.
#pragma once

#include "studio/document/written_numbers.h"

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::studio {

/// Those of the text that are settings of its model, in the order of the text. Parameters of levels stand under their
/// level. Throws UserError for a file with mistakes.
std::vector<WrittenNumber> numbers_of_species(const std::filesystem::path& file, const std::string& text);

}  // namespace espalier::studio
