#include "base/toml_depth.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <vector>

namespace espalier {
namespace {

/// Walks over the structure of a text: keys, brackets and braces. What is no TOML may be passed over, but nothing that
/// toml++ would take for a key or for the beginning of a value.
class DepthScan {
public:
    explicit DepthScan(std::string_view text) : text_(text) {
        if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // the byte-order mark
    }

    std::optional<Place> too_deep() {
        while (!is_damaged_ && !deepest_at_) {
            skip_blanks_and_lines();
            if (is_end()) break;
            now() == '[' ? header() : pair();
        }
        if (!deepest_at_) return std::nullopt;
        return place_of(*deepest_at_);
    }

private:
    /// An open array or inline table of a value.
    struct Open {
        char closing = ']';
        int depth = 0;
    };

    bool is_end() const { return at_ >= text_.size(); }
    char now() const { return is_end() ? '\0' : text_[at_]; }
    bool is_next(std::string_view word) const { return text_.substr(at_).starts_with(word); }

    void skip_blanks() {
        while (now() == ' ' || now() == '\t') ++at_;
    }
    void skip_comment() { at_ = std::min(text_.find('\n', at_), text_.size()); }
    void skip_blanks_and_lines() {
        for (;; ++at_) {
            if (now() == '#') skip_comment();
            if (is_end() || (now() != ' ' && now() != '\t' && now() != '\r' && now() != '\n')) return;
        }
    }

    // "text", 'text', """text""" or '''text'''.
    void skip_string() {
        const char quote = now();
        const bool is_long = is_next(std::string_view(quote == '"' ? "\"\"\"" : "'''"));
        at_ += is_long ? 3 : 1;
        while (!is_end()) {
            if (now() == '\\' && quote == '"') {
                at_ = std::min(at_ + 2, text_.size());
            } else if (now() == quote) {
                const std::size_t run = std::min(text_.find_first_not_of(quote, at_), text_.size()) - at_;
                // Up to two quotes stand before the three that end a long string.
                at_ += is_long ? std::min<std::size_t>(run, 5) : 1;
                if (!is_long || run >= 3) return;
            } else if (now() == '\n' && !is_long) {
                break;
            } else {
                ++at_;
            }
        }
        is_damaged_ = true;
    }

    void enter(int depth) {
        if (depth > deepest_toml && !deepest_at_) deepest_at_ = at_;
    }

    // The parts of a key, of which the first lies `depth` deep. Returns the depth of what it names.
    int key(int depth) {
        for (;;) {
            skip_blanks();
            enter(++depth);
            const std::size_t begin = at_;
            if (now() == '"' || now() == '\'') {
                skip_string();
            } else {
                while (std::isalnum(static_cast<unsigned char>(now())) || now() == '_' || now() == '-') ++at_;
            }
            if (at_ == begin) is_damaged_ = true;
            skip_blanks();
            if (is_damaged_ || deepest_at_ || now() != '.') return depth;
            ++at_;
        }
    }

    void expect(char c) {
        if (now() == c) {
            ++at_;
        } else {
            is_damaged_ = true;
        }
    }

    // [key] or [[key]].
    void header() {
        ++at_;
        skip_blanks();
        const bool is_array = now() == '[';
        if (is_array) ++at_;
        of_header_ = key(0) + (is_array ? 1 : 0);
        enter(of_header_);
        expect(']');
        if (is_array) expect(']');
    }

    // key = value, up to the end of the value.
    void pair() {
        const int depth = key(of_header_);
        expect('=');
        value(depth);
    }

    // Behind the brace or a comma of an inline table. Returns the depth of the value that follows.
    int inline_key(int depth) {
        skip_blanks_and_lines();
        if (is_end() || now() == '}') return depth;
        depth = key(depth);
        expect('=');
        return depth;
    }

    // Without recursion: the stack is what is to be saved.
    void value(int depth) {
        std::vector<Open> open;
        while (!is_end() && !is_damaged_ && !deepest_at_) {
            const char c = now();
            if (c == '"' || c == '\'') {
                skip_string();
                continue;
            }
            if (c == '#') skip_comment();
            if (now() == '\n' && open.empty()) return;
            ++at_;
            if (c == '[') {
                open.push_back({']', depth});
                enter(++depth);
            } else if (c == '{') {
                open.push_back({'}', depth});
                depth = inline_key(depth);
            } else if (c == ',' && !open.empty() && open.back().closing == '}') {
                depth = inline_key(open.back().depth);
            } else if (!open.empty() && c == open.back().closing) {
                depth = open.back().depth;
                open.pop_back();
            }
        }
    }

    Place place_of(std::size_t at) const {
        const std::string_view before = text_.substr(0, at);
        const std::size_t line = before.rfind('\n') + 1;  // 0 on the first
        return {"", static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
                static_cast<int>(at - line) + 1};
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int of_header_ = 0;  ///< depth of the table that pairs belong to
    bool is_damaged_ = false;
    std::optional<std::size_t> deepest_at_;
};

}  // namespace

std::optional<Place> deeper_than_toml_may_be(std::string_view text) {
    return DepthScan(text).too_deep();
}

}  // namespace espalier
