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
    program("apt-get", "case \"$*\" in *--simulate*) ;; *) echo apt-get \"$@\" >> calls ;; esac");
    CHECK(dev("build").code == 0);
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
    CHECK_THAT(calls(), !Contains("apt-get") && Contains("-DESPALIER_LOOK=OFF") && Contains("-DESPALIER_UNITY=ON") &&
                            Contains("--target espalier_program"));
    // Where the commands that look are built already, they are kept up to date.
    std::ofstream(path() / "clone/build/release/CMakeCache.txt") << "";
    std::ofstream(path() / "clone/build/release/libespalier_look_commands.so") << "";
    std::filesystem::remove(path() / "calls");
    CHECK(dev("run scene.toml").code == 0);
    CHECK_THAT(calls(), Contains("-DESPALIER_LOOK=ON") && !Contains("UNITY") && Contains("espalier_look_commands"));
}

TEST_CASE_METHOD(Workplace, "./dev new writes the frame of a process once, and only of a name that can be one",
                 "[docs]") {
    namespace fs = std::filesystem;
    const fs::path clone = path() / "clone";
    for (const char* folder : {"src/environment/light", "tests/environment/light", "docs/examples"}) {
        fs::create_directories(clone / folder);
    }
    for (const char* page : {"docs/clusters.md", "docs/environment-processes.md"}) {
        fs::copy_file(fs::path(ESPALIER_SOURCE_DIR) / page, clone / page);
    }
    const auto made = [&](const std::string& words) {
        return std::system((ESPALIER_SOURCE_DIR "/packaging/new-part process " + words + " '" + clone.string() +
                            "' >'" + (path() / "said").string() + "' 2>&1")
                               .c_str());
    };
    for (const char* words : {"wind-sway", "air/wind-sway", "light/Wind", "light/../wind", "light/wind-"}) {
        CHECK(made(words) != 0);
        CHECK_THAT(text_of(path() / "said"), Contains("is not SUBJECT/NAME"));
    }
    REQUIRE(made("light/wind-sway") == 0);
    CHECK_THAT(text_of(clone / "src/environment/light/wind_sway.cpp"), Contains("class WindSway final"));
    CHECK_THAT(text_of(clone / "tests/environment/light/wind_sway.test.cpp"), Contains("\"wind-sway\""));
    CHECK_THAT(text_of(clone / "docs/examples/wind_sway.toml"), Contains("process = \"wind-sway\""));
    CHECK_THAT(text_of(clone / "docs/clusters.md"), Contains("| `wind-sway` | nothing |"));
    CHECK_THAT(text_of(clone / "docs/environment-processes.md"), Contains("reference/processes/wind-sway.md"));
    CHECK(made("light/wind-sway") != 0);
    CHECK_THAT(text_of(path() / "said"), Contains("exists already"));
}
