#include "language/preprocessor/comments.h"

#include "espalier/base/stop.h"

#include "base/byte_order_mark.h"
#include "base/characters.h"

#include <fmt/format.h>

namespace espalier::language {
namespace {

constexpr char end_of_file = 0x1A;

class CommentRemover {
public:
    CommentRemover(const Sources& sources, std::uint32_t file, Mistakes& mistakes)
        : text_(sources.text(file)), at_{file, 1, 1}, mistakes_(mistakes) {}

    MappedText run() {
        position_ = byte_order_mark(text_);
        StopCheck<4096> check_stop;
        while (next_line_joined() || position_ < text_.size()) {
            check_stop();
            step();
        }
        return std::move(out_);
    }

private:
    char peek(std::size_t ahead = 0) const {
        return position_ + ahead < text_.size() ? text_[position_ + ahead] : '\0';
    }

    void advance() {
        const char passed = text_[position_++];
        if (passed == '\n') {
            ++at_.line;
            at_.column = 1;
        } else if (!is_continuation_byte(peek())) {
            ++at_.column;
        }
    }

    // A backslash before the end of a line joins it with the next.
    bool next_line_joined() {
        const std::size_t length = peek() != '\\'                       ? 0
                                   : peek(1) == '\n'                    ? 2
                                   : peek(1) == '\r' && peek(2) == '\n' ? 3
                                                                        : 0;
        for (std::size_t i = 0; i < length; ++i) advance();
        return length > 0;
    }

    /// What was read of the statement at hand: lines that begin with a tab continue the line before.
    std::string_view statement() const {
        const std::string_view read = out_.text();
        std::size_t begin = read.rfind('\n');
        while (begin != std::string_view::npos && begin > 0 && begin + 1 < read.size() && read[begin + 1] == '\t') {
            begin = read.rfind('\n', begin - 1);
        }
        return begin == std::string_view::npos ? read : read.substr(begin + 1);
    }

    // Where a line of a macro ends with two backslashes, one belongs to nothing.
    bool at_stray_backslash() const {
        if (peek() != '\\' || peek(1) != '\\' || (peek(2) != '\n' && (peek(2) != '\r' || peek(3) != '\n')))
            return false;
        std::string_view line = statement();
        const auto skip_blanks = [&] {
            while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
        };
        skip_blanks();
        if (!line.starts_with('#')) return false;
        line.remove_prefix(1);
        skip_blanks();
        return line.starts_with("define");
    }

    // F//F has lost its end, and so have F ///// F and F/////F; other comments stand behind a blank, a weight or a
    // statement in C.
    void tell_lost_modules() {
        const std::string_view read = statement();
        if (read.empty() || read.back() == '\n' || read.starts_with('#')) return;
        if (is_blank(read.back()) && peek(2) != '/') return;
        const std::size_t arrow = std::min(read.find("-->"), read.find("-o>"));
        if (arrow == std::string_view::npos || arrow + 3 >= read.size()) return;
        if (read.find(':', arrow) != std::string_view::npos) return;
        const bool is_sure = !is_blank(read.back()) && peek(2) == '/';  // as printed in books: F/////F
        const std::string message =
            "a comment begins here and hides the rest of the production: blanks between slashes make them modules, "
            "as in 'F / / F'";
        is_sure ? mistakes_.error(at_, message) : mistakes_.insist(at_, message);
    }

    void copy() {
        const char c = peek();
        const bool control = (static_cast<unsigned char>(c) < 0x20 && !is_blank(c) && c != '\n') || c == 0x7F;
        if (c == end_of_file && text_.find_first_not_of(" \t\r\n\x1A", position_) == std::string_view::npos) {
            // Editors of old left it behind the last line.
        } else if (control) {
            mistakes_.error(at_, fmt::format("control character {:#04x} in the text", static_cast<unsigned char>(c)));
        } else if (c != '\r' || peek(1) != '\n') {
            out_.append(c, at_);
        }
        advance();
    }

    void step() {
        if (position_ >= text_.size()) return;
        const char c = peek();
        if (at_stray_backslash()) {
            mistakes_.warning(at_, "this backslash is ignored: one alone joins the line with the next");
            advance();
        } else if (c == '/' && peek(1) == '/') {
            tell_lost_modules();
            while (position_ < text_.size() && peek() != '\n') {
                if (!next_line_joined()) advance();
            }
        } else if (c == '/' && peek(1) == '*') {
            block_comment();
        } else if (c == '"' || c == '\'') {
            const std::size_t end = end_of_literal(text_, position_);
            do copy();
            while (position_ < end);
        } else {
            copy();
        }
    }

    void block_comment() {
        const Location begin = at_;
        const std::size_t close = text_.find("*/", position_ + 2);
        if (close == std::string_view::npos) {
            const char* message = "this comment is never closed: '*/' is missing";
            // Behind the last L-system it hides nothing.
            const bool harmless = text_.substr(0, position_).find("endlsystem") != std::string_view::npos &&
                                  text_.find("lsystem", position_) == std::string_view::npos;
            harmless ? mistakes_.warning(begin, message) : mistakes_.error(begin, message);
        }
        const std::size_t end = close == std::string_view::npos ? text_.size() : close + 2;
        out_.append(' ', begin);
        while (position_ < end) advance();
    }

    std::string_view text_;
    std::size_t position_ = 0;
    Location at_;
    MappedText out_;
    Mistakes& mistakes_;
};

}  // namespace

MappedText without_comments(const Sources& sources, std::uint32_t file, Mistakes& mistakes) {
    return CommentRemover(sources, file, mistakes).run();
}

std::size_t end_of_literal(std::string_view text, std::size_t start) {
    for (std::size_t i = start + 1; i < text.size() && text[i] != '\n'; ++i) {
        if (text[i] == text[start]) return i + 1;
        if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] != '\n') ++i;
    }
    return start;
}

}  // namespace espalier::language
