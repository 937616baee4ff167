#include "espalier/base/file.h"
#include "espalier/turtle/symbol.h"

#include "catch.h"

#include <filesystem>
#include <regex>
#include <set>
#include <string>

using namespace espalier;
using namespace espalier::turtle;

namespace {

/// The names of the symbols that a source file defines.
std::set<std::string> defined_in(const std::filesystem::path& path) {
    const std::string text = read_text(path);
    const std::regex definition(R"re(const Registered<Symbol>\s+\w+\s*\{\s*\{\s*"((?:[^"\\]|\\.)+)")re");
    std::set<std::string> names;
    for (std::sregex_iterator match(text.begin(), text.end(), definition), end; match != end; ++match) {
        const std::string name = (*match)[1];
        names.insert(name == "\\\\" ? "\\" : name);
    }
    return names;
}

}  // namespace

TEST_CASE("every symbol in the open folder is registered, and nothing else", "[turtle]") {
    std::set<std::string> defined, found;
    for (const auto& entry : std::filesystem::directory_iterator(ESPALIER_SOURCE_DIR "/src/turtle/symbols")) {
        const std::set<std::string> names = defined_in(entry.path());
        INFO(entry.path());
        CHECK_FALSE(names.empty());
        for (const std::string& name : names) {
            INFO(name);
            CHECK(defined.insert(name).second);  // defined once
        }
    }
    for (const auto& [name, symbol] : registered<Symbol>()) found.insert(name);
    CHECK(defined == found);
}

TEST_CASE("every symbol says what it does, beginning with its name", "[turtle]") {
    for (const auto& [name, symbol] : registered<Symbol>()) {
        INFO(name);
        CHECK(symbol->name == name);
        CHECK(symbol->action != nullptr);
        const std::string shown = name.back() == '*' ? name.substr(0, name.size() - 1) : name;
        CHECK(symbol->help.starts_with(shown));
        CHECK(symbol->help.find(": ") != std::string::npos);
    }
}

TEST_CASE("every symbol belongs to one group, that of its file", "[turtle]") {
    std::set<std::string> grouped;
    for (const auto& [name, group] : registered<SymbolGroup>()) {
        std::string file = name;
        std::replace(file.begin(), file.end(), '-', '_');
        const std::set<std::string> defined = defined_in(ESPALIER_SOURCE_DIR "/src/turtle/symbols/" + file + ".cpp");
        INFO(name);
        CHECK(defined == std::set<std::string>(group->symbols.begin(), group->symbols.end()));
        CHECK(group->example.find("axiom: ") != std::string::npos);
        for (const std::string& symbol : group->symbols) CHECK(grouped.insert(symbol).second);
    }
    CHECK(grouped.size() == registered<Symbol>().size());
}
