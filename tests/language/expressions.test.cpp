#include "catch.h"
#include "language/parser/constant.h"
#include "reading.h"

#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

namespace {

double value(const std::string& expression) {
    const auto model = read(lsystem_of("derivation length: " + expression + "\n", "A", "A --> A\n"));
    const std::optional<double> result = language::constant_value(*model->main().derivation_length);
    REQUIRE(result);
    return *result;
}

}  // namespace

TEST_CASE("^ is left-associative and binds looser than unary minus", "[language]") {
    CHECK(value("2^3^2") == 64);
    CHECK(value("-2^2") == 4);
    CHECK(value("2^-1") == 0.5);
    CHECK(value("2*3^2") == 18);
}

TEST_CASE("operators bind in the order of the language", "[language]") {
    CHECK(value("1 + 2 * 3 - 4 / 2") == 5);
    CHECK(value("10 - 3 - 2") == 5);
    CHECK(value("100 / 5 / 2") == 10);
    CHECK(value("7 % 4 * 2") == 6);
    CHECK(value("1 + 1 < 3 == 1") == 1);
    CHECK(value("1 || 0 && 0") == 1);
    CHECK(value("!0 + 1") == 2);
    CHECK(value("3 <> 4") == 1);
    CHECK(value("0 ? 1 : 0 ? 2 : 3") == 3);
    CHECK(value("(1 ? 2 : 3) + 1") == 3);
}

TEST_CASE("% truncates both sides to integers", "[language]") {
    CHECK(value("7.9 % 3.9") == 1);
}

TEST_CASE("numbers may have a point, an exponent, or both", "[language]") {
    CHECK(value("1e3") == 1000);
    CHECK(value("1.5e-2") == 0.015);
    CHECK(value(".5") == 0.5);
    CHECK(value("2.") == 2);
}

TEST_CASE("functions take angles in degrees", "[language]") {
    CHECK(value("sin(30)") == Approx(0.5));
    CHECK(value("acos(0)") == Approx(90));
    CHECK(value("atan2(1, 0)") == Approx(90));
    CHECK(value("atan(0, 1)") == Approx(90));  // atan(x, y)
    CHECK(value("trunc(2.5)") == 2);
    CHECK(value("min(3, 1, 2) + max(3, 1, 2)") == 4);
    CHECK(value("clamp(7, 0, 5) + lerp(10, 20, 0.25)") == 17.5);
}

TEST_CASE("pi and e are ordinary names that a model may redefine", "[language]") {
    const auto plain = read(lsystem_of("", "A(pi, e)", "A(e, x) --> A(e, pi * x)\n"));
    CHECK(plain->main().globals == std::vector<std::string>{"Q", "Z"});
    CHECK(plain->main().axiom[0].arguments[0].value == std::numbers::pi);
    CHECK(plain->main().axiom[0].arguments[1].value == std::numbers::e);
    CHECK(plain->main().productions[0].successor[0].arguments[0].kind == Expression::Kind::formal);

    const auto redefined = read(lsystem_of("Start: { y = pi; pi = 3; }\n", "A(pi, e)", "A(x, y) --> A(x, y)\n"));
    CHECK(redefined->main().globals == std::vector<std::string>{"Q", "Z", "y", "pi"});
    CHECK(redefined->main().axiom[0].arguments[0].kind == Expression::Kind::global);
    CHECK(redefined->main().axiom[0].arguments[0].index == 3);
    CHECK(redefined->main().axiom[0].arguments[1].kind == Expression::Kind::number);
}

TEST_CASE("const names a value once and for all", "[language]") {
    const auto model = read("const turn = 360;\nconst half = turn / 2;\n" + lsystem_of("", "+(half)", "A --> A\n"));
    CHECK(model->main().axiom[0].arguments[0].value == 180);
    CHECK(messages("const a = 1;\n" + lsystem_of("Start: { a = 2; }\n", "A", "A --> A\n")) ==
          "3:10: 'a' is a constant and cannot be assigned");
}

TEST_CASE("Q is the current step and Z the derivation length", "[language]") {
    const auto model = read(lsystem_of("", "A(Z, Q)", "A(x, y) --> A(x, y)\n"));
    CHECK(model->main().axiom[0].arguments[0].index == 1);
    CHECK(model->main().axiom[0].arguments[1].index == 0);
}

TEST_CASE("names assigned in blocks are globals everywhere and formals hide them", "[language]") {
    const auto model = read(lsystem_of("EndEach: { n = n + 1; }\n", "A(n)", "A(n) --> A(n)\nB --> A(n)\n"));
    CHECK(model->main().globals.back() == "n");
    CHECK(model->main().axiom[0].arguments[0].kind == Expression::Kind::global);
    CHECK(model->main().productions[0].successor[0].arguments[0].kind == Expression::Kind::formal);
    CHECK(model->main().productions[1].successor[0].arguments[0].kind == Expression::Kind::global);
}

TEST_CASE("statements: branches, loops, steps and compound assignments", "[language]") {
    const auto model =
        read(lsystem_of("define: { array a[3]; }\nStart: {\n"
                        "  for (i = 0; i < 3; i++) { a[i] *= 2; if (i == 1) { break; } else if (i > 7) { x = 1; }"
                        " else { x = 2; } }\n"
                        "  while (x > 0) { x -= 1; }\n  do { --x; } while (x > 0);\n  printf(\"%g\\n\", x);\n}\n",
                        "A", "A --> A\n"));
    const Block& start = model->main().start;
    REQUIRE(start.size() == 4);
    CHECK(start[0].kind == Statement::Kind::for_loop);
    CHECK(start[0].expressions.size() == 3);
    REQUIRE(start[0].bodies[0].size() == 2);
    const Expression& doubled = *start[0].bodies[0][0].expressions[0];
    CHECK(doubled.kind == Expression::Kind::assign);
    CHECK(doubled.operands[0].kind == Expression::Kind::element);
    CHECK(doubled.operands[1].op == Operator::multiply);
    const Statement& branch = start[0].bodies[0][1];
    CHECK(branch.kind == Statement::Kind::branch);
    CHECK(branch.expressions.size() == 2);
    CHECK(branch.bodies.size() == 3);
    CHECK(branch.bodies[0][0].kind == Statement::Kind::break_loop);
    CHECK(start[1].kind == Statement::Kind::while_loop);
    CHECK(start[2].kind == Statement::Kind::do_loop);
    CHECK(start[3].expressions[0]->operands[0].text == "%g\n");
}

TEST_CASE("view extents are numbered and noise always has three coordinates", "[language]") {
    const auto model = read(lsystem_of("", "A(vvYmax(0), vvScale(1), noise(1))", "A(x,y,z) --> A(x,y,z)\n"));
    const std::vector<Expression>& arguments = model->main().axiom[0].arguments;
    CHECK(arguments[0].function == Function::view_extent);
    CHECK(arguments[0].index == 3);
    CHECK(arguments[1].index == 6);
    CHECK(arguments[2].operands.size() == 3);
}

TEST_CASE("expressions of any depth are read or refused, never a crash", "[language]") {
    const std::string deep(100'000, '(');
    CHECK(messages(lsystem_of("derivation length: " + deep + "\n", "A", "A --> A\n")).find("nested too deeply") !=
          std::string::npos);
    CHECK(messages(lsystem_of("derivation length: " + std::string(100'000, '-') + "1\n", "A", "A --> A\n"))
              .find("nested too deeply") != std::string::npos);
    std::string sum = "1";
    for (int i = 0; i < 300; ++i) sum += "+1";
    CHECK(value(sum) == 301);
    for (int i = 0; i < 100'000; ++i) sum += "+1";
    CHECK(messages(lsystem_of("derivation length: " + sum + "\n", "A", "A --> A\n")).find("too long") !=
          std::string::npos);
}

TEST_CASE("min and max of thousands of values are refused, not nested without bound", "[language]") {
    std::string values = "Q";
    for (int k = 0; k < 5000; ++k) values += ", Q";
    CHECK(messages(lsystem_of("", "A(min(" + values + "))", "")).find("too long") != std::string::npos);
    CHECK(messages(lsystem_of("", "A(max(Q, 1, 2, 3, 4, 5))", "")).empty());
}
