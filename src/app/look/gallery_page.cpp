#include "app/look/gallery_page.h"

#include "espalier/base/file.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>

namespace espalier::app {

namespace {

/// Reads a text from left to right, mark by mark.
class Marks {
public:
    explicit Marks(std::string_view text) : rest_(text) {}

    /// Goes behind the next `mark`.
    bool find(std::string_view mark) {
        const std::size_t at = rest_.find(mark);
        if (at == rest_.npos) return false;
        rest_.remove_prefix(at + mark.size());
        return true;
    }
    bool accept(std::string_view mark) {
        if (!rest_.starts_with(mark)) return false;
        rest_.remove_prefix(mark.size());
        return true;
    }
    /// What stands before the next `mark`, and that mark, which no other of its first character precedes.
    bool take(std::string& text, std::string_view mark) {
        const std::size_t end = std::min(rest_.find(mark.front()), rest_.size());
        text = rest_.substr(0, end);
        rest_.remove_prefix(end);
        return accept(mark);
    }

private:
    std::string_view rest_;
};

}  // namespace

std::vector<GalleryEntry> gallery_of(const std::filesystem::path& data) {
    const std::string heading = "## ";
    const std::filesystem::path page = data / "docs/gallery.md";
    std::vector<GalleryEntry> entries;
    if (!is_regular_file(page)) return entries;
    std::istringstream in(read_text(page));
    std::string shelf;
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with(heading)) shelf = line.substr(heading.size());
        Marks marks(line);
        while (marks.find("![")) {
            std::string alternative, picture, title, file, source;
            if (!marks.take(alternative, "](") || !marks.take(picture, ")<br>[**") || !marks.take(title, "**](") ||
                !marks.take(file, ")<br>") || !marks.take(source, "<br>"))
                continue;
            const auto beside = [&](const std::string& name) { return (page.parent_path() / name).lexically_normal(); };
            entries.push_back({beside(file), shelf, title, source, beside(picture)});
        }
    }
    return entries;
}

}  // namespace espalier::app
