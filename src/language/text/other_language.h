// Files of related programs, which are told apart so that their reader learns more than that a line is wrong.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace espalier::language {

/// What a text is that is no model of ours but looks like something else that a reader may have at hand, as a sentence
/// with what to do; nothing for all others.
std::optional<std::string> other_language(std::string_view text, const std::filesystem::path& path);

}  // namespace espalier::language
