// `espalier studio` as a program: its address, its end, its mistakes.
#include "catch.h"
#include "program.h"

#include <cstdlib>
#include <filesystem>
#include <set>

using Catch::Contains;
namespace fs = std::filesystem;

TEST_CASE("studio prints an address with a token, and ends when it is asked to", "[app]") {
    for (const int signal : {SIGINT, SIGTERM}) {
        const Workplace place;
        place.write("stalk.l", "lsystem: 1\nderivation length: 3\naxiom: A\nA --> F(1)A\nendlsystem\n");
        const auto printed = [&] { return text_of(place.path() / ".out").find("/#token=") != std::string::npos; };
        const Outcome outcome =
            place.run_until({"studio", "--no-browser", "stalk.l"}, printed, [&](pid_t child) { kill(child, signal); });
        CHECK(outcome.code == 0);
        CHECK_THAT(outcome.out, Contains("http://127.0.0.1:"));
    }
}

TEST_CASE("what a killed studio leaves is its owner's alone, and the next one removes it", "[app]") {
    const Workplace place;
    place.write("stalk.l", "lsystem: 1\nderivation length: 3\naxiom: A\nA --> F(1)A\nendlsystem\n");
    const fs::path temporary = place.path() / "temporary";
    fs::create_directories(temporary / "espalier-studio-mine/files");
    const auto left = [&] {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(temporary)) names.insert(entry.path().filename().string());
        return names;
    };
    setenv("TMPDIR", temporary.c_str(), 1);
    const auto end_by = [&](int signal) {
        fs::remove(place.path() / ".out");
        const auto printed = [&] { return text_of(place.path() / ".out").find("/#token=") != std::string::npos; };
        place.run_until({"studio", "--no-browser", "stalk.l"}, printed, [&](pid_t child) {
            for (const auto& entry : fs::directory_iterator(temporary)) {
                if (entry.path().filename() == "espalier-studio-mine") continue;
                CHECK((entry.status().permissions() & (fs::perms::group_all | fs::perms::others_all)) ==
                      fs::perms::none);
            }
            kill(child, signal);
        });
    };
    end_by(SIGKILL);
    CHECK(left().size() == 2);
    end_by(SIGINT);
    CHECK(left() == std::set<std::string>{"espalier-studio-mine"});
    unsetenv("TMPDIR");
}

TEST_CASE("studio says what it cannot open", "[app]") {
    const Workplace place;
    CHECK_THAT(place.run("studio --no-browser nothing.l").err, Contains("nothing.l does not exist"));
    CHECK_THAT(place.run("studio --no-browser --folder nowhere").err, Contains("nowhere does not exist"));
    CHECK(place.run("studio --no-browser --port 99999").code == 1);
}
