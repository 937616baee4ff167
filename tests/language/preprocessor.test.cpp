#include "language/preprocessor/preprocessor.h"

#include "catch.h"
#include "language/preprocessor/preprocessed_text.h"
#include "reading.h"

#include <filesystem>
#include <fstream>

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;
using Catch::Contains;

namespace {

std::string preprocessed(const std::string& text, const ReadOptions& options = {}) {
    language::Sources sources;
    language::Mistakes mistakes(sources);
    const auto file = sources.add("model.l", text);
    const auto result = language::preprocess(sources, file, {}, options, mistakes);
    REQUIRE(mistakes.errors().empty());
    return result.text.text();
}

struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("espalier-language-" + std::to_string(::getpid()));
    Folder() { std::filesystem::create_directories(path / "parts"); }
    ~Folder() { std::filesystem::remove_all(path); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(path / name) << text; }
};

}  // namespace

TEST_CASE("comments become a blank and the line of a // comment ends", "[language]") {
    CHECK(preprocessed("A/* b */C // d\nE\n") == "A C \nE\n");
    CHECK(preprocessed("A /* two\nlines */ B\n") == "A   B\n");
    CHECK(preprocessed("\"/* text */\" '//'\n") == "\"/* text */\" '//'\n");
}

TEST_CASE("a backslash before the end of a line joins it with the next", "[language]") {
    CHECK(preprocessed("#define W 1 + \\\n 2\nA(W)\n") == "\nA(1 +  2)\n");
}

TEST_CASE("of two backslashes at the end of a macro's line one is ignored with a warning", "[language]") {
    const std::string model = "#define T(x) F(x) \\\\\n  +(3)\n" + lsystem_of("", "T(2)", "A --> F\\\\\n\tF\n");
    const auto found = reading_warnings(model);
    REQUIRE(found.size() == 1);
    CHECK(found[0].place.line == 1);
    CHECK_THAT(found[0].message, Contains("this backslash is ignored"));
    const auto read_model = read(model);
    CHECK(modules(*read_model, read_model->main().axiom) == "F/1 +/1");
    // Elsewhere it is the turtle's.
    CHECK(modules(*read_model, read_model->main().productions[0].successor) == "F \\ F");
}

TEST_CASE("a comment that hides modules of a production is warned about", "[language]") {
    const auto warned = [](const std::string& production) {
        return reading_warnings(lsystem_of("seed: 1\n", "A", production + "\nB --> C\n")).size();
    };
    CHECK(warned("A --> S ///// F") == 1);
    CHECK(warned("A --> B\n\tC//D") == 1);
    CHECK(warned("A --> B // a comment") == 0);
    CHECK(warned("A --> B : 2// a comment") == 0);
    CHECK(warned("A : {x = 1;// a comment\n} --> B") == 0);
    CHECK(warned("A --> B/ / /C") == 0);
    CHECK(reading_warnings("// A --> B//C\n" + lsystem_of("", "A", "A --> B\n")).empty());
}

TEST_CASE("a production as it is printed, with slashes between its modules, is a mistake with its place",
          "[language]") {
    const auto mistake = [](const std::string& production) {
        try {
            read(lsystem_of("", "A", production + "\n"));
        } catch (const UserError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK_THAT(mistake("A --> [&FL!A]/////'[&FL!A]///////'[&FL!A]"), Contains(":14: a comment begins here"));
    CHECK_THAT(mistake("A --> F///A"), Contains("blanks between slashes make them modules"));
    CHECK(mistake("A --> F(1)//A") == "");
    CHECK(mistake("A --> F(1) /// a comment") == "");
}

TEST_CASE("a quote that nothing reads is warned about once", "[language]") {
    CHECK(reading_warnings(lsystem_of("", "A", "A --> 'F'A\n")).size() == 1);
    CHECK(reading_warnings(lsystem_of("", "A", "A --> 'F'A\nhomomorphism\n' --> ;\n")).empty());
    CHECK(reading_warnings(lsystem_of("ignore: '\n", "A", "A --> 'F'A\n")).empty());
}

TEST_CASE("a macro that is defined with '=' is a mistake where it is defined", "[language]") {
    CHECK(messages("#define MAX = 5\n" + lsystem_of("", "A(MAX)", "A(x) : x < MAX --> A(x+1)\n")) ==
          "1:1: 'MAX' stands for '= 5' here: write '#define MAX 5', without '='");
    CHECK(messages("#define MAX = 5\n" + lsystem_of("", "A", "A --> B\n")) == "");
    CHECK(messages("#define SAME ==\n" + lsystem_of("", "A(1)", "A(x) : x SAME 1 --> B\n")) == "");
}

TEST_CASE("macros expand as names do in C and no blanks are inserted", "[language]") {
    CHECK(preprocessed("#define A 35\n(A)-A A2 AA 2A\n") == "\n(35)-35 A2 AA 2A\n");
    CHECK(preprocessed("#define N -3\nx-N\n") == "\nx- -3\n");
    CHECK(preprocessed("#define A 1\n$A A$A A@A _A\n") == "\n$A A$A 1@1 _A\n");
    CHECK(preprocessed("#define S S+1\nS\n") == "\nS+1\n");
    CHECK(preprocessed("#define A B\n#define B A\nA B\n") == "\n\nA B\n");
    CHECK(preprocessed("#define A 1\n\"A\" 'A' A\n") == "\n\"A\" 'A' 1\n");
    CHECK(preprocessed("#define A 1\ndon't A\nA\n") == "\ndon't A\n1\n");
    CHECK(preprocessed("#define A 1\n#undef A\nA\n") == "\n\nA\n");
}

TEST_CASE("macros with arguments: blanks, nesting, # and ##", "[language]") {
    CHECK(preprocessed("#define F(a,b) [a|b]\nF( 1 , G(2,3) )\n") == "\n[1|G(2,3)]\n");
    CHECK(preprocessed("#define F(a) <a>\nF\n (1) F\n") == "\n<1> F\n");
    CHECK(preprocessed("#define S(x) #x\nS(a \"b\")\n") == "\n\"a \\\"b\\\"\"\n");
    CHECK(preprocessed("#define G(x,y) x##y\nG(a,1)\n") == "\na1\n");
    CHECK(preprocessed("#define D(x) (2*x)\nD(D(1))\n") == "\n(2*(2*1))\n");
    CHECK(preprocessed("#define F G\n#define G(x) <x>\nF(1)\n") == "\n\n<1>\n");
    CHECK(preprocessed("#define W(x) #(x)F\nW(2)\n") == "\n#(2)F\n");
    CHECK(preprocessed("#define E() e\nE()\n") == "\ne\n");
}

TEST_CASE("only a known word after # makes a directive", "[language]") {
    CHECK(preprocessed("#(0.06)F\n#5 F\n#define W 3\n#(W)F\n") == "#(0.06)F\n#5 F\n\n#(3)F\n");
}

TEST_CASE("conditions compute with integers, defined, and short circuits", "[language]") {
    const auto holds = [](const std::string& condition) {
        return preprocessed("#define ONE 1\n#if " + condition + "\nyes\n#endif\n").find("yes") != std::string::npos;
    };
    CHECK(holds("1 + 2 * 3 == 7"));
    CHECK(holds("(7 % 4 << 1) == 6 && 7 / 2 == 3"));
    CHECK(holds("defined(ONE) && !defined TWO"));
    CHECK(holds("UNKNOWN == 0"));
    CHECK(holds("0 && 1 / 0 || ONE"));
    CHECK(holds("ONE ? 0x10 == 16 : 0"));
    CHECK(holds("-1 < 0 && ~0 == -1"));
    CHECK_FALSE(holds("ONE - 1"));
}

TEST_CASE("exactly one branch of a condition is read", "[language]") {
    const std::string text = "#if X == 1\none\n#elif X == 2\ntwo\n#elif X == 2\nagain\n#else\nother\n#endif\n";
    const auto words = [&](const std::string& x) {
        std::string result = preprocessed("#define X " + x + "\n" + text);
        std::erase(result, '\n');
        return result;
    };
    CHECK(words("1") == "one");
    CHECK(words("2") == "two");
    CHECK(words("3") == "other");
    CHECK(preprocessed("#ifdef A\n#if 1\na\n#else\nb\n#endif\n#endif\nc\n").find_first_of("ab") == std::string::npos);
}

TEST_CASE("an overridden name keeps its new value whatever the file says", "[language]") {
    ReadOptions options;
    options.defines = {{"ANGLE", "30"}};
    CHECK(preprocessed("#define ANGLE 25\n+(ANGLE)\n", options) == "\n+(30)\n");
    CHECK(preprocessed("#ifndef ANGLE\n#define ANGLE 25\n#endif\n+(ANGLE)\n", options).ends_with("+(30)\n"));
    CHECK(preprocessed("#ifdef ANGLE\nyes\n#endif\n", options).find("yes") != std::string::npos);
}

TEST_CASE("overriding a name the model never defines offers the nearest one", "[language]") {
    ReadOptions options;
    options.defines = {{"ANGEL", "30"}};
    CHECK(messages("#define ANGLE 25\n" + lsystem_of("", "A", "A --> B\n"), options) ==
          "0:0: 'ANGEL' cannot be overridden: the model never defines it (did you mean 'ANGLE'?)");
}

TEST_CASE("a second, different definition is warned about and wins", "[language]") {
    std::vector<Diagnostic> warnings;
    ReadOptions options;
    options.warnings = &warnings;
    const auto model = read(
        "#define N 1\n#define N 1\n#define N 2\n" + lsystem_of("derivation length: N\n", "A", "A --> A\n"), options);
    REQUIRE(warnings.size() == 1);
    CHECK(to_string(warnings[0].place) == "model.l:3:1");
    CHECK(warnings[0].severity == Diagnostic::Severity::warning);
    CHECK(model->main().derivation_length->value == 2);
}

TEST_CASE("names defined beforehand give way to a file's own definition, overridden ones do not", "[language]") {
    std::vector<Diagnostic> warnings;
    ReadOptions options;
    options.predefined = {{"HILL", "1"}, {"SLOPE", "2"}};
    options.defines = {{"SLOPE", "3"}, {"UNKNOWN", "4"}};
    options.warnings = &warnings;
    const auto text = preprocess_text("HILL SLOPE\n#define HILL 7\n#define SLOPE 8\nHILL SLOPE\n#undef HILL\nHILL\n",
                                      "p.v", {}, options);
    CHECK(text->text() == "1 3\n\n\n7 3\n\nHILL\n");
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].message ==
          "'HILL' is defined a second time, differently (first in the view file, as the name of a function)");
}

TEST_CASE("included files are found beside the file that includes them", "[language]") {
    const Folder folder;
    folder.write("parts/angle.h", "#include \"deeper.h\"\n");
    folder.write("parts/deeper.h", "#define ANGLE 22\n");
    folder.write("model.l",
                 "#include \"parts/angle.h\"\n" + lsystem_of("derivation length: ANGLE\n", "A", "A --> A\n"));
    const auto model = read_model(folder.path / "model.l");
    CHECK(model->main().derivation_length->value == 22);
    CHECK(model->name == "model.l");
}

TEST_CASE("a mistake in an included file is shown where it was written", "[language]") {
    const Folder folder;
    folder.write("rules.h", "\nA --> B C(\n");
    folder.write("model.l", lsystem_of("", "A", "#include \"rules.h\"\n"));
    try {
        read_model(folder.path / "model.l");
        FAIL("the mistake went unnoticed");
    } catch (const UserError& error) {
        REQUIRE(error.diagnostics().size() == 1);
        CHECK(error.diagnostics()[0].place.file == (folder.path / "rules.h").string());
        CHECK(error.diagnostics()[0].place.line == 2);
        CHECK(error.diagnostics()[0].source == "A --> B C(");
    }
}

TEST_CASE("files that include themselves without end are stopped", "[language]") {
    const Folder folder;
    folder.write("model.l", "#include \"model.l\"\n" + lsystem_of("", "A", "A --> A\n"));
    folder.write("twice.l",
                 "#ifndef ONCE\n#define ONCE\n#include \"twice.l\"\n" + lsystem_of("", "A", "A --> A\n") + "#endif\n");
    CHECK_THROWS_WITH(read_model(folder.path / "model.l"),
                      Catch::Contains("does") && Catch::Contains("include itself?"));
    CHECK(read_model(folder.path / "twice.l")->systems.size() == 1);
}

TEST_CASE("places count through macros, comments and joined lines as the author wrote them", "[language]") {
    CHECK(messages("#define BAD 1 2\n/* two\nlines */\n" + lsystem_of("", "A", "A --> \\\n  F(BAD)\n")) ==
          "7:5: expected ')' after the parameters of 'F', found '2'");
    CHECK(messages(lsystem_of("", "ééé) A", "A --> A\n")) == "2:11: this ')' closes nothing");
}

TEST_CASE("macros that expand without end are an error, not a hang", "[language]") {
    std::string bomb = "#define m0\n";
    for (int i = 1; i <= 40; ++i) {
        bomb += "#define m" + std::to_string(i) + " m" + std::to_string(i - 1) + " m" + std::to_string(i - 1) + "\n";
    }
    CHECK(messages(bomb + lsystem_of("", "A", "A --> F(m40)\n")).find("expands without end") != std::string::npos);
    std::string chain = "#define n0 1\n";
    for (int i = 1; i <= 1000; ++i) chain += "#define n" + std::to_string(i) + " n" + std::to_string(i - 1) + "\n";
    CHECK(messages(chain + lsystem_of("", "A", "A --> F(n1000)\n")).find("nested more than 200") != std::string::npos);
}

TEST_CASE("the text of a side file knows where it was written, through macros and included files", "[language]") {
    const Folder folder;
    folder.write("parts/angle.h", "#define ANGLE 22\nline width: 2\n");
    folder.write("plant.v", "#include \"parts/angle.h\"\n/* how it turns */ angle factor: 360/-ANGLE x\n");
    ReadOptions options;
    options.defines = {{"UNKNOWN", "1"}};
    const auto text = preprocess_file(folder.path / "plant.v", options);
    CHECK(text->text().find("angle factor: 360/-22 x\n") != std::string::npos);
    const Place width = text->place(text->text().find("width"));
    CHECK(width.file == (folder.path / "parts/angle.h").string());
    CHECK(width.line == 2);
    CHECK(width.column == 6);
    const std::size_t behind_macro = text->text().find(" x\n") + 1;
    CHECK(text->place(behind_macro).line == 2);
    CHECK(text->place(behind_macro).column == 45);
    CHECK(text->place(text->text().find("22")).column == 39);
    CHECK(text->source_line(behind_macro) == "/* how it turns */ angle factor: 360/-ANGLE x");
    CHECK(preprocess_text("", "empty.v")->text().empty());
    CHECK(preprocess_text("", "empty.v")->place(0).line == 1);
    CHECK_THROWS_AS(preprocess_text("#if 1\n", "plant.v"), UserError);
}
