// The library as a whole: every model reads without a warning, and says what it is.
#include "espalier/language/notation.h"

#include "app/program.h"
#include "catch.h"
#include "experiments/growth.h"

#include <fmt/format.h>

#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

using namespace espalier;

namespace {

std::string text_at(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Paths of all models, below the root of the project.
std::vector<std::string> all_models() {
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source_path("models"))) {
        if (entry.path().extension() != ".l" && !notation_of(entry.path())) continue;
        paths.push_back(std::filesystem::relative(entry.path(), source_path("")).generic_string());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

/// The folder of an object, or the model with the view file of its name.
std::string with_side_files(std::filesystem::path model) {
    if (exists(model.parent_path() / "specifications")) return fmt::format("'{}'", model.parent_path().string());
    const std::string arguments = fmt::format("'{}'", model.string());
    if (!exists(model.replace_extension(".v"))) return arguments;
    return fmt::format("{} --view '{}'", arguments, model.string());
}

/// The text of the comment that a model begins with: one between marks, or of lines behind //.
std::string first_comment(const std::string& path) {
    const std::string text = text_at(source_path(path));
    if (text.starts_with("/* ")) return text.substr(3, text.find("*/") - 3);
    std::istringstream lines(text);
    std::string comment;
    for (std::string line; std::getline(lines, line) && line.starts_with("// ");) comment += line.substr(3) + "\n";
    return comment;
}

bool is_grown_by_experiments(const std::string& path) {
    for (const char* folder : {"course", "light", "water", "topiary", "together", "colonization"}) {
        if (path.starts_with(std::string("models/") + folder + "/")) return true;
    }
    return false;
}

}  // namespace

TEST_CASE("Every model of the library reads without a mistake or a warning", "[library]") {
    const Workplace workplace;
    REQUIRE(all_models().size() > 80);
    for (const std::string& path : all_models()) {
        const Outcome outcome = workplace.run("check " + with_side_files(source_path(path)));
        INFO(path << ": " << outcome.out << outcome.err);
        CHECK(outcome.code == 0);
        // Alone, a model that asks its surroundings gets no answer; check says so.
        const std::string warning =
            std::regex_replace(outcome.out + outcome.err, std::regex(".*no process answers.*"), "");
        CHECK(warning.find("warning") == std::string::npos);
    }
}

TEST_CASE("Every model of the library begins with a title, its source, what is checked and what to try", "[library]") {
    const std::regex head(R"([^\n]+\n([^]*\n)? *Source: [^]*\n *Check: [^]*\n *Try: [^]*)");
    for (const std::string& path : all_models()) {
        if (is_grown_by_experiments(path)) continue;
        INFO(path);
        CHECK(std::regex_match(first_comment(path), head));
    }
}
