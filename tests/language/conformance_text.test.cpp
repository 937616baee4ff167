// Sections 1 and 2 of docs/language.md: the preprocessor, lines, modules, numbers, files.
#include "conformance.h"

#include <fstream>
#include <unistd.h>

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

TEST_CASE("1.1 comments and joined lines", "[conformance]") {
    quote("A comment, `/* */` or `//`, is replaced by one blank.");
    CHECK(derived("/* a\n plant */ lsystem: 1 // one\nderivation /* how\nlong */ length: 1\naxiom: A/* x */B\n"
                  "A /* < */ --> C // > D\n// B --> D\nendlsystem // end\n") == "CB");
    quote("A backslash at the end of a line joins it with the next line.");
    CHECK(step("A", "A --> B\\\nC\n") == "BC");
    CHECK(step("AB", "#define TWO(x) x \\\nx\nA --> TWO(C)\n") == "CCB");
}

TEST_CASE("1.1 directives", "[conformance]") {
    quote(
        "Directives are `#define` (with arguments or without), `#undef`, `#include`, `#if`, `#ifdef`, `#ifndef`, "
        "`#elif`, `#else`, `#endif`, `#error`, `#line` and `#pragma`. The last two have no effect.");
    CHECK(step("A",
               "#line 7\n  # pragma once\n#define N 2\n#if N == 1\nA --> B\n#elif N == 2\nA --> C\n#else\n"
               "A --> D\n#endif\n#undef N\n#ifndef N\n#ifdef M\nC --> E\n#endif\n#endif\n") == "C");
    CHECK(mistake("#error not yet\n" + lsystem_of("", "A", "A --> B\n")).find("#error not yet") != std::string::npos);
    quote("A line that begins with `#` but is not a directive contains modules.");
    CHECK(step("A#", "A --> B\n\t#(0.06)F\n# --> #5 F\n#define W 3\n") == "B#(0.06)F#5F");
    CHECK(step("A", "#define W 3\nA --> B\n\t#(W)F\n") == "B#(3)F");
}

TEST_CASE("1.1 macros", "[conformance]") {
    CHECK(step("A", "#define LENGTH 2.5\n#define SEGMENT(l, a) F(l)+(a)\nA --> F(LENGTH) SEGMENT(1, 30)\n") ==
          "F(2.5)F(1)+(30)");
    quote(
        "A macro is replaced wherever its name occurs after the definition, even if the name was meant as a module. A "
        "macro with arguments is not replaced if no arguments follow.");
    CHECK(step("AB", "#define B C\nA --> B\nB --> D\n") == "CB");
    CHECK(step("S", "#define S(x) F(x)\nS --> S(2)S\n") == "F(2)S");
    quote("The preprocessor treats `$` and `_` as letters of names: it finds no `A` in `A$A`, and two in `A@A`.");
    CHECK(step("X", "#define A 1\nX --> A$A A@A F_A\n") == "A$A1@1F_A");
    quote(
        "Nothing is replaced inside single or double quotes. A quote without a closing quote ends at the end of its "
        "line.");
    CHECK(step("X", "#define A 1\nX --> 'A'A 'A\nY --> A\n") == "'A'1'A");
    CHECK(read(lsystem_of("", "X", "#define A 1\nX --> @L(\"A\", A)\n"))->texts.at(0) == "A");
    quote(
        "The replacement of a macro is inserted without blanks, except where two signs would become one: `-N` with N = "
        "-3 is `- -3`.");
    CHECK(step("X", "#define N -3\n#define M 4\nX --> F(1-N)-(M)\n") == "F(4)-(4)");
    CHECK(derived("#define BOTH(x, y) ((x) > 1 && (y) < 3)\n#define AND &&\n#define BEGIN { n = 2;\n" +
                  lsystem_of("derivation length: 1\nStart: BEGIN }\n", "A(2, 1)",
                             "A(x, y) : BOTH ( x , y ) AND n > 1 --> B\n")) == "B");
}

TEST_CASE("1.1 included files", "[conformance]") {
    quote("`#include`, with quotes or angle brackets, looks in the folder of the file that includes.");
    quote("Conditions use whole numbers; unknown names are 0.");
    const auto folder = std::filesystem::temp_directory_path() / ("espalier-conformance-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder / "parts");
    std::ofstream(folder / "parts/one.h") << "#include <two.h>\n";
    std::ofstream(folder / "parts/two.h") << "#if UNKNOWN + 7 / 2 == 3\n#define N 5\n#endif\n";
    std::ofstream(folder / "m.l") << "#include \"parts/one.h\"\n" +
                                         lsystem_of("derivation length: N\n", "A", "A --> A\n");
    CHECK(read_model(folder / "m.l")->main().derivation_length->value == 5);
    std::filesystem::remove_all(folder);
}

TEST_CASE("1.1 ends of lines", "[conformance]") {
    quote("Lines end as in Unix or as in Windows. The last line needs no end.");
    const std::string unix_text = lsystem_of("derivation length: 1\n", "A", "A -->\n\tB\nB --> C\n");
    std::string windows_text;
    for (const char c : unix_text) windows_text += c == '\n' ? std::string("\r\n") : std::string(1, c);
    CHECK(derived(windows_text) == "B");
    CHECK(derived(windows_text + "\x1A") == "B");
    CHECK(derived(unix_text.substr(0, unix_text.size() - 1)) == "B");
}

TEST_CASE("1.2 lines", "[conformance]") {
    quote(
        "A newline ends a statement, but a line that begins with a TAB continues the line before. Blank lines and "
        "comments between the two are ignored.");
    CHECK(step("A\n\tB", "A --> B\n\tC\n\n/* and */\n\n\tD\nB --> E\n") == "BCDE");
    CHECK(step("A(3)", "A(x) :\n\tx > 1\n\t-->\n\tF(x)[+A(x - 1)]\n") == "F(3)[+A(2)]");
    CHECK(step("AC", "A : a[1] --> B : a[1]\nC\n\t--> D\n", "define: { array a[2] = {0, 1}; }\nseed: 1\n") == "BD");
    quote("Inside braces and parentheses, a newline is a blank.");
    CHECK(step("A(1)", "A(x) : {\ny = x;\nz = 2;\n} y > 0 {\nw = 3;\n} --> B(y,\nz,\nw)\n") == "B(1,2,3)");
    CHECK(step("A", "A --> B(a[1][0])\n", "define:\n{\narray\na[2][2] = {\n{1, 2},\n{3, 4}\n};\n}\n") == "B(3)");
    quote(
        "A line that is indented by blanks is a statement of its own if it contains an arrow or begins with a keyword. "
        "Otherwise it continues the line before, as does a line that begins with `-->`, `:`, `<` or `>`.");
    CHECK(derived("lsystem: 1\n  derivation length: 1\n  axiom: A\n    B\n  A\n    --> C\n      D\n  B --> E\n"
                  "endlsystem\n") == "CDE");
}

TEST_CASE("1.3 modules", "[conformance]") {
    quote(
        "The symbol of a module is one character: any character except blanks and `< > : * ( )`. Letters, digits, "
        "brackets, braces, `;` and `,` are ordinary modules.");
    const std::string all = "`|^&%@#!~_=';,.?/\\$+-{}[]0189azAZ";
    CHECK(step("A", "A --> " + all + "\n") == all);
    CHECK(step("0", "0 --> 1[0]0\n1 --> 11\n", "derivation length: 2\n") == "11[1[0]0]1[0]0");
    CHECK(step("A{;(3)}", "A > { --> B\n; --> ,\n;(c) --> ,(c + 1)\n{ --> {.\n") == "B{.,(4)}");
    CHECK(step("+-++", "+ --> -\n- --> +(30)&\n") == "-+(30)&--");
    quote(
        "`@o` is two modules, which only the turtle combines. A production for `o` rewrites the second of them, and "
        "the context `F@o(d)` is three modules.");
    CHECK(step("@o@o(2)~a", "o --> c\na --> b\n") == "@c@o(2)~b");
    CHECK(step("AF@o(2)", "A > F@o(d) --> A(d)\n") == "A(2)F@o(2)");
    quote(
        "Modules match by their symbol and their number of parameters: `F`, `F(x)` and `F(x, y)` are three different "
        "modules.");
    CHECK(step("F F(1) F(1,2)", "F --> A\nF(x) --> B\nF(x,y) --> C\n") == "ABC");
    quote("Blanks between a symbol and its parameters, and between modules, are ignored.");
    CHECK(step("A (1, 2) B", "A ( x , y ) --> C (x+y)  D\n") == "C(3)DB");
    CHECK(step("A(1)A(2)", "A(x)<A(y):x==1&&y>1-->B(x)-(-30)\n") == "A(1)B(1)-(-30)");
    quote(
        "A parameter of a module may be a text in double quotes, as in `@L(\"%d\", n)`. Each distinct text of a model "
        "has a number, which becomes the parameter. In texts, `\\n`, `\\t` and `\\r` are newline, TAB and carriage "
        "return.");
    CHECK(read(lsystem_of("", "@L(\"a\\tb\\r\\n\")", "A --> @S(\"a\")\n"))->texts ==
          std::vector<std::string>{"a\tb\r\n", "a"});
    CHECK(step("@S(\"a\")A", "A --> @L(\"%d\", 7)@L(\"a\", 8)\nL(t, n) --> L(t)\n") == "@S(0)@L(1,7)@L(0,8)");
}

TEST_CASE("1.4 numbers", "[conformance]") {
    quote("Numbers are written `3`, `.5`, `5.`, `2.5e-1` or `1e3`. All arithmetic is in double precision.");
    CHECK(step("A(3,.5,5.,2.5e-1,1e3,1.E2,-.25)", "B --> C\n") == "A(3,0.5,5,0.25,1000,100,-0.25)");
    CHECK(step("A((0.1 + 0.2 - 0.3) * 2^54)", "B --> C\n") == "A(1)");
}

TEST_CASE("2 the parts of a file", "[conformance]") {
    quote(
        "A file contains one or more L-systems, each from `lsystem:` to `endlsystem`. The first is the one that grows");
    CHECK(derived("lsystem: 1\nderivation length: 1\naxiom: A\nA --> B\nendlsystem\n"
                  "lsystem: 2\nderivation length: 5\naxiom: B\nB --> C\nA --> D\nendlsystem\n") == "B");
    quote(
        "The items of the header, including the axiom, may have any order. An array may be used before its "
        "declaration.");
    CHECK(derived("lsystem: 1\nEnd: { z = 1; }\naxiom: A(n)+B\nStart: { a[1] = 4; n = a[1]; }\nignore: +\n"
                  "derivation length: 1\ndefine: { array a[2]; }\nseed: 3\nA(x) > B --> C(x)\nendlsystem\n") ==
          "C(4)+B");
    quote("The productions, `decomposition` and `homomorphism` follow the header, and each is optional.");
    CHECK(step("A", "decomposition\nA --> B\n") == "B");
    CHECK(step("A", "homomorphism\nA --> B\n") == "A");
    quote(
        "The words of a keyword begin with a small or a capital letter, and the blanks between them are optional: "
        "`start each:`, `Start Each:` and `StartEach:` are the same. So are `lsystem` and `l-system`.");
    for (const char* each : {"start each:", "Start Each:", "StartEach:", "startEach:", "Start each"}) {
        CHECK(derived("Lsystem: 1\nDerivation length: 2\n" + std::string(each) +
                      " { n = n + 1; }\nAxiom: A(0)\n"
                      "A(x) --> A(n)\nDecomposition\nMaximum depth: 1\nNo warnings\nHomomorphism\nwarnings\n"
                      "Endlsystem\n") == "A(2)");
    }
    CHECK(derived("L-system: 1\nRing L-system\nDerivationLength: 1\nAxiom: AB\nB < A --> C\nEndlsystem\n") == "CB");
    quote(
        "A line with an arrow is a production, even if it begins like a keyword: `end --> F`. Variables and parameters "
        "may have the names of keywords.");
    CHECK(step("end", "end --> F\n") == "F");
    CHECK(step("end", "end : 1 > 0 --> F\n") == "F");
    CHECK_FALSE(mistake(lsystem_of("", "A", "homomorphism: A --> B\n")).empty());
    CHECK(step("enD", "e < n > D : 1 > 0 --> F\nwarnings --> X\n") == "eFD");
    CHECK(step("A(end)", "A(seed) : if == 3 --> B(seed, start, for)\n",
               "Start: { end = 2; start = 1; if = 3; for = 4; axiom = 5; }\n") == "B(2,1,4)");
}

TEST_CASE("2 several L-systems, missing ends", "[conformance]") {
    quote(
        "The L-systems of a file share symbols, constants and declared modules. Each has its own variables and "
        "arrays.");
    const auto model = read(
        "module Bud(age);\nlsystem: 1\nconst k = 3;\nStart: {n = 1;}\naxiom: Bud(n)\nA --> A\n"
        "endlsystem\nlsystem: 2\nStart: {n = k;}\naxiom: Bud(n)\nA --> A\nendlsystem\n");
    CHECK(model->systems[0].axiom[0].letter == model->systems[1].axiom[0].letter);
    CHECK(model->systems[1].start[0].expressions[0]->operands[1].value == 3);
    quote("A missing `endlsystem`, and text after it that is not an L-system, cause a warning.");
    const std::string open = "lsystem: 1\nderivation length: 1\naxiom: A\nA --> B\n";
    CHECK(derived(open) == "B");
    CHECK(reading_warnings(open).size() == 1);
    CHECK(reading_warnings(open + "lsystem: 2\naxiom: C\nC --> D\nendlsystem\n").size() == 1);
    CHECK(reading_warnings(open + "endlsystem\nremember to\nprune\nlsystem: 2\naxiom: C\nC --> D\n").size() == 2);
}

TEST_CASE("the models on the page grow", "[conformance]") {
    const std::string page = read_text(std::filesystem::path(ESPALIER_SOURCE_DIR) / "docs/language.md");
    const std::string fence = "```";
    int models = 0;
    for (std::size_t at = page.find(fence + "c\n"); at != std::string::npos; at = page.find(fence + "c\n", at + 1)) {
        const std::string block = page.substr(at + 5, page.find(fence, at + 5) - at - 5);
        if (block.find("endlsystem") == std::string::npos) continue;
        INFO(block);
        CHECK_FALSE(derived(block).empty());
        CHECK(reading_warnings(block).empty());
        ++models;
    }
    CHECK(models == 7);
}
