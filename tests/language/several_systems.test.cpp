#include "catch.h"
#include "reading.h"

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

TEST_CASE("each text among the parameters of modules is entered once, escapes included", "[language]") {
    const auto model = read(lsystem_of("", R"(@L("%d leaves\n", 3) @L("a\tb"))",
                                       "A --> @L(\"%d leaves\\n\", 2)@S(\"date\")\nB(x) --> @L(\"a\\tb\", x)\n"));
    CHECK(model->texts == std::vector<std::string>{"%d leaves\n", "a\tb", "date"});
    const ModuleTemplate& first = model->main().axiom[1];
    CHECK(first.arguments[0].kind == Expression::Kind::text);
    CHECK(first.arguments[0].index == 0);
    CHECK(model->main().axiom[3].arguments[0].index == 1);
    CHECK(model->main().productions[0].successor[3].arguments[0].index == 2);
    CHECK(model->main().productions[1].successor[1].arguments[0].index == 1);
}

TEST_CASE("L-systems of one file share the alphabet, not the variables", "[language]") {
    const auto model = read(
        "lsystem: 1\nStart: {n = 1;}\naxiom: A(n)\nA(x) --> A(x+n)\nendlsystem\n"
        "lsystem: 07\nStart: {m = 2; n = 3;}\naxiom: A(1)\nA(x) --> B(m)\nendlsystem\n");
    REQUIRE(model->systems.size() == 2);
    CHECK(model->systems[0].label == "1");
    CHECK(model->systems[1].label == "7");
    CHECK(model->systems[0].globals == std::vector<std::string>{"Q", "Z", "n"});
    CHECK(model->systems[1].globals == std::vector<std::string>{"Q", "Z", "m", "n"});
    CHECK(model->systems[0].productions[0].strict[0].letter == model->systems[1].productions[0].strict[0].letter);
}

TEST_CASE("external names are kept apart, and external arrays take their sizes from the file", "[language]") {
    const auto model = read(
        "lsystem: 1\ndefine: { array a[2][3] = {1}; }\nStart: {n = 1; a[0][0] = n;}\n"
        "axiom: A\nA --> A\nendlsystem\n"
        "lsystem: 2\ndefine: { external n, a; external array b[4]; array own[2] = {1, 2}; }\n"
        "axiom: B\nB : n > 0 {a[1][2] = own[0]; b[0] = 1;} --> B\nendlsystem\n");
    const LSystem& inner = model->systems[1];
    CHECK(inner.external_globals == std::vector<std::string>{"n"});
    REQUIRE(inner.arrays.size() == 3);
    CHECK(inner.arrays[0].name == "b");
    CHECK(inner.arrays[0].external);
    CHECK(inner.arrays[0].dimensions[0].value == 4);
    CHECK_FALSE(inner.arrays[1].external);
    CHECK(inner.arrays[2].name == "a");
    CHECK(inner.arrays[2].external);
    CHECK(inner.arrays[2].values.empty());
    REQUIRE(inner.arrays[2].dimensions.size() == 2);
    CHECK(inner.arrays[2].dimensions[1].value == 3);
}

TEST_CASE("a variable that only an inner L-system assigns is no unknown name of the outer one", "[language]") {
    const std::string outer = "lsystem: 1\naxiom: A(n)\nA(x) --> A(n)\nendlsystem\n";
    const std::string inner = "lsystem: 2\ndefine: { external n; }\naxiom: B\nB : {n = 1;} --> B\nendlsystem\n";
    CHECK(reading_warnings(outer).size() == 1);
    CHECK(reading_warnings(outer + inner).empty());
}

TEST_CASE("side files that expressions ask are handed to the model", "[language]") {
    ReadOptions options;
    options.resources = std::make_shared<Resources>();
    options.predefined = {{"HEIGHT", "2"}};
    const auto model = read(lsystem_of("", "A(func(HEIGHT, 0.5), vvZmax(0))", "A --> A\n"), options);
    CHECK(model->resources == options.resources);
    const std::vector<Expression>& arguments = model->main().axiom[0].arguments;
    CHECK(arguments[0].function == Function::func);
    CHECK(arguments[0].operands[0].value == 2);
    CHECK(arguments[1].function == Function::view_extent);
    CHECK(arguments[1].index == 5);
}
