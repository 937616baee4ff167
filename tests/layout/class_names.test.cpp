// Two classes of one name in one namespace break the one-definition rule, and no linker says so.
#include "catch.h"
#include "sources.h"

#include <map>
#include <regex>
#include <set>

namespace {

using namespace layout;

/// Classes that a file defines at namespace scope, "espalier::turtle::Walk". A class of an unnamed namespace belongs to
/// its file alone and is left out.
std::vector<std::string> classes_of(const std::vector<std::string>& lines) {
    static const std::regex opens(R"(^(?:inline )?namespace(?: ([\w:]+))? \{)");
    static const std::regex closes(R"(^\}  // namespace)");
    static const std::regex defines(R"(^(?:class|struct) (\w+)(?: final)?(?: :.*|) ?\{)");
    std::vector<std::string> names, scopes;
    for (const std::string& line : lines) {
        std::smatch match;
        if (std::regex_search(line, match, opens)) {
            scopes.push_back(match[1]);
        } else if (std::regex_search(line, closes) && !scopes.empty()) {
            scopes.pop_back();
        } else if (std::regex_search(line, match, defines) &&
                   std::find(scopes.begin(), scopes.end(), "") == scopes.end()) {
            std::string name;
            for (const std::string& scope : scopes) name += scope + "::";
            names.push_back(name + match[1].str());
        }
    }
    return names;
}

}  // namespace

TEST_CASE("no two files define a class of the same name in the same namespace", "[layout]") {
    std::map<std::string, std::set<std::string>> files_of;
    for (const char* folder : {"src", "include"}) {
        for (const fs::path& file : sources_below(folder)) {
            for (const std::string& name : classes_of(lines_of(file))) files_of[name].insert(file.string());
        }
    }
    CHECK(files_of.size() > 300);
    for (const auto& [name, files] : files_of) {
        INFO(name);
        CHECK(files.size() == 1);
    }
}

TEST_CASE("the code of every station lies in the station's namespace", "[layout]") {
    for (const fs::path folder : {"src", "include/espalier"}) {
        for (const fs::path& file : sources_below(folder)) {
            const fs::path below = file.lexically_relative(folder);
            const std::string station = below.begin()->string();
            if (station == "base") continue;  // its names are the vocabulary of all stations
            INFO(file.string());
            const std::string opening = "namespace espalier::" + station;
            const auto lines = lines_of(file);
            CHECK(std::any_of(lines.begin(), lines.end(),
                              [&](const std::string& line) { return line.starts_with(opening); }));
        }
    }
}

TEST_CASE("the reader of class names knows namespaces, final classes and bases", "[layout]") {
    const std::vector<std::string> lines{"namespace espalier::view {",
                                         "class Painter {",
                                         "};",
                                         "struct Reader final : Base {",
                                         "};",
                                         "class Forward;",
                                         "namespace {",
                                         "class Hidden {",
                                         "};",
                                         "}  // namespace",
                                         "    struct Nested {",
                                         "    };",
                                         "}  // namespace espalier::view"};
    CHECK(classes_of(lines) == std::vector<std::string>{"espalier::view::Painter", "espalier::view::Reader"});
}
