// Numbers as no author writes them: each number of the files that models are read from and drawn with is, in turn, far
// too large, too small, negative or none. Whatever reads them ends soon and within its memory, in growth or in words.
#include "espalier/base/read_log.h"
#include "espalier/simulation/object.h"
#include "espalier/simulation/simulation.h"

#include "catch.h"
#include "temporary_folder.h"

#include <array>
#include <cctype>
#include <chrono>
#include <string_view>

using namespace espalier;
namespace fs = std::filesystem;

namespace {

constexpr std::array giants{"1e308",      "-1e308",      "1e18", "1000000000000000000",
                            "2147483647", "-2147483648", "-1",   "0.000000001",
                            "0",          "nan",         "inf"};
constexpr int steps = 3;
#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t kept_by_sanitizer = std::size_t{1} << 30;  // freed memory, for a while
#else
constexpr std::size_t kept_by_sanitizer = 0;
#endif
constexpr std::size_t memory = std::size_t{64} << 20, most_memory = (std::size_t{1} << 30) + kept_by_sanitizer;
constexpr std::chrono::seconds most_time{20};

const fs::path project = ESPALIER_SOURCE_DIR;
const fs::path seeds = project / "tests/fuzz/seeds";

struct Number {
    std::size_t at, length;
};

/// The numbers of a text, without those that belong to names.
std::vector<Number> numbers_in(std::string_view text) {
    const auto is_part_of = [&](std::size_t at, std::string_view more) {
        return at < text.size() &&
               (std::isdigit(static_cast<unsigned char>(text[at])) || more.find(text[at]) != more.npos);
    };
    std::vector<Number> numbers;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const bool in_name = at > 0 && (std::isalnum(static_cast<unsigned char>(text[at - 1])) || text[at - 1] == '_');
        if (in_name || !is_part_of(at, "")) continue;
        std::size_t end = at;
        while (is_part_of(end, ".")) ++end;
        numbers.push_back({at, end - at});
        at = end;
    }
    return numbers;
}

/// The models that stand with files of numbers, and those written in other notations.
std::vector<ObjectFiles> objects(const TemporaryFolder& folder) {
    std::vector<ObjectFiles> all;
    for (const char* const name : {"species", "pgraph", "sdl"}) {
        for (const auto& entry : fs::directory_iterator(project / "models" / name)) {
            if (entry.path().extension() == ".md" || entry.path().extension() == ".v") continue;
            ObjectFiles& object = all.emplace_back();
            object.model = entry.path();
            const fs::path view = fs::path(entry.path()).replace_extension(".v");
            if (fs::exists(view)) object.view = view;
        }
    }
    const auto add = [&](const fs::path& model, const fs::path& view) {
        ObjectFiles& object = all.emplace_back();
        object.model = model;
        object.view = view;
        object.folder = project / "models/organs";
        object.animation = seeds / "plant.a";
    };
    for (const char* const name : {"organs/flower", "organs/shoot", "organs/trunk", "trees/maple", "trees/ternary",
                                   "trees/weeping", "language/shoot/shoot", "language/spiral/liana"}) {
        add(project / "models" / (name + std::string(".l")), project / "models" / (name + std::string(".v")));
    }
    const auto drawing = [](const std::string& module) {
        return "lsystem: 1\nderivation length: 1\naxiom: ~l@#(1)F(1)@!(3)F(2)~p(2)@Tx(1);F\nF(x) --> " + module +
               "~r+F(x)~l\nendlsystem\n";
    };
    add(folder.write("seeds.l", drawing("F(x)")), seeds / "plant.v");
    const std::string view =
        "tsurface: r leaf.ray 1\nfunction: hill.func\nfunction: old.func 10\nfunction set: hills.fset\n"
        "tsurface: l ../../../environments/meshes/house.obj 1\nbackground scene: room.bg\n";
    add(folder.write("all.l", drawing("F(func(1,x)+func(2,x))")), folder.write("all.v", view));
    all.back().folder = seeds;
    return all;
}

/// What is read to grow the object, but no model: their numbers are the author's own, and tried by the fuzzer.
std::map<fs::path, std::string> attacked_files(const ObjectFiles& object) {
    const ReadLog log;
    try {
        scene_of_object(object);
    } catch (const UserError& error) {
        FAIL(error.what());
    }
    std::map<fs::path, std::string> files;
    for (const auto& [path, file] : log.files()) {
        if (path.extension() != ".l" && path.extension() != ".map") files.emplace(path, file.bytes);
    }
    return files;
}

/// Grows it with a text in the place of a file.
void grow(const ObjectFiles& object, const fs::path& file, const std::string& text, const fs::path& output) {
    const ReadLog log(0, {{file, text}});
    RunOptions options;
    options.output = output;
    options.overwrite = true;
    options.memory = memory;
    options.disk = memory;
    const auto begin = std::chrono::steady_clock::now();
    try {
        const Scene scene = scene_of_object(object, {{}, steps, {}});
        run(scene, options);
    } catch (const UserError& error) {
        CHECK_FALSE(std::string_view(error.what()).empty());
    } catch (const RunError& error) {
        CHECK_FALSE(std::string_view(error.what()).empty());
    }
    CHECK(std::chrono::steady_clock::now() - begin < most_time);
    CHECK(peak_memory() < most_memory);
}

/// Each number of every file becomes the giants whose place in their list, counted on from number to number, is told.
void attack(int giants_per_number) {
    const TemporaryFolder folder;
    std::size_t tried = 0, numbers = 0;
    for (const ObjectFiles& object : objects(folder)) {
        for (const auto& [file, text] : attacked_files(object)) {
            for (const Number number : numbers_in(text)) {
                for (int k = 0; k < giants_per_number; ++k) {
                    const char* const giant = giants[tried++ % giants.size()];
                    const std::string other =
                        text.substr(0, number.at) + giant + text.substr(number.at + number.length);
                    INFO(file.string() << ": " << giant << " at byte " << number.at);
                    grow(object, file, other, folder.path() / "out");
                }
                ++numbers;
            }
        }
    }
    CHECK(numbers > 2000);
}

}  // namespace

TEST_CASE("a number far out of place in a file ends in growth or in words", "[simulation]") {
    attack(1);
}

TEST_CASE("every number far out of place in a file ends in growth or in words", "[.thorough]") {
    attack(static_cast<int>(giants.size()));
}
