#include "espalier/base/file.h"

#include "catch.h"
#include "reading.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

namespace {

// The folder is left out, so that the expected text is the same wherever the sources lie.
std::string complaint_of(const std::filesystem::path& path) {
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
        if (std::getenv("ESPALIER_APPROVE")) write_text(expected, complaint_of(model));
        CHECK(complaint_of(model) == read_text(expected));
    }
}

TEST_CASE("many mistakes are reported in one go, up to twenty, sorted by place", "[language]") {
    std::string rules;
    for (int i = 0; i < 30; ++i) rules += "A -> B\n";
    const std::vector<Diagnostic> found = mistakes(lsystem_of("", "A", rules));
    CHECK(found.size() == 20);
    CHECK(std::is_sorted(found.begin(), found.end(),
                         [](const auto& a, const auto& b) { return a.place.line < b.place.line; }));
}

TEST_CASE("models of other programs and binary files are told apart in a sentence", "[language]") {
    CHECK(messages("Axiom: A(0)\nderivation length: 5\nproduction:\nA(x) --> F(x)A(x+1)\nendlsystem\n") ==
          "0:0: model.l: this is a model of L-Py, which is Python and needs that program; Espalier reads models of "
          "cpfg, which begin with 'lsystem:'. The module of Python translates simple ones: espalier.from_lpy");
    CHECK(messages("#include <lpfgall.h>\nmodule A(int);\nAxiom: A(0);\nA(x) : { produce F(x) A(x+1); }\n") ==
          "0:0: model.l: this is a model in L+C, the language of lpfg, which is C++ and needs that program; Espalier "
          "reads models of cpfg, which begin with 'lsystem:'");
    CHECK(messages("\x7f"
                   "ELF\x02\x01" +
                   std::string(9, '\0')) == "0:0: model.l is a binary file, not the text of a model");
    CHECK(messages(lsystem_of("", "A", "A --> \x1b\n")).find("control character 0x1b") != std::string::npos);
}

TEST_CASE("what a terminal would obey is not printed", "[language]") {
    const std::vector<Diagnostic> found = mistakes(lsystem_of("", "A", "A --> \x1b[31m\x9b\n"));
    REQUIRE(!found.empty());
    CHECK(to_string(found[0]).find('\x1b') == std::string::npos);
    CHECK(to_string(found[0]).find('\x9b') == std::string::npos);
    CHECK(to_string(Diagnostic{Diagnostic::Severity::error, {}, "found '\x1b' and '\u00e9'", ""}) ==
          "found '?' and '\u00e9'");
}

TEST_CASE("keywords are offered for a function that is not known only where braces follow", "[language]") {
    CHECK(messages(lsystem_of("", "A", "A --> B(foo(3))\n")) == "3:9: there is no function 'foo'");
    CHECK(messages(lsystem_of("Start: { fo (i = 0; i < 3; i++) { n = i; } }\n", "A", "A --> A\n")).find("'for'") !=
          std::string::npos);
}

TEST_CASE("a mistake in one statement hides none in the next and begets none", "[language]") {
    CHECK(messages(lsystem_of("Start: { n = 1 m = 2; k = 3; }\n", "A(m)", "A(x) --> A(k, n)\nB --> )\nC --> C\n")) ==
          "2:16: expected ';' after the statement, found 'm'\n5:7: this ')' closes nothing");
}

TEST_CASE("a model cut off anywhere is refused in words, never a crash", "[language]") {
    const std::string whole =
        "#define W(x) (2*x)\nmodule Apex(a);\nenvironment light;\n" +
        lsystem_of(
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
            const auto model = read(lsystem_of("seed: 1\nStart: {" + rules.substr(0, 10) + "}\n", "A", rules + "\n"));
            CHECK(model->systems.size() == 1);
        } catch (const UserError& error) {
            CHECK_FALSE(error.diagnostics().empty());
        }
    }
}

TEST_CASE("files of other programs are named, and what to write in their place", "[language]") {
    const auto said = [](const std::string& text) { return messages(text); };
    CHECK(said("Dragon {\n  Angle 4\n  Axiom FX\n  X=X+YF+\n  Y=-FX-Y\n}\n").find("an L-system of Fractint") !=
          std::string::npos);
    CHECK(said("11\n45\n20\nA\nA=F[+A][-A]\n@\n").find("an L-system of LParser") != std::string::npos);
    CHECK(
        said("module Bud(int n) extends Sphere(0.1);\nprotected void init() [ Axiom ==> Bud(5); ]\n").find("GroIMP") !=
        std::string::npos);
    CHECK(said("Premise A\nRule 1: A=F[+A]A\n").find("Houdini") != std::string::npos);
    CHECK(said("variables : A B\nconstants : none\naxiom  : A\nrules  : (A -> AB), (B -> A)\n")
              .find("the notation of encyclopedias") != std::string::npos);
    CHECK(said("[simulation]\nsteps = 3\n[[plant]]\nmodel = \"a.l\"\n").find("this is a scene") != std::string::npos);
    CHECK(said("<?xml version=\"1.0\"?>\n<rsml></rsml>\n").find(".rsml") != std::string::npos);
    CHECK(said("DGF\nVertex\n0 0 0\n#\n").find(".dgf") != std::string::npos);
    CHECK(said("<!DOCTYPE html>\n<html>lsystem</html>\n").find("a web page") != std::string::npos);
    CHECK(said("{\"axiom\": \"F\", \"rules\": {\"F\": \"FF\"}}\n").find("this is JSON") != std::string::npos);
    CHECK(said("{\n  \"axiom\": \"F\"\n}\n").find("this is JSON") != std::string::npos);
    CHECK(said("[ { \"axiom\": \"F\" } ]\n").find("this is JSON") != std::string::npos);
    CHECK(said("Koch { ; a comment\n  angle 6 axiom F--F--F\n  F=F+F--F+F\n}\n").find("Fractint") != std::string::npos);
    CHECK(said("Shape s_1 {\n  Geometry Sphere { Radius 1 }\n}\n").find("PlantGL") != std::string::npos);
    CHECK(said("<?xml version='1.0'?>\n<arbaro>\n</arbaro>\n").find("a tree of Arbaro") != std::string::npos);
    CHECK(said("<opf version=\"2.0\">\n</opf>\n").find(".opf") != std::string::npos);
    CHECK(said("CODE:\tFORM-A\n\nCLASSES:\n").find(".mtg") != std::string::npos);
    CHECK(said("#a tree\nCODE :\tFORM-A\nCLASSES :\nMTG :\nENTITY-CODE\tXX\n").find(".mtg") != std::string::npos);
    CHECK(said("import turtle\ndef grow(s):\n    return s\n").find("a program in Python") != std::string::npos);
    // A sound model is read whatever its names remind of.
    CHECK(said("lsystem: 1\naxiom: A\nA --> A\nendlsystem\n/* rules, variables,\nangle 90\nimport\n*/\n") == "");
    // A mistake of a model is not hidden by such a sentence.
    CHECK(said(lsystem_of("", "A", "A -> B\n")) == "3:3: the arrow of a production is '-->', not '->'");
}

TEST_CASE("lines of a model without its head are told what stands around them", "[language]") {
    const std::string around =
        ": this is a part of a model, which begins with lines 'lsystem: 1', 'derivation length: 5' and "
        "'axiom: ...' and ends with 'endlsystem'";
    CHECK(messages("axiom: F\nF --> FF\n") == "1:1: expected 'lsystem:', found 'axiom'" + around);
    CHECK(messages("A(x) : x > 1 --> F(x)A(x-1)\nA(x) : x <= 1 --> *\n") ==
          "1:1: expected 'lsystem:', found 'A'" + around);
    CHECK(messages("derivation length: 3\n") == "1:1: expected 'lsystem:', found 'derivation length'" + around);
    CHECK(messages("Dear reader,\n") == "1:1: expected 'lsystem:', found 'Dear reader,'");
}
