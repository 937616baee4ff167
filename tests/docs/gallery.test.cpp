// The gallery has every model and scene of the library, with a title and a picture that shows something.
#include "base/picture_file.h"
#include "catch.h"
#include "page.h"

#include <set>

namespace {

using namespace pages;

struct Cell {
    std::string shelf, picture, title, file;
};

std::vector<Cell> cells() {
    static const std::regex cell(R"(!\[[^\]]*\]\(([^)]*)\)<br>\[\*\*([^*]*)\*\*\]\(\.\./([^)]*)\)<br>)");
    std::vector<Cell> found;
    std::string shelf;
    for (const std::string& line : lines_of("docs/gallery.md")) {
        if (line.starts_with("## ")) shelf = line.substr(3);
        for (std::sregex_iterator at(line.begin(), line.end(), cell), end; at != end; ++at)
            found.push_back({shelf, (*at)[1], (*at)[2], (*at)[3]});
    }
    return found;
}

bool is_shown(const fs::path& file) {
    const std::string kind = file.extension();
    if (kind != ".toml") return kind == ".l" || kind == ".pgraph" || kind == ".sdl" || kind == ".species";
    std::ifstream in(file);
    return (std::ostringstream() << in.rdbuf()).str().find("[[plant]]") != std::string::npos;
}

std::set<std::string> library() {
    std::set<std::string> files;
    for (const char* folder : {"models", "environments"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            if (entry.is_regular_file() && is_shown(entry.path())) files.insert(fs::relative(entry.path(), root));
        }
    }
    return files;
}

/// The share of pixels that one sees against the commonest colour.
double drawn_share(const espalier::Picture& picture) {
    std::map<espalier::Picture::Colour, int> counts;
    for (const auto& pixel : picture.pixels) ++counts[pixel];
    const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
    const auto ground = std::max_element(counts.begin(), counts.end(), fewer)->first;
    int drawn = 0;
    for (const auto& [colour, count] : counts) {
        int difference = 0;
        for (std::size_t i = 0; i < 3; ++i) difference = std::max(difference, std::abs(colour[i] - ground[i]));
        if (difference > 48) drawn += count;
    }
    return drawn / static_cast<double>(picture.pixels.size());
}

}  // namespace

TEST_CASE("Every model and scene of the library stands on one shelf of the gallery, and nothing else", "[docs]") {
    std::set<std::string> shown;
    for (const Cell& cell : cells()) {
        INFO(cell.file);
        CHECK(shown.insert(cell.file).second);
        CHECK_FALSE(cell.shelf.empty());
        CHECK_FALSE(cell.title.empty());
        CHECK(cell.title != fs::path(cell.file).stem());
    }
    CHECK(shown == library());
}

TEST_CASE("No picture of the gallery is blank, none is unused, and all are small", "[docs]") {
    std::set<fs::path> used;
    std::uintmax_t bytes = 0;
    for (const Cell& cell : cells()) {
        INFO(cell.file);
        const fs::path file = root / "docs" / cell.picture;
        REQUIRE(fs::is_regular_file(file));
        if (!used.insert(file).second) continue;
        bytes += fs::file_size(file);
        const espalier::Picture picture = espalier::read_picture(file);
        CHECK(picture.width == 180);
        CHECK(picture.height == 180);
        CHECK(drawn_share(picture) > 0.005);
    }
    CHECK(bytes < 1'500'000);
    for (const auto& entry : fs::directory_iterator(root / "docs/pictures/gallery")) CHECK(used.contains(entry.path()));
}
