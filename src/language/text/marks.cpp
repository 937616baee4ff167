#include "language/text/marks.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>

namespace espalier::language {
namespace {

constexpr char opening = '\x01', opened = '\x02', closing = '\x03';

/// Reads the mark that begins at `k`, and moves `k` behind it. Nothing for characters that are none.
std::optional<Location> read_mark(std::string_view text, std::size_t& k) {
    std::array<std::uint32_t, 3> numbers{};
    const char *at = text.data() + k + 1, *const end = text.data() + text.size();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto [behind, error] = std::from_chars(at, end, numbers[i]);
        const char expected = i + 1 < numbers.size() ? '.' : opened;
        if (error != std::errc() || behind == end || *behind != expected) return std::nullopt;
        at = behind + 1;
    }
    k = static_cast<std::size_t>(at - text.data());
    return Location{numbers[0], static_cast<int>(numbers[1]), static_cast<int>(numbers[2])};
}

/// Goes through a marked text from left to right.
class Unmarking {
public:
    Unmarking(std::string_view text, const std::vector<std::string>& files) : text_(text), files_(files) {}

    TranslatedText run() {
        for (std::size_t k = 0; k < text_.size();) {
            if (text_[k] == opening && open(k)) continue;
            if (text_[k] == closing && !around_.empty()) {
                around_.pop_back();
            } else {
                copy(text_[k]);
            }
            ++k;
        }
        return std::move(result_);
    }

private:
    bool open(std::size_t& k) {
        const std::size_t begin = k;
        const std::optional<Location> at = read_mark(text_, k);
        if (at && at->file < files_.size()) {
            around_.push_back(*at);
            return true;
        }
        k = begin;
        return false;
    }

    void copy(char c) {
        const Location at = around_.empty() ? Location{} : around_.back();
        if (at != last_) {
            const Place place = at == Location{} ? Place{} : Place{files_[at.file], at.line, at.column};
            result_.origins.push_back({line_, column_, place});
            last_ = at;
        }
        result_.text += c;
        if (c == '\n') {
            ++line_;
            column_ = 1;
        } else if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) {
            ++column_;
        }
    }

    std::string_view text_;
    const std::vector<std::string>& files_;
    std::vector<Location> around_;
    Location last_;
    int line_ = 1, column_ = 1;
    TranslatedText result_;
};

}  // namespace

std::string marked(std::string_view text, Location at) {
    return fmt::format("{}{}.{}.{}{}{}{}", opening, at.file, at.line, at.column, opened, text, closing);
}

std::string without_marks(std::string_view text) {
    std::string result;
    for (std::size_t k = 0; k < text.size();) {
        if (text[k] == opening && read_mark(text, k)) continue;
        if (text[k] != closing) result += text[k];
        ++k;
    }
    return result;
}

TranslatedText unmarked(std::string_view text, const std::vector<std::string>& files) {
    return Unmarking(text, files).run();
}

}  // namespace espalier::language
