// Models of related programs, which are told apart so that their reader learns more than that a line is wrong.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace espalier::language {

/// What a text is that looks like a model of L-Py or one in L+C, as a sentence; nothing for all others.
std::optional<std::string> other_language(std::string_view text, const std::filesystem::path& path);

}  // namespace espalier::language
