// Sections 6, 7, 13 and 14 of docs/language.md: statements, expressions, functions, additions.
#include "conformance.h"

#include <cmath>

using namespace espalier;
using namespace espalier::language;
using namespace espalier::test;

namespace {

/// The value of an expression, to the six digits that are printed.
std::string printed_value(const std::string& expression, const std::string& start = "") {
    const std::string text = derived(lsystem_of("Start: {" + start + "}\n", "A(" + expression + ")", "B --> C\n"));
    return text.substr(2, text.size() - 3);
}

}  // namespace

TEST_CASE("6 statements", "[conformance]") {
    quote(
        "A statement is an assignment to a variable or an array element, an expression, `if` with or without `else`, "
        "`while` or `do`. Bodies are always in braces.");
    CHECK(derived(lsystem_of("define: { array sum[4]; }\nStart: {\n    i = 0;\n"
                             "    while (i < 4) { sum[i] = 2 ^ i; i = i + 1; }\n"
                             "    do { i = i - 1; } while (i > 0);\n"
                             "    if (sum[3] == 8) { ok = 1; } else { ok = 0; }\n}\n",
                             "A(ok, i, sum[2])", "B --> C\n")) == "A(1,0,4)");
    CHECK(printed_value("n", "if (0) { n = 1; } else { n = 2; }") == "2");
    CHECK(printed_value("n", "if (0)\n{\nn = 1;\n}") == "0");
    CHECK(printed_value("n", "n = m = 3; n + 1;") == "3");
    CHECK(printed_value("n", "n\n= 2; n\n += m\n= 3;") == "5");
    CHECK(mistake(lsystem_of("Start: { if (1) n = 2; }\n", "A", "A --> A\n")).find("'{' to begin a block") !=
          std::string::npos);
    quote("A `;` ends a statement. It is optional before a closing brace, and allowed after one or alone.");
    CHECK(printed_value("n", "if (1) { n = 1; }; ; n = n + 1") == "2");
}

TEST_CASE("6 operators", "[conformance]") {
    quote(
        "Operators, from the highest precedence: `!`; unary `-`; `^`; `*` `/` `%`; `+` `-`; `<` `<=` `>` `>=`; `==` "
        "`!=` `<>`; `&&`; `||`; `? :`; `=`.");
    CHECK(printed_value("!0 + 1") == "2");
    CHECK(printed_value("2 * 3 ^ 2") == "18");
    CHECK(printed_value("1 + 2 * 3 - 8 / 4 % 3") == "5");
    CHECK(printed_value("1 + 1 < 3") == "1");
    CHECK(printed_value("3 > 2 == 1") == "1");
    CHECK(printed_value("0 && 0 || 1") == "1");
    CHECK(printed_value("1 || 0 && 0") == "1");
    CHECK(printed_value("0 ? 1 : 0 ? 2 : 3") == "3");
    CHECK(printed_value("1 == 2 && 3") == "0");
    quote(
        "All binary operators associate to the left, so `2^3^2` is 64. Unary minus has a higher precedence than `^`, "
        "so `-2^2` is 4.");
    CHECK(printed_value("2^3^2") == "64");
    CHECK(printed_value("-2^2") == "4");
    CHECK(printed_value("2^-1") == "0.5");
    CHECK(printed_value("8 - 4 - 2") == "2");
    CHECK(printed_value("16 / 4 / 2") == "2");
    quote("`<>` is the same as `!=`. `%` first truncates both operands to whole numbers. Comparisons give 1 or 0.");
    CHECK(printed_value("(1 <> 2) + (1 != 1) + (2 <= 2) + (2 >= 3)") == "2");
    CHECK(printed_value("7.9 % 3.9") == "1");
    CHECK(printed_value("-7 % 3") == "-1");
    quote("`&&`, `||` and `? :` evaluate only the operands that they need.");
    CHECK(printed_value("n", "0 && (n = 1); 1 || (n = 2); x = 1 ? 3 : (n = 4);") == "0");
    quote(
        "Division by zero is an error that names the place and the module; with `--arithmetic cpfg`, the divisor is 1. "
        "A "
        "parameter that is infinite or not a number is an error too.");
    const std::string division = lsystem_of("derivation length: 1\n", "A(0)", "A(x) --> B(3 / x)\n");
    CHECK(mistake(division).find("model.l:4:14") != std::string::npos);
    CHECK(mistake(lsystem_of("", "A(1 / 0)", "B --> C\n")).find("division by zero: 1 / 0") != std::string::npos);
    CHECK(printed_value("n", "if (0) { n = 1 / 0; } else { n = 2 > 1 ? 3 : 5 % 0; }") == "3");
    ReadOptions cpfg;
    cpfg.arithmetic = Arithmetic::cpfg;
    CHECK(derived(division, cpfg) == "B(3)");
    CHECK_FALSE(mistake(lsystem_of("derivation length: 1\n", "A(-1)", "A(x) --> B(sqrt(x))\n")).empty());
    CHECK_FALSE(mistake(lsystem_of("derivation length: 1\n", "A(1000)", "A(x) --> B(exp(x))\n")).empty());
}

TEST_CASE("7 functions of numbers", "[conformance]") {
    quote("angles in degrees; `atan(x, y)` with two arguments is the angle of the point (x, y)");
    CHECK(printed_value("sin(30), cos(60), tan(45)") == "0.5,0.5,1");
    CHECK(printed_value("asin(0.5), acos(0.5), atan(1)") == "30,60,45");
    CHECK(printed_value("atan(0, 2), atan(-1, 0), atan2(1, 0)") == "90,180,90");
    CHECK(printed_value("exp(1), log(exp(2)), sqrt(16), fabs(-3), floor(-1.5), ceil(-1.5)") == "2.71828,2,4,3,-2,-1");
    quote("-1, 0 or 1; x truncated to a whole number (with `--arithmetic cpfg`: x rounded)");
    CHECK(printed_value("sign(-3), sign(0), sign(0.1)") == "-1,0,1");
    CHECK(printed_value("trunc(2.5), trunc(-2.5)") == "2,-2");
    ReadOptions cpfg;
    cpfg.arithmetic = Arithmetic::cpfg;
    CHECK(derived(lsystem_of("", "A(trunc(2.5))", "B --> C\n"), cpfg) == "A(3)");
}

TEST_CASE("7 random numbers", "[conformance]") {
    const auto mean = [](const std::string& expression) {
        const std::string start = "i = 0; while (i < 20000) { s = s + " + expression + "; i = i + 1; }";
        return std::stod(printed_value("s / i", start));
    };
    quote("uniform from 0 to x");
    CHECK(mean("ran(3)") == Approx(1.5).margin(0.03));
    CHECK(mean("(ran(3) >= 0) * (ran(3) <= 3)") == 1);
    quote("normal, beta and binomial");
    CHECK(mean("nran(2, 3)") == Approx(2).margin(0.1));
    CHECK(mean("(nran(2, 3) - 2) ^ 2") == Approx(9).margin(0.5));
    CHECK(mean("bran(2, 3)") == Approx(0.4).margin(0.01));
    CHECK(mean("biran(10, 0.3)") == Approx(3).margin(0.06));
    quote("restarts the random numbers with seed s");
    CHECK(printed_value("a == b", "srand(5); a = ran(1); srand(5); b = ran(1);") == "1");
    CHECK(printed_value("a == b", "srand(5); a = ran(1); srand(6); b = ran(1);") == "0");
}

TEST_CASE("7 printf, stop, the derivation length", "[conformance]") {
    quote("writes to standard error");
    std::string printed;
    DerivationSettings settings;
    settings.printout = std::make_shared<Printout>([&](const std::string& text) { printed += text; });
    derived(lsystem_of("derivation length: 1\n", "A(2)", "A(x) : {printf(\"%g of %d%s\\n\", x, 3, \"!\");} --> A(x)\n"),
            {}, settings);
    CHECK(printed == "2 of 3!\n");
    quote("ends the derivation after this step");
    CHECK(step("A(0)", "A(x) --> A(x + 1)\n", "derivation length: 9\nEndEach: { if (Q == 3) { stop(1); } }\n") ==
          "A(3)");
    quote("ends the run at once with this message and the model's line, with exit code 2");
    CHECK_THROWS_WITH(step("A(2)", "A(x) : {error(\"%g is too much for %s\", x, \"A\");} --> A(x)\n"),
                      Catch::Contains("2 is too much for A") && Catch::Contains("model.l:"));
    quote("| `Display(x)`, `play(\"file\")` | no effect |");
    CHECK(step("A(0)", "A(x) : {Display(x); play(\"leaf.wav\");} --> A(x + 1)\n") == "A(1)");
    quote("the derivation length");
    CHECK(step("A(0)", "A(x) --> A(x + 1)\n",
               "derivation length: 9\nStartEach: { SetDerivationLength(GetDerivationLength() - 1); }\n") == "A(5)");
}

TEST_CASE("13 additions to statements and functions", "[conformance]") {
    quote("`+= -= *= /= ++ --`, `for`, `break` and `else if` work as in C; `break` leaves the innermost loop.");
    CHECK(
        derived("lsystem: 1\nStart: { for (i = 0; i < 10; i++) { sum += i; if (sum > 20) { break; } else if (sum > 10) "
                "{ sum -= 1; } } last = i; }\naxiom: A(sum, last)\nA --> B\nendlsystem\n") == "A(26,7)");
    CHECK(printed_value("n, a", "n = 3; n *= 4; n /= 6; a = 5; --a; a++; ++a;") == "2,6");
    CHECK(printed_value("n", "for (i = 0; i < 3; i++) { while (1) { n++; break; } }") == "3");
    quote(
        "`min max abs round pow clamp(x, low, high) lerp(a, b, t) noise(x, y, z) atan2(y, x)` are functions, and `pi` "
        "and `e` are numbers. All are ordinary names: if a model assigns one, it becomes a variable.");
    CHECK(printed_value("min(3, 1, 2), max(3, 1), abs(-2), round(2.5), pow(2, 3), clamp(7, 0, 5), lerp(2, 4, 0.5)") ==
          "1,3,2,3,8,5,3");
    CHECK(printed_value("noise(1, 2, 3), noise(0.5, 0, 0) <= 1") == "0,1");
    CHECK(printed_value("pi, e") == "3.14159,2.71828");
    CHECK(printed_value("e, max, min * (2)", "e = 7; max = 3; min = 4;") == "7,3,8");
}

TEST_CASE("13 declared modules, processes, constants, symbols", "[conformance]") {
    quote(
        "A declared module must have one of the declared numbers of parameters. `?E ?P ?H ?L ?U ?Q` always keep their "
        "meaning.");
    const std::string declared =
        "environment light;\nmodule Apex(age, vigour), A(x), Internode(length);\nconst turn = 360 / 1.618^2;\n";
    CHECK(derived(declared + lsystem_of("derivation length: 1\n", "Apex(0, 1)?light(1)?E(2)A(3)",
                                        "Apex(age, vigour) > ?light(q) : q > 0.5 --> Internode(1)[+(turn)]\n"
                                        "E(x) --> E(x + 1)\nA(x) --> A(x + 1)\n")) ==
          "Internode(1)[+(137.514)]?light(1)?E(3)A(4)");
    CHECK(mistake(declared + lsystem_of("", "Apex(1)", "A(x) --> B\n")).find("declared with 2 parameters") !=
          std::string::npos);
    quote(
        "`environment ...;`, `module ...;`, `const ...;` and `field ...;` are written before `lsystem:` or in its "
        "header.");
    CHECK(derived("lsystem: 1\nconst n = 2;\nmodule Bud;\nderivation length: n\naxiom: Bud\nBud --> BudB\n"
                  "endlsystem\n") == "BudBB");
    quote("A symbol may be any Unicode character.");
    CHECK(step("\xC3\xA9\xE2\x9D\x80(1)", "\xE2\x9D\x80(x) --> \xC3\xA9\n") == "\xC3\xA9\xC3\xA9");
    quote(
        "A scene (`define = { ANGLE = 30 }`) or the command line (`--define ANGLE=30`) can replace a `#define`; the "
        "definition in the file is then ignored. A name that the file neither defines nor tests is refused.");
    ReadOptions options;
    options.defines = {{"ANGLE", "30"}};
    CHECK(derived("#define ANGLE 25\n" + lsystem_of("derivation length: 1\n", "A", "A --> +(ANGLE)\n"), options) ==
          "+(30)");
    CHECK(mistake(lsystem_of("", "A", "A --> +(ANGLE)\n"), options).find("cannot be overridden") != std::string::npos);
}

TEST_CASE("13.4 a declared process may have a default", "[conformance]") {
    quote(
        "Several values, in braces, are for as many parameters: `environment wind = { 0, 0, 1 };`. The others keep "
        "what the model wrote. A default is an "
        "expression whose value is known before anything grows.");
    const std::string rest = lsystem_of("", "A?light(1)", "A?light(q) --> A\n");
    const auto model =
        read("#define N 4\nconst k = 3;\nenvironment light = k * N, water, wind = { 0, -1,\n 2 };\n" + rest);
    CHECK(model->processes == std::vector<std::string>{"light", "water", "wind"});
    CHECK(model->default_answers == std::map<std::string, std::vector<double>>{{"light", {12}}, {"wind", {0, -1, 2}}});
    CHECK(mistake("environment light = ran(1);\n" + rest).find("the default of 'light' has no value") !=
          std::string::npos);
    CHECK(mistake("environment light = { 1, 2;\n" + rest).find("expected '}' after the default of 'light'") !=
          std::string::npos);
    CHECK(mistake("environment light = 1;\nenvironment light = 2;\n" + rest).find("already has another default") !=
          std::string::npos);
    CHECK(read("environment light = 1;\nenvironment light;\n" + rest)->default_answers.size() == 1);
}

TEST_CASE("14 differences", "[conformance]") {
    quote(
        "A line that begins with `#` is a directive only if the directive is known: `#5 F` contains modules. A double "
        "quote without a closing quote ends at the end of its line, not of the file.");
    CHECK(step("A", "#define W 3\n/* 5\" pot */\n// 6\" pot\nA --> F(W)\n") == "F(3)");
    quote("Brackets need not match; a warning says so.");
    CHECK(step("A[B", "A --> B\n") == "B[B");
    CHECK(step("A]B", "A --> B]\n") == "B]]B");
}
