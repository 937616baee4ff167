// Text files after the C preprocessor: comments, #define, #include, #if, as models and their side files use them.
#pragma once

#include "espalier/language/reader.h"

#include "base/source_text.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace espalier::language {

/// Preprocesses a file with `options.defines` (those it never mentions are ignored) and `options.predefined`;
/// warnings are appended to `options.warnings`. Lines keep their ends and their order; a comment is one blank; what a
/// macro stands for is set in without blanks around it. Throws UserError with every mistake found.
std::shared_ptr<const SourceText> preprocess_file(const std::filesystem::path& path, const ReadOptions& options = {});
/// The same of text; `name` stands in messages, `folder` is where #include looks.
std::shared_ptr<const SourceText> preprocess_text(std::string_view text, const std::string& name,
                                                  const std::filesystem::path& folder = {},
                                                  const ReadOptions& options = {});

}  // namespace espalier::language
