// The library as another project sees it: installed into a scratch prefix, found by CMake and pkg-config, and used by
// the examples of docs/library.md.
#include "catch.h"
#include "docs/page.h"
#include "temporary_folder.h"

#include <fstream>
#include <sys/wait.h>

namespace {

using namespace pages;

/// What a shell command printed, and how it ended.
struct Outcome {
    int code = 0;
    std::string text;
};

Outcome shell(const std::string& command, const fs::path& folder) {
    const TemporaryFolder logs;
    const fs::path log = logs.path() / "log";
    const std::string line = "cd '" + folder.string() + "' && { " + command + "; } >'" + log.string() + "' 2>&1";
    const int status = std::system(line.c_str());
    return {WEXITSTATUS(status), text_of(log)};
}

void require_done(const Outcome& outcome) {
    INFO(outcome.text);
    REQUIRE(outcome.code == 0);
}

/// The tree that `cmake --install` leaves. It is moved once it is there: nothing may remember where it was.
class Installed {
public:
    static const Installed& once() {
        static const Installed installed;
        return installed;
    }
    const fs::path& prefix() const { return prefix_; }
    fs::path folder() const { return folder_.path(); }
    std::string program() const { return (prefix_ / "bin/espalier").string(); }

    /// The folder of shared libraries, whatever the system calls it.
    fs::path libraries() const {
        for (const auto& entry : fs::recursive_directory_iterator(prefix_)) {
            if (entry.path().filename() == "libespalier.so") return entry.path().parent_path();
        }
        return {};
    }

private:
    Installed() : prefix_(folder_.path() / "prefix") {
        const fs::path first = folder_.path() / "first";
        require_done(
            shell(std::string(ESPALIER_CMAKE) + " --install '" ESPALIER_BUILD_DIR "' --prefix '" + first.string() + "'",
                  folder_.path()));
        fs::rename(first, prefix_);
    }

    TemporaryFolder folder_;
    fs::path prefix_;
};

/// The files of the page's examples, each named in the sentence before it, and what their programs print.
struct Examples {
    std::map<std::string, std::string> files, printed;
};

std::string text_of_lines(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

Examples examples() {
    static const std::regex file_name(R"(`(\w+\.(cpp|txt))`)");
    Examples examples;
    const fs::path page = "docs/library.md";
    const std::vector<std::string> lines = lines_of(page);
    std::string name;
    std::size_t line = 0;
    for (const Block& block : blocks_of(page)) {
        for (; line + 1 < block.first_line; ++line) {
            std::smatch found;
            if (std::regex_search(lines[line], found, file_name)) name = found[1];
        }
        line = block.first_line + block.lines.size();
        if (block.language == "cmake") examples.files["CMakeLists.txt"] += text_of_lines(block.lines);
        if (block.language == "cpp") examples.files[name] = text_of_lines(block.lines);
        if (block.language == "text") examples.printed[fs::path(name).stem().string()] = text_of_lines(block.lines);
    }
    return examples;
}

}  // namespace

TEST_CASE("the examples of the manual build against an installed library and print what the manual shows",
          "[library]") {
    const Installed& installed = Installed::once();
    const TemporaryFolder project;
    const Examples page = examples();
    REQUIRE(page.printed.size() == 5);
    const fs::path sources = installed.prefix() / "share/espalier/docs/examples/library";
    for (const auto& [name, text] : page.files) {
        INFO(name);
        CHECK((name == "CMakeLists.txt" || text == text_of(sources / name)));
    }
    require_done(shell(std::string(ESPALIER_CMAKE) + " -S '" + sources.string() + "' -B build -DCMAKE_PREFIX_PATH='" +
                           installed.prefix().string() + "' && " ESPALIER_CMAKE " --build build --parallel 2",
                       project.path()));
    require_done(shell("'" + installed.program() + "' run models/course/02-branching.l --steps 3 --output run --quiet",
                       project.path()));
    for (const auto& [program, printed] : page.printed) {
        INFO(program);
        const Outcome outcome = shell("build/" + program + " run", project.path());
        CHECK(outcome.code == 0);
        CHECK(outcome.text == printed);
    }
}

TEST_CASE("pkg-config knows what a program needs", "[library]") {
    const Installed& installed = Installed::once();
    const TemporaryFolder project;
    project.write("sizes.cpp", examples().files.at("sizes.cpp"));
    const std::string libraries = installed.libraries().string();
    require_done(shell("PKG_CONFIG_PATH='" + libraries +
                           "/pkgconfig' && export PKG_CONFIG_PATH && " ESPALIER_CXX
                           " sizes.cpp -o sizes $(pkg-config --cflags --libs espalier)",
                       project.path()));
    const Outcome outcome = shell("env -u LD_LIBRARY_PATH ./sizes", project.path());
    CHECK(outcome.text == examples().printed.at("sizes"));
}

TEST_CASE("a process of the manual works in one's own program", "[library]") {
    const Installed& installed = Installed::once();
    const TemporaryFolder project;
    for (const Block& block : blocks_of("docs/environment-processes.md")) {
        if (block.language != "cpp") continue;
        project.write("height.cpp", text_of_lines(block.lines));
        break;
    }
    project.write("main.cpp", R"(#include <espalier/simulation/world.h>
#include <cstdio>
int main() {
    espalier::Scene scene;
    scene.plants.push_back(espalier::plant_of_text("environment up;\nlsystem: 1\naxiom: F(2)?up(0)\nendlsystem\n"));
    scene.environment.add("up", "height", {{"ground", -1}});
    espalier::World world(scene);
    world.start();
    std::printf("%g\n", world.string(0).parameters[1]);
})");
    project.write("CMakeLists.txt",
                  "cmake_minimum_required(VERSION 3.25)\nproject(up LANGUAGES CXX)\nfind_package(Espalier REQUIRED)\n"
                  "add_executable(up main.cpp height.cpp)\ntarget_link_libraries(up Espalier::espalier)\n");
    require_done(shell(std::string(ESPALIER_CMAKE) + " -S . -B build -DCMAKE_PREFIX_PATH='" +
                           installed.prefix().string() + "' && " ESPALIER_CMAKE " --build build",
                       project.path()));
    CHECK(shell("build/up", project.path()).text == "3\n");
}

TEST_CASE("a process with a field links Espalier::grids in one's own program", "[library]") {
    const Installed& installed = Installed::once();
    const TemporaryFolder project;
    project.write("mist.cpp", R"(#include <espalier/geometry/openvdb_grid.h>
#include <espalier/simulation/world.h>
#include <cstdio>
using namespace espalier;

// Its field is 0.25 in one voxel; a query is answered the sum of the field.
class Mist final : public EnvironmentProcess {
public:
    Mist(Settings&, const EnvironmentContext& context, Fields& fields) {
        initialize_openvdb();
        field_.grid = openvdb::FloatGrid::create();
        field_.grid->setTransform(cell_centred_transform(0.5, {0, 0, 0}));
        field_.grid->tree().setValue({1, 2, 3}, 0.25f);
        static_cast<void>(context), static_cast<void>(fields);
    }
    void answer(const WorldView&, Queries, std::span<Answer> answers, Fields&) override {
        double sum = 0;
        for (auto value = field_.grid->cbeginValueOn(); value; ++value) sum += *value;
        for (Answer answer : answers) answer[0] = sum;
    }
    std::pair<int, int> query_arity() const override { return {1, 1}; }

private:
    FieldGrid field_;
};
const Registered<ProcessType> entry{{"mist", "mist", "mist", construct<Mist>}};

int main() {
    Scene scene;
    scene.plants.push_back(plant_of_text("environment air;\nlsystem: 1\naxiom: F(2)?air(0)\nendlsystem\n"));
    scene.environment.add("air", "mist");
    World world(scene);
    world.start();
    std::printf("%g\n", world.string(0).parameters[1]);
})");
    project.write("CMakeLists.txt",
                  "cmake_minimum_required(VERSION 3.25)\nproject(mist LANGUAGES CXX)\n"
                  "find_package(Espalier REQUIRED COMPONENTS grids)\nadd_executable(mist mist.cpp)\n"
                  "target_link_libraries(mist Espalier::grids)\n");
    require_done(shell(std::string(ESPALIER_CMAKE) + " -S . -B build -DCMAKE_PREFIX_PATH='" +
                           installed.prefix().string() + "' && " ESPALIER_CMAKE " --build build",
                       project.path()));
    CHECK(shell("build/mist", project.path()).text == "0.25\n");
}

TEST_CASE("the program of the page on charts draws a run", "[library]") {
    const Installed& installed = Installed::once();
    const TemporaryFolder project;
    for (const Block& block : blocks_of("docs/plots.md")) {
        if (block.language == "cpp") project.write("draw.cpp", text_of_lines(block.lines));
    }
    project.write("CMakeLists.txt",
                  "cmake_minimum_required(VERSION 3.25)\nproject(draw LANGUAGES CXX)\n"
                  "find_package(Espalier REQUIRED COMPONENTS look)\nadd_executable(draw draw.cpp)\n"
                  "target_link_libraries(draw Espalier::look)\n");
    require_done(
        shell(std::string(ESPALIER_CMAKE) + " -S . -B build -DCMAKE_PREFIX_PATH='" + installed.prefix().string() +
                  "' && " ESPALIER_CMAKE " --build build && '" + installed.program() +
                  "' run environments/lone-tree.toml --steps 2 --output output/two-trees --quiet && build/draw",
              project.path()));
    CHECK(text_of(project.path() / "two-trees.svg").find("height") != std::string::npos);
}

TEST_CASE("the licence, the manual and its scripts are installed", "[library]") {
    const fs::path& prefix = Installed::once().prefix();
    CHECK(text_of(prefix / "share/doc/espalier/LICENSE") == text_of(root / "LICENSE"));
    CHECK(text_of(prefix / "share/espalier/docs/README.md") == text_of(root / "docs/README.md"));
    CHECK(text_of(prefix / "share/espalier/docs/sweep.slurm") == text_of(root / "docs/sweep.slurm"));
}

TEST_CASE("the installed program finds its models and environments wherever it is started", "[library]") {
    const Installed& installed = Installed::once();
    const TemporaryFolder elsewhere;
    const Outcome models = shell("'" + installed.program() + "' list models", elsewhere.path());
    CHECK(models.code == 0);
    CHECK(models.text.find((installed.prefix() / "share/espalier/models").string()) != std::string::npos);
    require_done(shell("'" + installed.program() + "' run environments/lone-tree.toml --steps 2 --output run",
                       elsewhere.path()));
    CHECK(fs::exists(elsewhere.path() / "run/plants/0002.vtp"));
}

TEST_CASE("what is installed does not know where it was built", "[library]") {
    const Installed& installed = Installed::once();
    // As a path of its own: a clone at /espalier is no part of share/espalier.
    const auto files_with = [&](const std::string& path) {
        const std::string pattern = "(?<![\\w.~-])\\Q" + path + "\\E(?![\\w-])";
        return shell("LC_ALL=C grep -rlP '" + pattern + "' .", installed.prefix()).text;
    };
    for (const char* path : {ESPALIER_BUILD_DIR, ESPALIER_SOURCE_DIR "/src", ESPALIER_SOURCE_DIR "/include"}) {
        CHECK(files_with(path) == "");
    }
    std::ofstream(installed.prefix() / "share/espalier/left-behind") << "'" ESPALIER_BUILD_DIR "/main.cpp'\n";
    CHECK_THAT(files_with(ESPALIER_BUILD_DIR), Catch::Contains("left-behind"));
    fs::remove(installed.prefix() / "share/espalier/left-behind");
}

TEST_CASE("the growing half is configured on a machine without VTK", "[library]") {
    const TemporaryFolder build;
    require_done(shell(std::string(ESPALIER_CMAKE) +
                           " -S '" ESPALIER_SOURCE_DIR "' -B . -G Ninja -DESPALIER_LOOK=OFF "
                           "-DCMAKE_DISABLE_FIND_PACKAGE_VTK=ON -DCMAKE_EXPORT_COMPILE_COMMANDS=ON",
                       build.path()));
    const std::string commands = text_of(build.path() / "compile_commands.json");
    CHECK(commands.find("src/simulation/world/world.cpp") != std::string::npos);
    CHECK(commands.find("src/app/main.cpp") != std::string::npos);
    CHECK(commands.find("src/picture/") == std::string::npos);
    CHECK(commands.find("/vtk-") == std::string::npos);  // the folder of its headers
}

TEST_CASE("the program and the core are loaded without OpenVDB", "[library]") {
    const Installed& installed = Installed::once();
    for (const std::string& file : {installed.program(), (installed.libraries() / "libespalier_core.so").string()}) {
        const Outcome loaded = shell("ldd '" + file + "'", installed.folder());
        INFO(file);
        REQUIRE(loaded.code == 0);
        CHECK(loaded.text.find("libtbb") != std::string::npos);
        CHECK(loaded.text.find("libopenvdb") == std::string::npos);
        CHECK(loaded.text.find("libespalier.so") == std::string::npos);
    }
}

TEST_CASE("the growing library is loaded without VTK and X11", "[library]") {
    const Outcome loaded = shell("ldd libespalier.so", Installed::once().libraries());
    REQUIRE(loaded.code == 0);
    CHECK(loaded.text.find("libopenvdb") != std::string::npos);
    for (const char* library : {"libvtk", "libX11", "libxcb", "libGL"}) {
        INFO(library);
        CHECK(loaded.text.find(library) == std::string::npos);
    }
}
