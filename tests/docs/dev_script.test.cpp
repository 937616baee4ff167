// ./dev among stand-ins for the programs it calls.
#include "app/program.h"
#include "catch.h"

using Catch::Contains;

namespace {

class Machine : public Workplace {
public:
    Machine() {
        std::filesystem::create_directories(path() / "bin");
        std::filesystem::create_directories(path() / "clone");
        std::filesystem::copy_file(ESPALIER_SOURCE_DIR "/dev", path() / "clone/dev");
        program("dpkg-query", "[ \"${@: -1}\" != libvtk9-dev ] && echo installed");
        program("sudo", "exec \"$@\"");
        program("cmake", "echo cmake \"$@\" >> '" + (path() / "calls").string() + "'");
    }
    void program(const std::string& name, const std::string& lines) const {
        const auto file = write("bin/" + name, "#!/usr/bin/env bash\n" + lines + "\n");
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    }
    Outcome dev(const std::string& words) const {
        return run("--version > version && PATH=\"$PWD/bin:$PATH\" clone/dev " + words);
    }
    std::string calls() const { return std::filesystem::exists(path() / "calls") ? text_of(path() / "calls") : ""; }
};

}  // namespace

TEST_CASE_METHOD(Machine, "./dev removes no package of the user's, and says what to do instead", "[docs]") {
    program("apt-get",
            "case \"$*\" in *--simulate*) echo 'Remv python3-paraview [5.11.0]' ;; *) echo apt-get \"$@\" >> calls ;; "
            "esac");
    const Outcome outcome = dev("build");
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.err, Contains("would remove python3-paraview") && Contains("libvtk9-dev") &&
                                Contains("./dev removes nothing"));
    CHECK_THAT(calls(), !Contains("install") && !Contains("cmake"));
}

TEST_CASE_METHOD(Machine, "./dev installs what is missing where that removes nothing", "[docs]") {
    program("apt-get",
            "case \"$*\" in *--simulate*) ;; *--assume-no*) echo 'Need to get 38.9 MB of archives.'; exit 1 ;; *) echo "
            "apt-get \"$@\" >> calls ;; esac");
    const Outcome outcome = dev("build");
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("libvtk9-dev: meshes") && Contains("\n  Need to get 38.9 MB of archives.\n"));
    CHECK_THAT(calls(), Contains("apt-get install") && Contains("--no-remove") && Contains("libvtk9-dev") &&
                            Contains("cmake --build"));
}

TEST_CASE_METHOD(Machine, "./dev run needs no VTK and builds what grows alone, several files at once", "[docs]") {
    program("apt-get", "echo apt-get \"$@\" >> calls");
    std::filesystem::create_directories(path() / "clone/build/release");
    const auto grown = path() / "clone/build/release/espalier";
    std::ofstream(grown) << "#!/bin/sh\necho grown \"$@\"\n";
    std::filesystem::permissions(grown, std::filesystem::perms::owner_all);
    const Outcome outcome = dev("run scene.toml");
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.out, Contains("grown run scene.toml"));
    CHECK_THAT(outcome.err, Contains("a first run compiles") && Contains(" MB") && Contains("next: open plants.pvd") &&
                                Contains("./dev build makes the commands that look"));
    CHECK_THAT(calls(), !Contains("apt-get") && Contains("-DESPALIER_LOOK=OFF") && Contains("-DESPALIER_UNITY=ON") &&
                            Contains("--target espalier_program"));
    // Where the commands that look are built already, they are kept up to date.
    std::ofstream(path() / "clone/build/release/CMakeCache.txt") << "";
    std::ofstream(path() / "clone/build/release/libespalier_look_commands.so") << "";
    std::filesystem::remove(path() / "calls");
    const Outcome second = dev("run scene.toml --output there");
    CHECK(second.code == 0);
    CHECK_THAT(second.err, !Contains("first run") && Contains("espalier view there"));
    CHECK_THAT(calls(), Contains("-DESPALIER_LOOK=ON") && !Contains("UNITY") && Contains("espalier_look_commands"));
}

namespace {

/// Whether `./dev new` with these words made something in `clone`; what it said is in the file `said`.
bool made(const std::filesystem::path& clone, const std::filesystem::path& said, const std::string& words) {
    const std::string command =
        ESPALIER_SOURCE_DIR "/packaging/new-part " + words + " '" + clone.string() + "' >'" + said.string() + "' 2>&1";
    return std::system(command.c_str()) == 0;
}

}  // namespace

TEST_CASE_METHOD(Workplace, "./dev new writes the frame of a process once, and only of a name that can be one",
                 "[docs]") {
    namespace fs = std::filesystem;
    const fs::path clone = path() / "clone", said = path() / "said";
    for (const char* folder : {"src/environment/light", "tests/environment/light", "docs/examples"}) {
        fs::create_directories(clone / folder);
    }
    for (const char* page : {"docs/clusters.md", "docs/environment-processes.md"}) {
        fs::copy_file(fs::path(ESPALIER_SOURCE_DIR) / page, clone / page);
    }
    for (const char* words : {"wind-sway", "air/wind-sway", "light/Wind", "light/../wind", "light/wind-"}) {
        CHECK_FALSE(made(clone, said, std::string("process ") + words));
        CHECK_THAT(text_of(said), Contains("is not SUBJECT/NAME"));
    }
    REQUIRE(made(clone, said, "process light/wind-sway"));
    CHECK_THAT(text_of(clone / "src/environment/light/wind_sway.cpp"), Contains("class WindSway final"));
    CHECK_THAT(text_of(clone / "tests/environment/light/wind_sway.test.cpp"), Contains("\"wind-sway\""));
    CHECK_THAT(text_of(clone / "docs/examples/wind_sway.toml"), Contains("process = \"wind-sway\""));
    CHECK_THAT(text_of(clone / "docs/clusters.md"), Contains("| `wind-sway` | nothing |"));
    CHECK_THAT(text_of(clone / "docs/environment-processes.md"), Contains("reference/processes/wind-sway.md"));
    CHECK_FALSE(made(clone, said, "process light/wind-sway"));
    CHECK_THAT(text_of(said), Contains("exists already"));
}

TEST_CASE_METHOD(Workplace, "./dev new writes the frames of the other parts", "[docs]") {
    namespace fs = std::filesystem;
    const fs::path clone = path() / "clone", said = path() / "said";
    for (const char* folder :
         {"src/turtle/stages", "src/turtle/symbols", "src/timeline/recorders", "src/formats/exporters",
          "tests/turtle/stages", "tests/timeline", "tests/formats", "docs/examples"}) {
        fs::create_directories(clone / folder);
    }
    for (const char* words : {"stage Wind", "symbol half-turn @@@", "symbol half-turn", "recorder si-zes",
                              "exporter ..", "notation x", ""}) {
        INFO(words);
        CHECK_FALSE(made(clone, said, words));
    }
    REQUIRE(made(clone, said, "stage wind-sway"));
    REQUIRE(made(clone, said, "symbol half-turn @h"));
    REQUIRE(made(clone, said, "recorder sizes"));
    REQUIRE(made(clone, said, "exporter csv3d"));
    CHECK_THAT(text_of(clone / "src/turtle/stages/wind_sway.cpp"), Contains("class WindSwayStage final"));
    CHECK_THAT(text_of(clone / "docs/examples/wind-sway.toml"), Contains("stage = \"wind-sway\""));
    CHECK_THAT(text_of(clone / "src/turtle/symbols/half_turn.cpp"), Contains("\"@h\""));
    CHECK_THAT(text_of(clone / "src/timeline/recorders/sizes.cpp"), Contains("\"sizes.csv\""));
    CHECK_THAT(text_of(clone / "tests/formats/csv3d.test.cpp"), Contains("Exported exported(\"csv3d\")"));
}
