// Text files after the C preprocessor: comments, #define, #include, #if, as models and their side files use them.
#pragma once

#include "espalier/base/error.h"
#include "espalier/language/reader.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

/// Text that knows where each of its characters was written. Lines keep their ends and their order; a comment is one
/// blank; what a macro stands for is set in without blanks around it. Copies share the text.
class PreprocessedText {
public:
    const std::string& text() const;
    /// File, line and column as the author wrote them, through #include and #define; offsets up to text().size().
    Place place(std::size_t offset) const;
    /// The line of text `place(offset)` stands in, for messages.
    std::string source_line(std::size_t offset) const;

private:
    struct Origin;
    explicit PreprocessedText(std::shared_ptr<const Origin> origin) : origin_(std::move(origin)) {}
    std::shared_ptr<const Origin> origin_;
    friend PreprocessedText preprocess_text(std::string_view, const std::string&, const std::filesystem::path&,
                                            const ReadOptions&);
};

/// Preprocesses a file with `options.defines` (those it never mentions are passed over) and `options.predefined`;
/// warnings are appended to `options.warnings`. Throws UserError with every mistake found.
PreprocessedText preprocess_file(const std::filesystem::path& path, const ReadOptions& options = {});
/// The same of text; `name` stands in messages, `folder` is where #include looks.
PreprocessedText preprocess_text(std::string_view text, const std::string& name,
                                 const std::filesystem::path& folder = {}, const ReadOptions& options = {});

}  // namespace espalier
