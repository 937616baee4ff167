// base -> lsystem -> language -> geometry -> turtle -> environment -> timeline -> simulation -> app
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
    return part != path.end() && std::next(part) != path.end() && place_in_line(part->string()) >= 0 ? part->string()
                                                                                                     : "";
}

std::vector<std::string> violations(const fs::path& file) {
    std::vector<std::string> found;
    const std::string station = station_of(file);
    for (const std::string& include : includes_of(file)) {
        const std::string other = station_included(include);
        if (other.empty()) continue;
        if (place_in_line(other) > place_in_line(station)) {
            found.push_back(file.string() + " includes " + include + ", which stands to its right");
        }
        if (other != station && !include.starts_with("espalier/") && !file.string().starts_with("tests/")) {
            found.push_back(file.string() + " includes " + include + ", a private header of " + other);
        }
    }
    return found;
}

}  // namespace

TEST_CASE("every file includes only from its left", "[layout]") {
    std::vector<std::string> found;
    std::size_t files = 0;
    for (const std::string& station : stations) {
        for (const fs::path& folder :
             {fs::path("include/espalier") / station, fs::path("src") / station, fs::path("tests") / station}) {
            for (const fs::path& file : sources_below(folder)) {
                ++files;
                for (std::string& violation : violations(file)) found.push_back(std::move(violation));
            }
        }
    }
    CHECK(files > 60);
    CHECK(found == std::vector<std::string>{});
}

TEST_CASE("src and include have no folder that is not a station", "[layout]") {
    for (const char* folder : {"src", "include/espalier"}) {
        for (const auto& entry : fs::directory_iterator(root / folder)) {
            INFO(entry.path());
            CHECK(place_in_line(entry.path().filename().string()) >= 0);
        }
    }
}

TEST_CASE("the test of the line sees a station reaching to its right", "[layout]") {
    CHECK(station_included("espalier/timeline/frame.h") == "timeline");
    CHECK(station_included("environment/water_grid.h") == "environment");
    CHECK(station_included("tbb/parallel_for.h").empty());
    CHECK(station_included("water_grid.h").empty());
    CHECK(station_of("include/espalier/turtle/query.h") == "turtle");
    CHECK(station_of("src/turtle/symbols/turn.cpp") == "turtle");
    CHECK(place_in_line("environment") > place_in_line("turtle"));
}
