// Two classes of one name in one namespace break the one-definition rule, and no linker says so. The sources tell in
// which files a class is defined. The compiled objects tell two things more: that no class escaped the reading of the
// sources, and that each class has the same virtual functions and bases wherever it was compiled. What objects alone
// cannot tell is whether functions of one name, which each object has for itself, came from one header or from two
// sources.
#include "catch.h"
#include "sources.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <sstream>

namespace {

using namespace layout;

/// Classes that a file defines at namespace scope, "espalier::turtle::Walk". A class of an unnamed namespace belongs to
/// its file alone and is left out.
std::vector<std::string> classes_of(const std::vector<std::string>& lines) {
    static const std::regex opens(R"(^(?:inline )?namespace(?: ([\w:]+))? \{)");
    static const std::regex closes(R"(^\}  // namespace)");
    static const std::regex defines(R"(^(?:class|struct) (\w+)(?: final)?(?: :.*|) ?\{)");
    std::vector<std::string> names, scopes;
    std::size_t opened = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string& line = lines[i];
        const bool closes_one_line = line == "}" && i == opened + 2;  // clang-format gives it no comment
        std::smatch match;
        if (std::regex_search(line, match, opens)) {
            scopes.push_back(match[1]);
            opened = i;
        } else if ((closes_one_line || std::regex_search(line, closes)) && !scopes.empty()) {
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

std::map<std::string, std::set<std::string>> files_of_classes() {
    std::map<std::string, std::set<std::string>> files_of;
    for (const char* folder : {"src", "include"}) {
        for (const fs::path& file : sources_below(folder)) {
            for (const std::string& name : classes_of(lines_of(file))) files_of[name].insert(file.string());
        }
    }
    return files_of;
}

/// What `nm` prints of files; nothing where it is not installed.
std::vector<std::string> symbols(const std::string& options, const std::string& files) {
    const std::string command = "nm --defined-only " + options + " " + files + " 2>/dev/null";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> output(popen(command.c_str(), "r"), pclose);
    std::vector<std::string> lines(1);
    for (int c = 0; output && (c = std::fgetc(output.get())) != EOF;) {
        if (c == '\n') {
            lines.emplace_back();
        } else {
            lines.back() += static_cast<char>(c);
        }
    }
    lines.pop_back();
    return lines;
}

/// The class whose constructor, destructor, table of virtual functions or type information a line of `nm -C` shows, or
/// "". Those of unnamed namespaces, of functions and of templates are left out.
std::string class_shown_by(const std::string& line) {
    static const std::regex table(R"( [A-Za-z] (?:vtable|typeinfo|typeinfo name|VTT) for (espalier(?:::\w+)+)$)");
    static const std::regex maker(R"( [A-Za-z] (espalier(?:::\w+)*::(\w+))::~?\2\()");
    std::smatch match;
    return std::regex_search(line, match, table) || std::regex_search(line, match, maker) ? match[1].str() : "";
}

/// Is it a known class, or nested in one?
bool is_within(std::string name, const std::map<std::string, std::set<std::string>>& known) {
    while (!known.contains(name)) {
        const std::size_t last = name.rfind("::");
        if (last == std::string::npos) return false;
        name.resize(last);
    }
    return true;
}

/// The objects of the stations and commands.
std::string compiled_objects() {
    static const std::regex output(R"( -o (CMakeFiles/espalier_\S+\.o) )");
    const fs::path folder = ESPALIER_BUILD_DIR;
    std::ifstream in(folder / "compile_commands.json");
    std::string files;
    for (const auto& entry : nlohmann::json::parse(in)) {
        std::smatch match;
        const std::string command = entry["command"];
        if (!std::regex_search(command, match, output)) continue;
        const fs::path object = folder / match[1].str();
        if (fs::exists(object)) files += " '" + object.string() + "'";
    }
    return files;
}

/// The sizes that tables of virtual functions and type information have in the objects, by their mangled names.
std::map<std::string, std::set<std::string>> table_sizes(const std::vector<std::string>& lines) {
    std::map<std::string, std::set<std::string>> sizes;
    for (const std::string& line : lines) {
        std::istringstream words(line);
        std::string place, size, kind, name;
        const bool whole = static_cast<bool>(words >> place >> size >> kind >> name);
        // Small letters are of one object alone.
        if (!whole || (kind != "V" && kind != "D" && kind != "R" && kind != "B")) continue;
        if (name.starts_with("_ZTV") || name.starts_with("_ZTI")) sizes[name].insert(size);
    }
    return sizes;
}

}  // namespace

TEST_CASE("no two files define a class of the same name in the same namespace", "[layout]") {
    const auto files_of = files_of_classes();
    CHECK(files_of.size() > 300);
    for (const auto& [name, files] : files_of) {
        INFO(name);
        CHECK(files.size() == 1);
    }
}

TEST_CASE("every class in the compiled libraries is one that the reading of the sources found", "[layout]") {
    const fs::path build = ESPALIER_BUILD_DIR;
    std::string files;
    for (const char* name :
         {"libespalier_core.so", "libespalier.so", "libespalier_look.so", "libespalier_look_commands.so", "espalier"}) {
        files += " '" + (build / name).string() + "'";
    }
    const auto known = files_of_classes();
    std::set<std::string> shown, unknown;
    for (const std::string& line : symbols("-C", files)) {
        const std::string name = class_shown_by(line);
        if (name.empty()) continue;
        shown.insert(name);
        if (!is_within(name, known)) unknown.insert(name);
    }
    if (shown.empty()) WARN("no nm here, or no symbols");
    CHECK((shown.empty() || shown.size() > 200));
    CHECK(unknown == std::set<std::string>{});
}

TEST_CASE("a class has the same virtual functions and bases in every object that knows it", "[layout]") {
    const auto sizes = table_sizes(symbols("-S", compiled_objects()));
    if (sizes.empty()) WARN("no nm here, or no objects");
    CHECK((sizes.empty() || sizes.size() > 200));
    for (const auto& [name, found] : sizes) {
        INFO(name);
        CHECK(found.size() == 1);
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
                                         "namespace exit_code {",
                                         "inline constexpr int done = 0;",
                                         "}",
                                         "class After {",
                                         "};",
                                         "namespace {",
                                         "class Hidden {",
                                         "};",
                                         "}  // namespace",
                                         "    struct Nested {",
                                         "    };",
                                         "}  // namespace espalier::view"};
    CHECK(classes_of(lines) ==
          std::vector<std::string>{"espalier::view::Painter", "espalier::view::Reader", "espalier::view::After"});
}

TEST_CASE("the reader of compiled classes knows constructors, tables and nested classes", "[layout]") {
    CHECK(class_shown_by("0001 W espalier::turtle::Walk::Walk(int)") == "espalier::turtle::Walk");
    CHECK(class_shown_by("0001 V typeinfo for espalier::RunError") == "espalier::RunError");
    CHECK(class_shown_by("0001 T espalier::view::Painter::draw(int)").empty());
    CHECK(class_shown_by("0001 t espalier::view::(anonymous namespace)::Key::Key()").empty());
    CHECK(is_within("espalier::ReadLog::Scope", {{"espalier::ReadLog", {}}}));
    CHECK_FALSE(is_within("espalier::Reader", {{"espalier::ReadLog", {}}}));
    const auto sizes = table_sizes({"00 20 V _ZTV1A", "00 28 V _ZTV1A", "00 20 d _ZTV1B", "00 18 W _ZN1A1fEv"});
    CHECK(sizes == std::map<std::string, std::set<std::string>>{{"_ZTV1A", {"20", "28"}}});
}
