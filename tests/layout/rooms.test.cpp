// Rooms of the studio: protocol, document and packets -> growth -> session -> server.
#include "catch.h"
#include "sources.h"

#include <map>

namespace {

using namespace layout;

/// The rooms that files of a room may include, besides their own.
const std::map<std::string, std::vector<std::string>> rooms{
    {"protocol", {}},
    {"document", {"protocol"}},
    {"packets", {}},
    {"growth", {"protocol", "document", "packets"}},
    {"session", {"protocol", "document", "packets", "growth"}},
    {"server", {"protocol", "growth", "session"}},
};

/// "growth" of "studio/growth/spool.h"; "" of what lies elsewhere.
std::string room_included(const std::string& include) {
    const fs::path path(include);
    return path.begin() != path.end() && *path.begin() == "studio" ? std::next(path.begin())->string() : "";
}

}  // namespace

TEST_CASE("every file of the studio lies in a room and includes only rooms to its left", "[layout]") {
    std::size_t files = 0;
    for (const fs::path& file : sources_below("src/studio")) {
        const std::string room = std::next(file.begin(), 2)->string();
        INFO(file);
        REQUIRE(rooms.contains(room));
        ++files;
        for (const std::string& include : includes_of(file)) {
            const std::string other = room_included(include);
            INFO("includes " << include);
            CHECK((other.empty() || other == room || is_in(rooms.at(room), other)));
        }
    }
    CHECK(files > 60);
}

TEST_CASE("the test of rooms knows the room of an include line", "[layout]") {
    CHECK(room_included("studio/growth/spool.h") == "growth");
    CHECK(room_included("espalier/studio/studio.h").empty());
    CHECK(room_included("fmt/format.h").empty());
}
