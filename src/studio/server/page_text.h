// Texts and bytes as they stand in a page.
#pragma once

#include <string>
#include <string_view>

namespace espalier::studio {

/// Between the tags of an element, or in the quotes of an attribute.
std::string in_html(std::string text);
/// In a script, where `less` stands for a character that would end it.
std::string in_script(std::string_view text, std::string_view less);

/// Compressed, without a header. Throws RunError if that is too large.
std::string deflated(const std::string& bytes);
std::string gzipped(const std::string& bytes);

}  // namespace espalier::studio
