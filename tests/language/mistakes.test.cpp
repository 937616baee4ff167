#include "espalier/base/file.h"

#include "catch.h"
#include "reading.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

using namespace espalier;
using namespace espalier::test;

namespace {

// The folder is left out, so that the expected text is the same wherever the sources lie.
std::string complaint(const std::filesystem::path& path) {
    std::string text;
    std::vector<Diagnostic> warnings;
    ReadOptions options;
    options.warnings = &warnings;
    try {
        read_model_text(read_text(path), path.filename().string(), path.parent_path(), options);
    } catch (const UserError& error) {
        text = error.what();
    }
    for (const Diagnostic& warning : warnings) {
        if (!text.empty()) text += '\n';
        text += to_string(warning);
    }
    const std::string folder = path.parent_path().string() + "/";
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
        text.erase(at, folder.size());
    return text + "\n";
}

}  // namespace

// ESPALIER_APPROVE=1 in the environment writes what is said now as what is to be said.
TEST_CASE("every mistake in the collection is explained as approved", "[language]") {
    std::vector<std::filesystem::path> models;
    for (const auto& entry : std::filesystem::directory_iterator(ESPALIER_SOURCE_DIR "/tests/language/mistakes")) {
        if (entry.path().extension() == ".l") models.push_back(entry.path());
    }
    std::sort(models.begin(), models.end());
    CHECK(models.size() >= 70);
    for (const std::filesystem::path& model : models) {
        std::filesystem::path expected = model;
        expected.replace_extension(".expected");
        if (std::getenv("ESPALIER_APPROVE")) write_text(expected, complaint(model));
        CHECK(complaint(model) == read_text(expected));
    }
}

TEST_CASE("many mistakes are reported in one go, up to twenty, sorted by place", "[language]") {
    std::string rules;
    for (int i = 0; i < 30; ++i) rules += "A -> B\n";
    const std::vector<Diagnostic> found = mistakes(lsystem("", "A", rules));
    CHECK(found.size() == 20);
    CHECK(std::is_sorted(found.begin(), found.end(),
                         [](const auto& a, const auto& b) { return a.place.line < b.place.line; }));
}

TEST_CASE("a mistake in one statement hides none in the next and begets none", "[language]") {
    CHECK(messages(lsystem("Start: { n = 1 m = 2; k = 3; }\n", "A(m)", "A(x) --> A(k, n)\nB --> )\nC --> C\n")) ==
          "2:16: expected ';' after the statement, found 'm'\n5:7: this ')' closes nothing");
}

TEST_CASE("a model cut off anywhere is refused in words, never a crash", "[language]") {
    const std::string whole =
        "#define W(x) (2*x)\nmodule Apex(a);\nenvironment light;\n" +
        lsystem(
            "seed: 3\ndefine: { array a[2] = {1, 2}; }\nStart: { for (i = 0; i < 3; i++) { a[i] = \"x\" ? 1 : 2; } }\n",
            "Apex(1)[+B]", "A < Apex(x) > [B=] : {y = 1;} x > W(1) {z = 2;} --> F(\"text\")[+A]?light(1) : 0.5\n");
    for (std::size_t length = 0; length < whole.size(); ++length) {
        INFO("cut off after " << length << " characters");
        CHECK_FALSE(mistakes(whole.substr(0, length)).empty());
    }
}

TEST_CASE("any bytes at all are read or refused, never a crash", "[language]") {
    const std::string alphabet = "AB(){}[]<>:*-->=\"'\\#\n\t ;,.?+!&|^%0e\xC3\xA9\x80x@$_";
    std::uint32_t state = 1;
    for (int run = 0; run < 3000; ++run) {
        std::string rules;
        for (int i = 0; i < 60; ++i) {
            state = state * 1664525u + 1013904223u;
            rules += alphabet[(state >> 16) % alphabet.size()];
        }
        try {
            const auto model = read(lsystem("seed: 1\nStart: {" + rules.substr(0, 10) + "}\n", "A", rules + "\n"));
            CHECK(model->systems.size() == 1);
        } catch (const UserError& error) {
            CHECK_FALSE(error.diagnostics().empty());
        }
    }
}
