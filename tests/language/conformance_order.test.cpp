// Sections 8 to 12 of docs/language.md: the order of events, decomposition, homomorphism, sub-L-systems, cutting.
#include "conformance.h"

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

namespace {

/// What the turtle sees of a string after the model's derivation length.
std::string seen(const std::string& text) {
    const std::shared_ptr<const Model> model = read(text);
    Derivation derivation(compile(model));
    ModuleString string, next;
    derivation.start(string);
    for (int step = 0; step < derivation.length(); ++step) {
        derivation.step(string, next);
        std::swap(string, next);
    }
    BranchLinks links;
    link_branches(string, links);
    const std::vector<std::size_t> offsets = parameter_offsets(string, model->alphabet);
    std::string result;
    for (std::size_t i = 0; i < string.size(); ++i) {
        ModuleString picture;
        if (!derivation.picture(string, &offsets, links, i, offsets[i], picture)) {
            const LetterId letter = string.letters[i];
            picture.append(letter, {string.parameters.data() + offsets[i], offsets[i + 1] - offsets[i]});
        }
        result += to_text(picture, model->alphabet);
    }
    return result;
}

}  // namespace

TEST_CASE("8 the order of events in a step", "[conformance]") {
    quote("`Start` runs, then the parameters of the axiom are evaluated.");
    quote(
        "In each step, `Q` grows by 1, `StartEach` runs, every module is replaced, from left to right, and `EndEach` "
        "runs.");
    quote("After the last step, `End` runs.");
    std::string printed;
    DerivationSettings settings;
    settings.printout = std::make_shared<Printout>([&](const std::string& text) { printed += text; });
    const std::string model = lsystem_of(
        "derivation length: 2\nEnd: { printf(\"end%g\", Q); }\n"
        "Start: { n = 1; printf(\"start%g \", Q); }\n"
        "EndEach: { printf(\"after%g \", Q); }\n"
        "StartEach: { n = n * 2; printf(\"before%g \", Q); }\n",
        "A(n)", "A(x) : {printf(\"A(%g) \", x);} --> A(n)\n");
    CHECK(derived(model, {}, settings) == "A(4)");
    CHECK(printed == "start0 before1 A(1) after1 before2 A(2) after2 end2");
}

TEST_CASE("9 decomposition", "[conformance]") {
    quote(
        "Each module that a step writes, copied or new, is decomposed at once, depth first, down to the maximum depth "
        "(default 1). The axiom is therefore first decomposed in step 1.");
    const std::string decomposition = "A --> BD\ndecomposition\nB --> CB\nD --> E\n";
    CHECK(step("AB", decomposition, "derivation length: 0\n") == "AB");
    CHECK(step("AB", decomposition) == "CBECB");
    CHECK(step("B(3)", "X --> X\ndecomposition\nmaximum depth: 10\nB(n) : n > 0 --> C(n)B(n - 1)\n") ==
          "C(3)C(2)C(1)B(0)");
    CHECK(step("B(3)", "X --> X\ndecomposition\nmaximum depth: 2\nno warnings\nB(n) : n > 0 --> C(n)B(n - 1)\n") ==
          "C(3)C(2)B(1)");
    std::string printed;
    DerivationSettings settings;
    settings.printout = std::make_shared<Printout>([&](const std::string& text) { printed += text; });
    derived(
        lsystem_of("derivation length: 1\n", "BD",
                   "X --> X\ndecomposition\nmaximum depth: 2\nB : {printf(\"B\");} --> CC\nC : {printf(\"C\");} --> E\n"
                   "D : {printf(\"D\");} --> F\n"),
        {}, settings);
    CHECK(printed == "BCCD");
    quote(
        "Decomposition uses the first production that matches. Its contexts are those of the module in the old string "
        "from which the decomposed module comes. Several modules on the left of the arrow must come from the same "
        "module.");
    CHECK(step("AE", "A --> BCB\ndecomposition\nBC --> DD\nB --> F\nE --> G\n") == "DDFG");
    CHECK(step("AX", "A --> B\nX --> C\ndecomposition\nBC --> DD\n") == "BC");
    quote(
        "If no production replaces a module, they are that module and those after it in the old string, before "
        "productions replace them.");
    CHECK(step("AB", "Z --> Z\ndecomposition\nAB --> C\n") == "C");
    CHECK(step("AB", "B --> Q\ndecomposition\nAB --> C\n") == "C");
    CHECK(step("AB", "A --> A\ndecomposition\nAB --> C\n") == "AB");
    CHECK(step("XA(1)B(2)D", "B(x) --> Q\ndecomposition\nA(x)B(y) > D --> C(x + y)\n") == "XC(3)D");
    CHECK(step("LA", "A --> BB\nL --> M\ndecomposition\nL < B --> C\nM < B --> D\nB --> E\n") == "MCC");
    quote(
        "`maximum depth: n`, `warnings` and `no warnings` follow the keyword; the last two may be on its line or below "
        "it.");
    CHECK(step("A", "A --> B\ndecomposition no warnings\nB --> C\nhomomorphism warnings\nC --> D\n") == "C");
    CHECK(step("A", "A --> B\ndecomposition:\nwarnings\nmaximum depth: 1\nB --> C\n") == "C");
}

TEST_CASE("10 homomorphism", "[conformance]") {
    quote(
        "The productions of a homomorphism are applied when the turtle interprets the string. The string itself does "
        "not change.");
    const std::string pictures = "A(x) --> A(x + 1)\nhomomorphism\nseed: 3\nA(x) --> !(x)B\nB --> @O(2)\n";
    CHECK(step("A(1)", pictures) == "A(2)");
    CHECK(seen(lsystem_of("derivation length: 1\n", "A(1)B", pictures)) == "!(2)B@O(2)");
    quote(
        "They are applied depth first, down to the maximum depth (default 1). Modules at this depth are interpreted as "
        "they are.");
    const std::string deep = "X --> X\nhomomorphism\nno warnings\nmaximum depth: 3\nA --> FA\n";
    CHECK(seen(lsystem_of("", "A", deep)) == "FFFA");
    quote(
        "`maximum depth: n`, `seed: n`, `warnings` and `no warnings` may follow the keyword. A homomorphism with "
        "weights has its own random numbers.");
    const std::string grown = "A --> F(ran(1))A\n";
    const std::string drawn = "homomorphism\nseed: 5\nF(x) --> G(ran(1)) : 1\nF(x) --> H : 1\n";
    CHECK(step("A", grown, "derivation length: 3\n") == step("A", grown + drawn, "derivation length: 3\n"));
}

TEST_CASE("11 sub-L-systems", "[conformance]") {
    quote(
        "Between `?(id)` or `?(id, scale)` and `$`, the productions, decomposition, homomorphism, filters and "
        "variables of the L-system with the label id apply. Sub-L-systems can be nested.");
    const std::string inner = "lsystem: 2\ndefine: { external total; }\naxiom: L\nL(x) --> L(x + 1)L(x)\nendlsystem\n";
    CHECK(derived("lsystem: 1\nderivation length: 2\nStart: { total = 0; }\naxiom: ?(2, 0.5)L(1)$L(1)A\nA --> "
                  "FA\nendlsystem\n" +
                  inner) == "?(2,0.5)L(3)L(2)L(2)L(1)$L(1)FFA");
    CHECK(derived("lsystem: 1\nderivation length: 1\naxiom: ?(2)A$A\nA --> B\nendlsystem\n"
                  "lsystem: 2\nA --> C?(3)A$A\nendlsystem\nlsystem: 3\nA --> D\nendlsystem\n") == "?(2)C?(3)A$A$B");
    CHECK(derived("lsystem: 1\nderivation length: 2\naxiom: ?(2)A$A\nA --> B\nendlsystem\n"
                  "lsystem: 2\nA --> C?(3)A$A\nendlsystem\nlsystem: 3\nA --> D\nendlsystem\n") ==
          "?(2)C?(3)D$C?(3)A$A$B");
    CHECK(derived("lsystem: 1\nderivation length: 1\nignore: +\naxiom: B+A?(2)B+A$\nB < A --> X\nendlsystem\n"
                  "lsystem: 2\nignore: F\naxiom: A\nB < A --> Y\ndecomposition\nB --> Z\nendlsystem\n") ==
          "B+X?(2)Z+A$");
    quote(
        "The axiom and derivation length of a sub-L-system are ignored; the axiom may be missing. An L-system that "
        "calls itself, directly or through others, is an error.");
    CHECK_FALSE(mistake("lsystem: 1\nderivation length: 2\naxiom: ?(2)A$\nX --> X\nendlsystem\n"
                        "lsystem: 2\nA --> ?(2)A$\nendlsystem\n")
                    .empty());
    quote("Labels are whole numbers, and each occurs once in a file.");
    CHECK(mistake("lsystem: 1\naxiom: A\nA --> A\nendlsystem\nlsystem: 1\nA --> A\nendlsystem\n").find("label 1") !=
          std::string::npos);
}

TEST_CASE("11 variables of sub-L-systems", "[conformance]") {
    quote(
        "Each occurrence of a sub-L-system has its own variables. `Start` runs when it is first entered, `StartEach` "
        "and `EndEach` run in each step, and `End` runs when it is cut or the derivation ends.");
    CHECK(derived("lsystem: 1\nderivation length: 3\nStart: { n = 100; }\naxiom: ?(2)A(0)$?(2)A(10)$A(0)\n"
                  "A(x) --> A(n)\nendlsystem\nlsystem: 2\nStart: { n = 5; }\nStartEach: { n = n + 1; }\n"
                  "A(x) : x >= 10 {n = n + 10;} --> A(n)\nA(x) --> A(n)\nendlsystem\n") == "?(2)A(8)$?(2)A(38)$A(100)");
    quote(
        "`external` names are variables and arrays of the surrounding L-system. An external array has the size that it "
        "has there.");
    CHECK(
        derived("lsystem: 1\ndefine: { array a[2] = {1, 2}; }\nderivation length: 2\n"
                "Start: { total = 1; }\naxiom: ?(2)B$A\nA --> A(total, a[1])\nA(x, y) --> A(total, a[1])\nendlsystem\n"
                "lsystem: 2\ndefine: { external total, a; }\nB : {total = total + 1; a[1] = total * 10;} --> B\n"
                "endlsystem\n") == "?(2)B$A(3,30)");
}

TEST_CASE("12 cutting", "[conformance]") {
    quote(
        "A `%` without a production of its own removes everything from itself to the end of its branch, in the step "
        "after it appeared. The branch ends at its closing bracket, at the `$` of its sub-L-system, or at the end of "
        "the string.");
    const std::string cutting = "A --> %\n";
    CHECK(step("B[CA[D]E]F", cutting) == "B[C%[D]E]F");
    CHECK(step("B[CA[D]E]F", cutting, "derivation length: 2\n") == "B[C]F");
    CHECK(step("BA[D]E", cutting, "derivation length: 2\n") == "B");
    CHECK(step("BA[D]E", cutting + "% --> X\n", "derivation length: 2\n") == "BX[D]E");
    CHECK(derived("lsystem: 1\nderivation length: 2\naxiom: ?(2)BAC$D\nX --> X\nendlsystem\n"
                  "lsystem: 2\nA --> %\nendlsystem\n") == "?(2)B$D");
    quote("A `%` in a homomorphism removes nothing from the string.");
    CHECK(step("BAC", "X --> X\nhomomorphism\nA --> %\n", "derivation length: 3\n") == "BAC");
}
