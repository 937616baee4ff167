#include "language/preprocessor/setting_comment.h"

#include "base/number.h"
#include "language/preprocessor/macros.h"

#include <cmath>
#include <vector>

namespace espalier::language {
namespace {

constexpr std::string_view dashes = "---";

/// What the first comment of a line says; "" if there is none.
std::string_view comment_of(std::string_view line) {
    const std::size_t block = line.find("/*"), rest = line.find("//");
    if (block == line.npos && rest == line.npos) return {};
    if (rest < block) return stripped(line.substr(rest + 2));
    const std::string_view inside = line.substr(block + 2);
    return stripped(inside.substr(0, inside.find("*/")));
}

std::vector<std::string_view> parts_of(std::string_view comment) {
    std::vector<std::string_view> parts;
    for (std::size_t end; (end = comment.find(';')) != comment.npos; comment.remove_prefix(end + 1)) {
        parts.push_back(stripped(comment.substr(0, end)));
    }
    parts.push_back(stripped(comment));
    return parts;
}

/// An end of a range that is left out stays as it is; false if something else than a number stands there.
bool read_end(std::string_view text, double& end) {
    text = stripped(text);
    if (text.empty()) return true;
    const std::optional<double> number = finite_number(text);
    end = number.value_or(end);
    return number.has_value();
}

/// "0..1", "0..", "1..400 whole".
bool read_range(std::string_view text, SettingComment& comment) {
    constexpr std::string_view whole = " whole";
    comment.whole = text.ends_with(whole);
    if (comment.whole) text = stripped(text.substr(0, text.size() - whole.size()));
    const std::size_t dots = text.find("..");
    return dots != text.npos && text.size() > 2 && read_end(text.substr(0, dots), comment.lowest) &&
           read_end(text.substr(dots + 2), comment.highest);
}

}  // namespace

std::optional<SettingComment> setting_comment(std::string_view line) {
    const std::string_view comment = comment_of(line);
    const std::vector<std::string_view> parts = parts_of(comment);
    SettingComment result;
    // The range is the last part, or the unit stands behind it; the summary may have semicolons of its own.
    for (const std::size_t behind : {0, 1}) {
        if (parts.size() < behind + 2) break;
        const std::string_view range = parts[parts.size() - 1 - behind];
        if (!read_range(range, result = {})) continue;
        const auto length = static_cast<std::size_t>(range.data() - comment.data());
        result.summary = stripped(comment.substr(0, comment.rfind(';', length)));
        if (behind == 1) result.unit = parts.back();
        return result;
    }
    return std::nullopt;
}

std::string_view heading_of(std::string_view line) {
    line = stripped(line);
    if (!line.starts_with("/*") && !line.starts_with("//")) return {};
    const std::string_view comment = comment_of(line);
    const bool framed = comment.size() > 2 * dashes.size() && comment.starts_with(dashes) && comment.ends_with(dashes);
    return framed ? stripped(comment.substr(dashes.size(), comment.size() - 2 * dashes.size())) : std::string_view();
}

}  // namespace espalier::language
