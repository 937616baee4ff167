// grow: base -> geometry -> lsystem -> language -> turtle -> environment -> timeline -> simulation
// look: base -> geometry -> archive -> analysis | formats | picture -> view
// studio and python stand behind both, and the command line, app, above all.
#include "catch.h"
#include "sources.h"

namespace {

using namespace layout;

// The station a file belongs to: the folder after src/, tests/ or include/espalier/.
std::string station_of(const fs::path& file) {
    auto part = file.begin();
    if (*part == "include") ++part;
    return (++part)->string();
}

// The station an include line reaches into, or "" for the file's own folder and foreign libraries.
std::string station_included(const std::string& include) {
    const fs::path path(include);
    auto part = path.begin();
    if (part != path.end() && *part == "espalier") ++part;
    return part != path.end() && std::next(part) != path.end() && is_station(part->string()) ? part->string() : "";
}

std::vector<std::string> violations(const fs::path& file) {
    std::vector<std::string> found;
    const std::string station = station_of(file);
    for (const std::string& include : includes_of(file)) {
        const std::string other = station_included(include);
        if (other.empty() || may_include(station, other)) continue;
        found.push_back(file.string() + " includes " + include + ", which does not stand before it");
    }
    return found;
}

std::vector<std::string> violations_below(const fs::path& folder, std::size_t& files) {
    std::vector<std::string> found;
    for (const fs::path& file : sources_below(folder)) {
        ++files;
        for (std::string& violation : violations(file)) found.push_back(std::move(violation));
    }
    return found;
}

}  // namespace

TEST_CASE("every file includes only what stands before it in its line", "[layout]") {
    std::vector<std::string> found;
    std::size_t files = 0;
    for (const std::vector<std::string>& line : {growing, looking, both, {"app"}}) {
        for (const std::string& station : line) {
            for (const fs::path& folder : {fs::path("include/espalier") / station, fs::path("src") / station}) {
                for (std::string& violation : violations_below(folder, files)) found.push_back(std::move(violation));
            }
        }
    }
    CHECK(files > 400);
    CHECK(found == std::vector<std::string>{});
}

// Tests of what looks grow the plants that they look at.
TEST_CASE("tests of the growing half include only what stands before them", "[layout]") {
    std::size_t files = 0;
    for (const std::string& station : growing) {
        CHECK(violations_below(fs::path("tests") / station, files) == std::vector<std::string>{});
    }
    CHECK(files > 60);
}

TEST_CASE("public headers include no header of src", "[layout]") {
    for (const fs::path& file : sources_below("include")) {
        for (const std::string& include : includes_of(file)) {
            INFO(file << " includes " << include);
            CHECK((station_included(include).empty() || include.starts_with("espalier/")));
        }
    }
}

TEST_CASE("src and include have no folder that is not a station", "[layout]") {
    for (const char* folder : {"src", "include/espalier"}) {
        for (const auto& entry : fs::directory_iterator(root / folder)) {
            INFO(entry.path());
            CHECK(is_station(entry.path().filename().string()));
        }
    }
}

TEST_CASE("the test of the two lines sees a station that includes what it must not", "[layout]") {
    CHECK(station_included("espalier/timeline/frame.h") == "timeline");
    CHECK(station_included("environment/water_grid.h") == "environment");
    CHECK(station_included("tbb/parallel_for.h").empty());
    CHECK(station_included("water_grid.h").empty());
    CHECK(station_of("include/espalier/turtle/query.h") == "turtle");
    CHECK(station_of("src/turtle/symbols/turn.cpp") == "turtle");
    CHECK(may_include("environment", "turtle"));
    CHECK_FALSE(may_include("turtle", "environment"));
    CHECK_FALSE(may_include("timeline", "archive"));
    CHECK_FALSE(may_include("archive", "timeline"));
    CHECK_FALSE(may_include("picture", "formats"));
    CHECK(may_include("view", "picture"));
    CHECK(may_include("app", "view"));
}
