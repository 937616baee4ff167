#include "catch.h"
#include "sources.h"

namespace {

using namespace layout;

bool is_foreign_giant(const std::string& include) {
    return include.starts_with("openvdb/") || (include.starts_with("vtk") && include.ends_with(".h"));
}

}  // namespace

TEST_CASE("every public header begins with a sentence that says what it is for", "[layout]") {
    for (const fs::path& file : sources_below("include")) {
        INFO(file);
        const std::vector<std::string> lines = lines_of(file);
        REQUIRE(!lines.empty());
        CHECK(lines.front().starts_with("// "));
        CHECK(std::find(lines.begin(), lines.end(), "#pragma once") != lines.end());
    }
}

TEST_CASE("public headers include neither OpenVDB nor VTK, but for the one that is for that", "[layout]") {
    for (const fs::path& file : sources_below("include")) {
        if (file == fs::path("include/espalier/geometry/openvdb_grid.h")) continue;
        for (const std::string& include : includes_of(file)) {
            INFO(file << " includes " << include);
            CHECK_FALSE(is_foreign_giant(include));
        }
    }
}

TEST_CASE("no source file is longer than 600 lines", "[layout]") {
    for (const char* folder : {"src", "include"}) {
        for (const fs::path& file : sources_below(folder)) {
            INFO(file);
            CHECK(lines_of(file).size() <= 600);
        }
    }
}

TEST_CASE("the command line parser stays with the commands", "[layout]") {
    std::size_t files = 0;
    for (const fs::path& file : sources_below("src")) {
        for (const std::string& include : includes_of(file)) {
            if (!include.starts_with("CLI/")) continue;
            INFO(file);
            CHECK(file.string().starts_with("src/app/"));
            ++files;
        }
    }
    CHECK(files > 0);
}

TEST_CASE("what stands for a file in a page has one to stand for", "[layout]") {
    std::size_t files = 0;
    for (const char* folder : {"src", "include"}) {
        for (const fs::path& file : sources_below(fs::path("web") / folder)) {
            const fs::path own = file.lexically_relative("web");
            if (folder == std::string("include") && !own.string().starts_with("include/espalier")) continue;
            INFO(file);
            CHECK(fs::exists(root / own));
            ++files;
        }
    }
    CHECK(files > 10);
}

TEST_CASE("the build description reads on two screens", "[layout]") {
    CHECK(lines_of("CMakeLists.txt").size() <= 120);
}
