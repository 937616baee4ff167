// The version stands in CMakeLists.txt. What cannot read it there says the same.
#include "catch.h"
#include "sources.h"

#include <regex>

namespace {

using namespace layout;

std::string whole(const fs::path& file) {
    std::string text;
    for (const std::string& line : lines_of(file)) text += line + "\n";
    return text;
}

std::string first_group(const fs::path& file, const std::string& pattern) {
    const std::string text = whole(file);
    std::smatch found;
    INFO(file << " has no " << pattern);
    REQUIRE(std::regex_search(text, found, std::regex(pattern)));
    return found[1];
}

const char* const number = "([0-9]+[.][0-9]+[.][0-9]+)";

std::string version() {
    return first_group("CMakeLists.txt", "project\\(espalier VERSION " + std::string(number));
}

}  // namespace

TEST_CASE("Files for citations have the version of the build", "[layout][version]") {
    CHECK(first_group("CITATION.cff", "\nversion: " + std::string(number)) == version());
    CHECK(first_group("codemeta.json", "\"version\": \"" + std::string(number)) == version());
}

TEST_CASE("Recipes and the Python package have no version of their own", "[layout][version]") {
    std::size_t recipes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(root / "packaging")) {
        if (!entry.is_regular_file() || entry.path().filename() == "README.md") continue;
        INFO(entry.path());
        CHECK(whole(fs::relative(entry.path(), root)).find(version()) == std::string::npos);
        ++recipes;
    }
    CHECK(recipes >= 10);
    CHECK(whole("pyproject.toml").find("dynamic = [\"version\"]") != std::string::npos);
}

TEST_CASE("The changelog has a section of the version, or one of what is not released", "[layout][version]") {
    const std::string text = whole("CHANGELOG.md");
    const std::string newest = first_group("CHANGELOG.md", "\n## ([^\n]+)");
    INFO(newest);
    CHECK((newest.starts_with("Unreleased") || newest.starts_with(version())));
}
