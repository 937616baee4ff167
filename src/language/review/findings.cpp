#include "language/review/findings.h"

#include "espalier/base/file.h"

#include <algorithm>
#include <filesystem>
#include <tuple>
#include <utility>

namespace espalier::language {

void Findings::add(const Place& place, std::string message, bool insistent) {
    found_.push_back({Diagnostic::Severity::warning, place, std::move(message), source_line(place), insistent});
}

std::vector<Diagnostic> Findings::in_order() {
    std::stable_sort(found_.begin(), found_.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::tie(a.place.file, a.place.line, a.place.column) <
               std::tie(b.place.file, b.place.line, b.place.column);
    });
    return std::move(found_);
}

std::string Findings::source_line(const Place& place) {
    if (!place.known()) return "";
    if (!files_.contains(place.file)) {
        std::vector<std::string> lines;
        // A model that was read from text has no file to show a line of.
        if (std::error_code code; std::filesystem::is_regular_file(place.file, code)) {
            const std::string text = read_text(place.file);
            for (std::size_t start = 0; start < text.size();) {
                const std::size_t end = std::min(text.find('\n', start), text.size());
                lines.push_back(text.substr(start, end - start));
                start = end + 1;
            }
        }
        files_[place.file] = std::move(lines);
    }
    const std::vector<std::string>& lines = files_[place.file];
    const auto line = static_cast<std::size_t>(place.line);
    return line >= 1 && line <= lines.size() ? lines[line - 1] : "";
}

}  // namespace espalier::language
