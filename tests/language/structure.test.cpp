#include "catch.h"
#include "reading.h"

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

TEST_CASE("the items of the header stand in any order", "[language]") {
    const auto model = read(
        "Lsystem: 7\nconsider: A B[]\nStartEach: { s = 1; }\nend each: { e = 2; }\nring L-system\n"
        "Seed: 42\nStart:\n{ x = 1; }\nEnd: { y = 2; }\nDerivation length: 5 * 2\naxiom: A\nA --> B\nendlsystem\n");
    const LSystem& main = model->main();
    CHECK(main.label == "7");
    CHECK(main.ring);
    CHECK(main.seed->value == 42);
    CHECK(main.filter == LSystem::Filter::consider);
    CHECK(main.filtered.size() == 4);
    CHECK(main.start.size() == 1);
    CHECK(main.start_each.size() == 1);
    CHECK(main.end_each.size() == 1);
    CHECK(main.end.size() == 1);
}

TEST_CASE("arrays use one bracket pair per dimension and externals are listed", "[language]") {
    const auto model =
        read(lsystem_of("define: {\n  array a[2][3] = {1, 2, 3,\n 4}, b[4];\n  external light, water;\n}\n",
                        "A(a[1][2], light)", "A(x, y) --> A(b[x], y)\n"));
    const LSystem& main = model->main();
    REQUIRE(main.arrays.size() == 2);
    CHECK(main.arrays[0].dimensions.size() == 2);
    CHECK(main.arrays[0].values.size() == 4);
    CHECK(main.external_globals == std::vector<std::string>{"light", "water"});
    CHECK(main.axiom[0].arguments[0].operands.size() == 2);
    CHECK(main.axiom[0].arguments[1].kind == Expression::Kind::global);
}

TEST_CASE("every module symbol is exactly one character", "[language]") {
    const auto model = read(lsystem_of("", "@o ~l ?P(1,2) FF;,", "F@o(d) --> F@o(d)\n"));
    CHECK(modules(*model, model->main().axiom) == "@ o ~ l ? P/2 F F ; ,");
    CHECK(model->main().productions[0].strict.size() == 3);
}

TEST_CASE("symbols are Unicode code points", "[language]") {
    const auto model = read(lsystem_of("", "αβ(1)", "α --> β(2)\n"));
    CHECK(modules(*model, model->main().axiom) == "α β/1");
}

TEST_CASE("declared modules have names of several letters, longest match first", "[language]") {
    const auto model = read("module Apex(age, vigour), Ape();\nenvironment light, lighter;\n" +
                            lsystem_of("", "Apex(1,2)ApeA?light(3)?lighter(4)?E(5)", "Apex(a, v) --> Ape\n"));
    CHECK(modules(*model, model->main().axiom) == "Apex/2 Ape A ?light/1 ?lighter/1 ? E/1");
    CHECK(model->processes == std::vector<std::string>{"light", "lighter"});
    REQUIRE(model->modules.size() == 2);
    CHECK(model->modules[0].parameters == std::vector<std::string>{"age", "vigour"});
    CHECK(messages("module Apex(age);\n" + lsystem_of("", "Apex(1,2)", "A --> A\n")) ==
          "3:8: 'Apex' is declared with 1 parameter, not 2");
}

TEST_CASE("without a declaration ? and the letters after it are separate modules", "[language]") {
    const auto model = read(lsystem_of("", "?light(3)", "A --> A\n"));
    CHECK(modules(*model, model->main().axiom) == "? l i g h t/1");
}

TEST_CASE("declarations may also stand inside an L-system", "[language]") {
    const auto model = read(
        "lsystem: 1\nmodule Bud(age);\nenvironment water;\naxiom: Bud(0)?water(1)\nBud(a) --> Bud(a+1)\nendlsystem\n");
    CHECK(modules(*model, model->main().axiom) == "Bud/1 ?water/1");
}

TEST_CASE("a production has contexts, blocks, condition, successor and weight", "[language]") {
    const auto model = read(lsystem_of(
        "seed: 1\n", "ABC", "A(a) C < B(b, c)D > [E(d)=]F : {x = a;} b > c && x {y = d;} --> G(a+d)[H] : 0.3\n"));
    const Production& production = model->main().productions[0];
    CHECK(production.left.size() == 2);
    CHECK(production.strict.size() == 2);
    CHECK(production.right.size() == 5);
    CHECK(production.formals == std::vector<std::string>{"a", "b", "c", "d"});
    CHECK(production.strict[0].first_formal == 1);
    CHECK(production.right[1].first_formal == 3);
    CHECK(production.right[2].skip_branch);
    CHECK(production.before.size() == 1);
    CHECK(production.after.size() == 1);
    CHECK(production.condition->op == Operator::logical_and);
    CHECK(modules(*model, production.successor) == "G/1 [ H ]");
    CHECK(production.weight->value == 0.3);
    CHECK(to_string(production.place) == "model.l:4:1");
}

TEST_CASE("= skips a branch in a right context only", "[language]") {
    const auto model = read(lsystem_of("", "=A", "= < A --> =\nA > [B=] --> A\n"));
    CHECK_FALSE(model->main().productions[0].left[0].skip_branch);
    CHECK(modules(*model, model->main().productions[0].successor) == "=");
    CHECK(model->main().productions[1].right[2].skip_branch);
}

TEST_CASE("* stands for an empty context, condition and successor", "[language]") {
    const auto model = read(lsystem_of("", "A", "* < A > * : * --> *\nA -o> B\n"));
    const Production& production = model->main().productions[0];
    CHECK(production.left.empty());
    CHECK(production.right.empty());
    CHECK_FALSE(production.condition);
    CHECK(production.successor.empty());
    CHECK(model->main().productions[1].successor.size() == 1);
}

TEST_CASE("a minus before the arrow is a module, within parentheses -o> are operators", "[language]") {
    const auto model = read(lsystem_of("Start: { o = 1; }\n", "A", "A- --> B\nA---> -B\nA(x) : (x-o>0) --> A(x)\n"));
    CHECK(model->main().productions[0].strict.size() == 2);
    CHECK(model->main().productions[1].strict.size() == 2);
    CHECK(modules(*model, model->main().productions[1].successor) == "- B");
    CHECK(model->main().productions[2].condition->op == Operator::greater);
}

TEST_CASE("a line that begins with TAB continues the one before", "[language]") {
    const auto model = read(lsystem_of("", "A\n\tB\n\t\n\tC", "A --> F\n\t[+A]\n// between\n\tG\n\n\tB --> C\n"));
    CHECK(modules(*model, model->main().axiom) == "A B C");
    REQUIRE(model->main().productions.size() == 2);
    CHECK(modules(*model, model->main().productions[0].successor) == "F [ + A ] G");
}

TEST_CASE("a line indented by blanks continues where it can mean nothing else", "[language]") {
    const auto model =
        read(lsystem_of("", "A\n  B", "A : 1 > 0\n  --> F\n      [+A]\n      [-A]\n  B --> C\nC : 2 >\n    1 --> D\n"));
    CHECK(modules(*model, model->main().axiom) == "A B");
    REQUIRE(model->main().productions.size() == 3);
    CHECK(modules(*model, model->main().productions[0].successor) == "F [ + A ] [ - A ]");
    CHECK(modules(*model, model->main().productions[2].successor) == "D");
}

TEST_CASE("newlines are free inside braces and parentheses", "[language]") {
    const auto model =
        read(lsystem_of("Start: {\nx =\n1;\n}\n", "A(1,\n2)", "A(x,\ny) : {\nz = 1;\n} x > (1 +\n1) --> A(x,\ny)\n"));
    CHECK(model->main().productions.size() == 1);
}

TEST_CASE("an axiom may be followed directly by the decomposition", "[language]") {
    const auto model = read(
        "lsystem: 1\naxiom: A\ndecomposition\nmaximum depth: 4\nA --> BC\n"
        "Homomorphism no warnings\nseed: 3\nB --> F\nendlsystem\n");
    const LSystem& main = model->main();
    CHECK(main.productions.empty());
    CHECK(main.decomposition.present);
    CHECK(main.decomposition.maximum_depth->value == 4);
    CHECK(main.decomposition.warnings);
    CHECK(main.decomposition.productions.size() == 1);
    CHECK_FALSE(main.homomorphism.warnings);
    CHECK(main.homomorphism.seed->value == 3);
    CHECK(main.homomorphism.productions.size() == 1);
}

TEST_CASE("several L-systems follow one another over one alphabet", "[language]") {
    const auto model =
        read(lsystem_of("", "A?(2,0.5)B$", "A --> A\n") + "\n" + "lsystem: 2\naxiom: B\nB --> A\nendlsystem\n");
    REQUIRE(model->systems.size() == 2);
    CHECK(model->systems[1].label == "2");
    CHECK(model->systems[1].productions[0].successor[0].letter == model->main().axiom[0].letter);
}

TEST_CASE("text stands among the parameters of a module", "[language]") {
    const auto model = read(lsystem_of("", "@L(\"%g\\t\", 3)", "A --> A\n"));
    CHECK(model->main().axiom[1].arguments[0].text == "%g\t");
}

TEST_CASE("an axiom of a million modules is read in about a second", "[language]") {
    std::string axiom;
    for (int i = 0; i < 250'000; ++i) axiom += "F(1)[+A]";
    CHECK(read(lsystem_of("", axiom, "A --> A\n"))->main().axiom.size() == 1'250'000);
}
