#include "base/source_text.h"

#include <algorithm>
#include <utility>

namespace espalier {
namespace {

class PlainText : public SourceText {
public:
    PlainText(std::string text, std::string name) : text_(std::move(text)), name_(std::move(name)) {}

    const std::string& text() const override { return text_; }

    Place place(std::size_t offset) const override {
        const auto begin = text_.begin(), here = begin + std::ptrdiff_t(offset);
        return {name_, int(std::count(begin, here, '\n')) + 1, int(offset - line_start(offset)) + 1};
    }

    std::string source_line(std::size_t offset) const override {
        const std::size_t start = line_start(offset);
        std::string line = text_.substr(start, text_.find('\n', offset) - start);
        if (line.ends_with('\r')) line.pop_back();
        return line;
    }

private:
    std::size_t line_start(std::size_t offset) const {
        return offset == 0 ? 0 : text_.rfind('\n', offset - 1) + 1;  // npos + 1 is 0
    }

    std::string text_, name_;
};

}  // namespace

std::shared_ptr<const SourceText> plain_text(std::string text, std::string name) {
    return std::make_shared<const PlainText>(std::move(text), std::move(name));
}

}  // namespace espalier
