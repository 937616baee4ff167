// A public name has one declaration: the stations' namespaces are inline, and no line lifts a name out of them.
#include "catch.h"
#include "sources.h"

#include <regex>
#include <set>

namespace {

using namespace layout;

bool opens_station(const std::string& line) {
    static const std::regex opening(R"(^namespace espalier::(\w+))");
    std::smatch match;
    return std::regex_search(line, match, opening) && is_station(match[1]);
}

bool lifts_name(const std::string& line) {
    static const std::regex lifting(R"(^using (?:espalier::)?(\w+)::[\w:]+;)");
    std::smatch match;
    return std::regex_search(line, match, lifting) && is_station(match[1]);
}

}  // namespace

TEST_CASE("the namespaces of all stations with public headers are inline", "[layout]") {
    static const std::regex declares(R"(^inline namespace (\w+) \{\}$)");
    std::set<std::string> declared, stations;
    for (const std::string& line : lines_of("include/espalier/base/stations.h")) {
        std::smatch match;
        if (std::regex_match(line, match, declares)) declared.insert(match[1]);
    }
    for (const auto& entry : fs::directory_iterator(root / "include/espalier")) {
        if (entry.path().filename() != "base") stations.insert(entry.path().filename().string());
    }
    CHECK(declared.size() > 10);
    CHECK(declared == stations);
}

// Other programs have no compiler option that includes it first, as ours do.
TEST_CASE("a public header that opens a station's namespace includes what makes it inline", "[layout]") {
    for (const fs::path& file : sources_below("include")) {
        const auto lines = lines_of(file), includes = includes_of(file);
        if (std::none_of(lines.begin(), lines.end(), opens_station)) continue;
        INFO(file.string());
        CHECK(std::find(includes.begin(), includes.end(), "espalier/base/stations.h") != includes.end());
    }
}

TEST_CASE("no file gives a station's name a second full name", "[layout]") {
    CHECK(lifts_name("using turtle::Walk;"));
    CHECK(lifts_name("using espalier::language::pgraph::Graph;"));
    CHECK_FALSE(lifts_name("using openvdb::Coord;"));
    for (const char* folder : {"include", "src"}) {
        for (const fs::path& file : sources_below(folder)) {
            for (const std::string& line : lines_of(file)) {
                INFO(file << ": " << line);
                CHECK_FALSE(lifts_name(line));
            }
        }
    }
}
