// Links between pages, to pictures and to files lead somewhere, and the headers that examples include are there.
#include "catch.h"
#include "page.h"

#include <set>

namespace {

using namespace pages;

// The name GitHub gives a heading: small letters, blanks as hyphens, no punctuation.
std::string anchor_of(std::string heading) {
    heading = std::regex_replace(heading, std::regex(R"(^#+\s*|`)"), "");
    std::string anchor;
    for (const char c : heading) {
        if (c == ' ') anchor += '-';
        if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c < 0) anchor += std::tolower(c);
    }
    return anchor;
}

std::set<std::string> anchors_in(const fs::path& page) {
    std::set<std::string> anchors;
    bool code = false;
    for (const std::string& line : lines_of(page)) {
        if (line.starts_with("```")) code = !code;
        if (!code && line.starts_with('#')) anchors.insert(anchor_of(line));
    }
    return anchors;
}

// What stands in the parentheses of [text](target), outside code.
std::vector<std::string> links_in(const fs::path& page) {
    static const std::regex link(R"(\]\(([^)\s]+)\))"), inline_code("`[^`]*`");
    std::vector<std::string> links;
    bool code = false;
    for (const std::string& raw : lines_of(page)) {
        if (raw.starts_with("```")) code = !code;
        if (code) continue;
        const std::string line = std::regex_replace(raw, inline_code, "code");
        for (std::sregex_iterator at(line.begin(), line.end(), link), end; at != end; ++at) links.push_back((*at)[1]);
    }
    return links;
}

std::vector<fs::path> linking_pages() {
    std::vector<fs::path> pages = all_pages();
    pages.push_back("CHANGELOG.md");
    for (const auto& entry : fs::recursive_directory_iterator(root / "models")) {
        if (entry.path().filename() == "README.md") pages.push_back(fs::relative(entry.path(), root));
    }
    return pages;
}

bool is_header(const std::string& name) {
    return fs::exists(root / "include" / name) || fs::exists(root / "src" / name) || fs::exists(root / "tests" / name);
}

}  // namespace

TEST_CASE("Every link of a page leads to a file, and to a heading if it names one", "[docs]") {
    std::size_t checked = 0;
    for (const fs::path& page : linking_pages()) {
        for (const std::string& link : links_in(page)) {
            if (link.starts_with("http")) continue;
            INFO(page.string() << " links to " << link);
            const std::string file = link.substr(0, link.find('#'));
            const fs::path target = file.empty() ? page : (page.parent_path() / file).lexically_normal();
            const bool exists = fs::exists(root / target);
            CHECK(exists);
            if (exists && link.find('#') != std::string::npos) {
                CHECK(anchors_in(target).count(link.substr(link.find('#') + 1)) == 1);
            }
            ++checked;
        }
    }
    CHECK(checked > 100);
}

TEST_CASE("Every header that an example of a page includes is there", "[docs]") {
    static const std::regex include(R"re(\s*#include "(espalier/[^"]+)".*)re");
    for (const fs::path& page : all_pages()) {
        for (const pages::Block& block : blocks_of(page)) {
            for (const std::string& line : block.lines) {
                std::smatch found;
                if (!std::regex_match(line, found, include)) continue;
                INFO(page.string() << " includes " << found[1]);
                CHECK(is_header(found[1]));
            }
        }
    }
}

TEST_CASE("Every file that a page names in the tree is there", "[docs]") {
    static const std::regex named("`((src|include|tests|models|environments|docs)/[A-Za-z0-9_./-]+)`");
    const std::set<std::string> of_examples{"src/environment/light/height.cpp",
                                            "tests/environment/light/height.test.cpp",
                                            "src/timeline/recorders/sizes.cpp"};
    std::size_t checked = 0;
    for (const fs::path& page : all_pages()) {
        for (const std::string& line : lines_of(page)) {
            for (std::sregex_iterator at(line.begin(), line.end(), named), end; at != end; ++at) {
                INFO(page.string() << " names " << (*at)[1]);
                CHECK((of_examples.count((*at)[1]) == 1 || fs::exists(root / (*at)[1].str())));
                ++checked;
            }
        }
    }
    CHECK(checked > 20);
}

TEST_CASE("The indexes of the manual, of the reference and of models name every page", "[docs]") {
    std::set<fs::path> named;
    for (const fs::path index : {"docs/README.md", "docs/reference/README.md", "docs/models.md"}) {
        for (const std::string& link : links_in(index))
            named.insert((index.parent_path() / link.substr(0, link.find('#'))).lexically_normal());
    }
    for (const fs::path& page : all_pages()) {
        if (page == "docs/README.md" || *page.begin() != "docs") continue;
        INFO(page.string());
        CHECK(named.contains(page));
    }
}
