// The rooms of each station: which folder may include which. What stands in a table stands after all that it includes,
// so that no two rooms need each other.
#include "catch.h"
#include "sources.h"

#include <map>
#include <sstream>

namespace {

using namespace layout;

/// A folder below the station's, "." for the station's own, and the folders that it may include besides itself.
struct Room {
    std::string name, includes;
};

/// Stations that are one folder have no table.
const std::map<std::string, std::vector<Room>> stations{
    {"geometry",
     {
         {"rays", ""},
         {"sky", ""},
         {".", ""},
         {"drawn", "."},
         {"grids", "."},
         {"side_files", "."},
     }},
    {"lsystem",
     {
         {"contexts", ""},
         {"model", ""},
         {"programs", ""},
         {"compile", "contexts programs"},
         {"derive", "contexts programs compile"},
         {"homomorphism", "derive"},
     }},
    {"language",
     {
         {"measured", ""},
         {"cylinders", "measured"},
         {"dgf", "measured"},
         {"mtg", "measured"},
         {"opf", "measured"},
         {"root_box", "measured"},
         {"rsml", "measured"},
         {"side_files", ""},
         {"swc", "measured"},
         {"text", ""},
         {"preprocessor", "text"},
         {"parser", "text preprocessor"},
         {"pgraph", "text parser"},
         {"review", "parser"},
         {"sdl", "text"},
         {"weber_penn", "text"},
         {"notations", "cylinders dgf mtg opf root_box rsml swc text pgraph sdl weber_penn"},
         {".", "text preprocessor parser"},
     }},
    {"turtle",
     {
         {"symbols", ""},
         {"view_file", ""},
         {"walk", ""},
         {".", "walk"},
         {"foliage", "."},
         {"stages", ". foliage"},
     }},
    {"environment",
     {
         {"exchange", ""},
         {"leaf/gas", ""},
         {"leaf/carbon", ""},
         {"leaf/measured", ""},
         {"leaf/leaves", "leaf/gas"},
         {"light/sun", ""},
         {"given/weather", "exchange leaf/gas light/sun"},
         {"given/external", "exchange"},
         {"given", "exchange leaf/gas given/external given/weather"},
         {"light/shade", "exchange"},
         {"light/sky", "light/sun given/weather"},
         {"light/optics", "light/sky"},
         {"light/canopy", "exchange light/sky light/optics"},
         {"leaf/waves", "leaf/gas leaf/leaves light/sky light/optics light/canopy"},
         {"leaf", "exchange leaf/gas leaf/leaves leaf/waves leaf/carbon given/weather"},
         {"soil/grid", "exchange"},
         {"soil/hydraulics", "given/weather"},
         {"soil/linear", "soil/grid"},
         {"soil/richards", "exchange given/weather soil/grid soil/hydraulics"},
         {"soil/roots", "given/weather soil/hydraulics soil/richards"},
         {"soil/shoot", "leaf/gas soil/hydraulics soil/roots"},
         {"soil/solutes", "given/weather soil/richards soil/roots"},
         {"soil", "exchange soil/grid soil/hydraulics soil/linear soil/richards soil/roots soil/shoot soil/solutes"},
         {"space/neighbours", "exchange"},
         {"space/shapes", "exchange"},
         {"light/rays", "exchange light/sky light/optics space/shapes"},
         {"light",
          "exchange given/weather light/sun light/shade light/sky light/optics light/canopy space/neighbours "
          "light/rays"},
         {"space/markers", "space/neighbours space/shapes"},
         {"space", "exchange space/neighbours space/shapes space/markers"},
     }},
    {"timeline",
     {
         {"files", ""},
         {"meshes", "files"},
         {"frames", "meshes"},
         {"measures", "meshes"},
         {"recorders", "files meshes frames measures"},
     }},
    {"simulation",
     {
         {"object", ""},
         {"scene", "object"},
         {"plant", "scene"},
         {"spread", "plant"},
         {"world", "scene plant spread"},
         {"run", "scene plant world"},
     }},
    {"archive",
     {
         {"meshes", ""},
         {"landscape", "meshes"},
         {".", "meshes"},
     }},
    {"formats",
     {
         {".", ""},
         {"exporters", "."},
     }},
    {"picture",
     {
         {"landscape", ""},
         {"light", ""},
         {".", ""},
         {"stage", "light ."},
         {"files", "light stage"},
         {"charts", ". files"},
     }},
    {"study",
     {
         {"fit", ""},
         {"landscape", ""},
         {"scan", ""},
         {"sweep", ""},
         {"dataset", "fit scan"},
     }},
    {"studio",
     {
         {"packets", ""},
         {"protocol", ""},
         {"document", "protocol"},
         {"growth", "packets protocol document"},
         {"session", "packets protocol document growth"},
         {"lesson", "document session"},
         {"server", "packets protocol growth session"},
         {"session/requests", "document session"},
     }},
    {"python",
     {
         {".", ""},
         {"recorded", "."},
     }},
    {"app",
     {
         {".", ""},
         {"look", "."},
         {"ranks", "."},
     }},
};

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream words(text);
    return {std::istream_iterator<std::string>(words), {}};
}

/// "light/sky" of "environment/light/sky/sun.h" in the station environment; "" of what lies in another station.
std::string room_included(const std::string& station, const std::string& include) {
    const fs::path path(include);
    if (path.begin() == path.end() || *path.begin() != station) return "";
    const std::string room = fs::relative(path.parent_path(), station).generic_string();
    return room.empty() ? "." : room;
}

const Room* room_named(const std::vector<Room>& rooms, const std::string& name) {
    const auto room = std::find_if(rooms.begin(), rooms.end(), [&](const Room& each) { return each.name == name; });
    return room == rooms.end() ? nullptr : &*room;
}

/// What a file includes of rooms that its own must not; its room itself, if the table lacks it.
std::vector<std::string> violations(const std::string& station, const std::vector<Room>& rooms, const fs::path& file) {
    const std::string own = room_included(station, fs::relative(file, "src").generic_string());
    const Room* const room = room_named(rooms, own);
    if (room == nullptr) return {file.string() + " lies in " + own + ", which the table lacks"};
    std::vector<std::string> found;
    for (const std::string& include : includes_of(file)) {
        const std::string other = room_included(station, include);
        if (other.empty() || other == own || is_in(words_of(room->includes), other)) continue;
        found.push_back(file.string() + " includes " + include);
    }
    return found;
}

}  // namespace

TEST_CASE("every file lies in a room of its station and includes only rooms that its own may", "[layout]") {
    std::size_t files = 0;
    std::vector<std::string> found;
    for (const auto& [station, rooms] : stations) {
        for (const fs::path& file : sources_below("src/" + station)) {
            ++files;
            for (std::string& violation : violations(station, rooms, file)) found.push_back(std::move(violation));
        }
    }
    CHECK(found == std::vector<std::string>{});
    CHECK(files > 700);
}

TEST_CASE("a room includes only rooms that stand before it", "[layout]") {
    for (const auto& [station, rooms] : stations) {
        std::vector<std::string> before;
        for (const Room& room : rooms) {
            INFO(station << ": " << room.name);
            for (const std::string& other : words_of(room.includes)) CHECK(is_in(before, other));
            before.push_back(room.name);
        }
    }
}

TEST_CASE("a station of several rooms has a table of them, and every room of a table exists", "[layout]") {
    for (const auto& entry : fs::directory_iterator(root / "src")) {
        const std::string station = entry.path().filename().string();
        INFO(station);
        const auto is_folder = [](const fs::directory_entry& each) { return each.is_directory(); };
        const fs::directory_iterator rooms(entry.path());
        CHECK(stations.contains(station) == std::any_of(begin(rooms), end(rooms), is_folder));
    }
    for (const auto& [station, rooms] : stations) {
        for (const Room& room : rooms) CHECK(fs::is_directory(root / "src" / station / room.name));
    }
}

TEST_CASE("the test of rooms knows the room of an include line", "[layout]") {
    CHECK(room_included("studio", "studio/growth/spool.h") == "growth");
    CHECK(room_included("environment", "environment/light/sky/sun.h") == "light/sky");
    CHECK(room_included("turtle", "turtle/drawing.h") == ".");
    CHECK(room_included("studio", "espalier/studio/studio.h").empty());
    CHECK(room_included("studio", "fmt/format.h").empty());
}
