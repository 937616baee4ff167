#include "language/text/source.h"

#include "base/excerpt.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace espalier::language {

std::uint32_t Sources::add(std::string name, std::string text) {
    return add(std::move(name), TranslatedText{std::move(text)});
}

std::uint32_t Sources::add(std::string name, TranslatedText translated) {
    File file{std::move(name), std::move(translated.text), {0}, std::move(translated.origins)};
    for (std::size_t i = 0; i < file.text.size(); ++i) {
        if (file.text[i] == '\n') file.line_starts.push_back(i + 1);
    }
    files_.push_back(std::move(file));
    return static_cast<std::uint32_t>(files_.size() - 1);
}

Place Sources::origin(Location location) const {
    const std::vector<TranslatedText::Origin>& origins = files_[location.file].origins;
    const auto behind =
        std::upper_bound(origins.begin(), origins.end(), location, [](Location at, const TranslatedText::Origin& each) {
            return std::pair(at.line, at.column) < std::pair(each.line, each.column);
        });
    return behind == origins.begin() ? Place{} : std::prev(behind)->place;
}

Place Sources::place(Location location) const {
    if (const Place written = origin(location); written.known()) return written;
    const File& file = files_[location.file];
    const bool is_of_translation = !file.origins.empty() && location.line > 0;
    return {file.name + (is_of_translation ? ", translated" : ""), location.line, location.column};
}

std::string Sources::line_at_place(Location location) const {
    const Place written = origin(location);
    return written.known() ? source_line(written) : line(location);
}

std::string Sources::line(Location location) const {
    const File& file = files_[location.file];
    const auto index = static_cast<std::size_t>(location.line);
    if (location.line < 1 || index > file.line_starts.size()) return "";
    const std::size_t start = file.line_starts[index - 1];
    std::size_t end = index < file.line_starts.size() ? file.line_starts[index] - 1 : file.text.size();
    if (end > start && file.text[end - 1] == '\r') --end;
    return file.text.substr(start, end - start);
}

void MappedText::append(char character, Location at) {
    const bool follows = [&] {
        if (runs_.empty() || runs_.back().fixed) return false;
        const Run& last = runs_.back();
        return last.at.file == at.file && last.at.line == at.line &&
               last.at.column + static_cast<int>(text_.size() - last.start) == at.column;
    }();
    if (!follows) runs_.push_back({text_.size(), at, false});
    text_ += character;
}

void MappedText::append_at(std::string_view text, Location at) {
    if (text.empty()) return;
    if (runs_.empty() || !runs_.back().fixed || runs_.back().at != at) runs_.push_back({text_.size(), at, true});
    text_ += text;
}

void MappedText::append(const MappedText& other, std::size_t from, std::size_t to) {
    if (from >= to) return;
    for (std::size_t r = other.run_of(from); r < other.runs_.size() && other.runs_[r].start < to; ++r) {
        const Run& run = other.runs_[r];
        const std::size_t start = std::max(from, run.start);
        Location at = run.at;
        if (!run.fixed) at.column += static_cast<int>(start - run.start);
        runs_.push_back({text_.size() + (start - from), at, run.fixed});
    }
    text_.append(other.text_, from, to - from);
}

std::size_t MappedText::run_of(std::size_t offset) const {
    const auto after = std::upper_bound(runs_.begin(), runs_.end(), offset,
                                        [](std::size_t value, const Run& run) { return value < run.start; });
    return static_cast<std::size_t>(after - runs_.begin()) - 1;
}

Location MappedText::location(std::size_t offset) const {
    if (runs_.empty()) return {0, 1, 1};
    const Run& run = runs_[run_of(offset)];
    Location at = run.at;
    if (!run.fixed) at.column += static_cast<int>(offset - run.start);
    return at;
}

void Mistakes::error(Location at, std::string message) {
    const auto is_same = [&](const SyntaxError& other) { return other.at == at && other.message == message; };
    if (std::any_of(errors_.begin(), errors_.end(), is_same)) return;
    errors_.push_back({{at, std::move(message)}});
    if (errors_.size() >= most_errors) throw TooManyMistakes{};
}

void Mistakes::warning(Location at, std::string message) {
    warnings_.push_back({{at, std::move(message)}});
}

void Mistakes::insist(Location at, std::string message) {
    warnings_.push_back({{at, std::move(message)}, true});
}

std::vector<Diagnostic> Mistakes::sorted(std::vector<Mistake> found, Diagnostic::Severity severity) const {
    std::stable_sort(found.begin(), found.end(), [](const Mistake& a, const Mistake& b) { return a.at < b.at; });
    std::vector<Diagnostic> diagnostics;
    for (Mistake& mistake : found) {
        diagnostics.push_back({severity, sources_.place(mistake.at), std::move(mistake.message),
                               sources_.line_at_place(mistake.at), mistake.insistent});
    }
    return diagnostics;
}

}  // namespace espalier::language
