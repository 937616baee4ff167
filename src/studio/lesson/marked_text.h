// Markdown (CommonMark, by cmark) as HTML for a page.
#pragma once

#include "espalier/base/error.h"

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::studio {

struct MarkedText {
    std::string html;
    std::vector<Diagnostic> warnings;  ///< what is left out
};

/// Elements of HTML and scripts are left out; pictures below `folder` become part of the text. `name` and `first_line`
/// stand in messages. Throws UserError for a picture that is none.
MarkedText html_of_markdown(const std::string& text, const std::filesystem::path& folder, const std::string& name,
                            int first_line);

}  // namespace espalier::studio
