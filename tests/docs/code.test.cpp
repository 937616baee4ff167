// The C++ of the pages on extending Espalier compiles where the page says it belongs.
#include "catch.h"
#include "page.h"
#include "temporary_folder.h"

#include <nlohmann/json.hpp>

#include <iterator>

namespace {

using namespace pages;

/// A file, or one that compiles it together with others.
bool compiles(const fs::path& unit, const std::string& source) {
    if (unit.string().ends_with(source)) return true;
    if (unit.parent_path().filename() != "Unity") return false;
    std::ifstream file(unit);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    return text.find("/" + source + "\"") != std::string::npos;
}

/// How a file is compiled, with another file in its place and nothing written.
std::string check_of(const std::string& source, const fs::path& instead) {
    std::ifstream file(ESPALIER_BUILD_DIR "/compile_commands.json");
    for (const auto& entry : nlohmann::json::parse(file)) {
        std::string command = entry["command"].get<std::string>();
        if (!compiles(entry["file"].get<std::string>(), source)) continue;
        command.erase(command.find(" -o "));
        return "cd '" + entry["directory"].get<std::string>() + "' && " + command + " -fsyntax-only -I '" +
               (root / fs::path(source).parent_path()).string() + "' '" + instead.string() + "'";
    }
    throw std::runtime_error("nothing compiles " + source);
}

std::string source_of(const Block& block) {
    std::string text;
    for (const std::string& line : block.lines) text += line + "\n";
    return text;
}

std::vector<std::string> cpp_of(const fs::path& page) {
    std::vector<std::string> texts;
    for (const Block& block : blocks_of(page)) {
        if (block.language == "cpp") texts.push_back(source_of(block));
    }
    return texts;
}

/// Compiles a text as if it were the file; "" or what the compiler says.
std::string complaints(const std::string& text, const std::string& source) {
    const TemporaryFolder folder;
    folder.write("page.cpp", text);
    const fs::path log = folder.path() / "log";
    const std::string command = check_of(source, folder.path() / "page.cpp") + " >'" + log.string() + "' 2>&1";
    const int status = std::system(command.c_str());
    std::ifstream in(log);
    const std::string said(std::istreambuf_iterator<char>(in), {});
    return status == 0 ? "" : said + command;
}

}  // namespace

TEST_CASE("the symbol of the page on the turtle compiles in the file that the page names", "[docs]") {
    const std::string source = "src/turtle/symbols/rotation.cpp";
    std::string text;
    for (const std::string& line : lines_of(source)) text += line + "\n";
    const std::vector<std::string> code = cpp_of("docs/turtle.md");
    REQUIRE(code.size() == 1);
    text.insert(text.find("}  // namespace\n"), code[0]);
    CHECK(complaints(text, source) == "");
}

TEST_CASE("the process of the page on processes compiles, and so does its test", "[docs]") {
    const std::vector<std::string> code = cpp_of("docs/environment-processes.md");
    REQUIRE(code.size() == 2);
    CHECK(complaints(code[0], "src/environment/space/honda81.cpp") == "");
    CHECK(complaints(code[1], "tests/environment/exchange/environment.test.cpp") == "");
}

TEST_CASE("the recorder of the page on timelines compiles", "[docs]") {
    const std::vector<std::string> code = cpp_of("docs/timeline.md");
    REQUIRE(code.size() == 1);
    CHECK(complaints(code[0], "src/timeline/recorders/statistics.cpp") == "");
}
