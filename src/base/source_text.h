// Text that knows where each of its characters was written.
#pragma once

#include "espalier/base/error.h"

#include <cstddef>
#include <memory>
#include <string>

namespace espalier {

/// A file's text as it is read. Preprocessed text differs from what the author wrote, so places are asked for.
class SourceText {
public:
    virtual ~SourceText() = default;

    virtual const std::string& text() const = 0;
    /// File, line and column as the author wrote them; offsets up to text().size().
    virtual Place place(std::size_t offset) const = 0;
    /// The line of text `place(offset)` is in, for messages.
    virtual std::string source_line(std::size_t offset) const = 0;
};

/// The text of one file, as it is.
std::shared_ptr<const SourceText> plain_text(std::string text, std::string name);

}  // namespace espalier
