#include "app/look/gallery_page.h"

#include "espalier/base/file.h"

#include <regex>
#include <sstream>
#include <string>

namespace espalier::app {

std::vector<GalleryEntry> gallery_of(const std::filesystem::path& data) {
    static const std::regex cell(R"(!\[[^\]]*\]\(([^)]*)\)<br>\[\*\*([^*]*)\*\*\]\(([^)]*)\)<br>([^<]*)<br>)");
    const std::string heading = "## ";
    const std::filesystem::path page = data / "docs/gallery.md";
    std::vector<GalleryEntry> entries;
    if (!is_regular_file(page)) return entries;
    std::istringstream in(read_text(page));
    std::string shelf;
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with(heading)) shelf = line.substr(heading.size());
        for (std::sregex_iterator at(line.begin(), line.end(), cell), end; at != end; ++at) {
            const auto file = [&](int group) { return (page.parent_path() / (*at)[group].str()).lexically_normal(); };
            entries.push_back({file(3), shelf, (*at)[2], (*at)[4], file(1)});
        }
    }
    return entries;
}

}  // namespace espalier::app
