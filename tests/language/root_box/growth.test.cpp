// Root systems in the parameters of CRootBox and CPlantBox: without variation their lengths are those of the closed
// forms.
#include "catch.h"
#include "language/growing.h"
#include "language/notation_text.h"

#include <fmt/format.h>

#include <cmath>

using namespace espalier;
using Catch::Contains;

namespace {

const NotationText rparam{"rparam", "root.rparam"}, elements{"cplantbox", "root.xml"};

/// One type as CRootBox writes it; `laterals` is its lines of successors and chances.
std::string type_text(int type, double lb, double la, double ln, const std::string& most, double r, int gf,
                      const std::string& laterals = "successors 0\nsuccessorP 0\n") {
    return fmt::format(
        "# Parameter set for type\ntype\t{}\nname\tt{}\nlb\t{}\t0.5\nla\t{}\t0.5\nln\t{}\t0.3\n{}\t3\nr\t{}\t"
        "0.2\na\t0.04\t0.004\ncolor\t1 0.5 0\ntropism\t1 1.5 0.2\ndx\t0.25\n{}theta\t1.2\t0.1\n"
        "rlt\t1e9\t0\ngf\t{}\n",
        type, type, lb, la, ln, most, r, laterals, gf);
}

/// A setting of a model has another value.
std::string with_setting(std::string model, const std::string& name, const std::string& value) {
    const std::string begin = "#define " + name + " 1 ";
    REQUIRE(model.find(begin) != std::string::npos);
    return model.replace(model.find(begin), begin.size(), "#define " + name + " " + value + " ");
}

/// Lengths of the roots, cm, in the order of the string: what stands in brackets is one.
std::vector<double> root_lengths(const test::Grown& grown) {
    const Alphabet& alphabet = grown.model->alphabet;
    std::vector<double> lengths;
    std::vector<std::size_t> open;
    std::size_t at = 0;
    for (const LetterId letter : grown.string.letters) {
        if (letter == Alphabet::open_bracket) {
            open.push_back(lengths.size());
            lengths.push_back(0);
        }
        if (letter == Alphabet::close_bracket) open.pop_back();
        if (alphabet.name(letter) == "F") lengths.at(open.back()) += 100 * grown.string.parameters[at];
        at += static_cast<std::size_t>(alphabet.arity(letter));
    }
    return lengths;
}

std::vector<double> lengths_after(const std::string& model, double days, const std::string& dt) {
    test::Grown grown(with_setting(with_setting(model, "VARIATION", "0"), "DT", dt));
    grown.steps(static_cast<int>(std::lround(days / std::stod(dt))));
    return root_lengths(grown);
}

double exponential_length(double t, double k, double r) {
    return t > 0 ? k * (1 - std::exp(-r * t / k)) : 0;
}

double exponential_age(double length, double k, double r) {
    return -k / r * std::log(1 - length / k);
}

double sum_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum;
}

const std::string bears_2 = "successors 1 2\nsuccessorP 1 1\n";

}  // namespace

TEST_CASE("CRootBox: a root without successors approaches lmax, whatever lb and la say", "[root_box]") {
    const std::string model = rparam.model_of(type_text(1, 5, 7, 1, "lmax 40", 2, 1));
    for (const double t : {3.0, 21.0, 60.0}) {
        CHECK(sum_of(lengths_after(model, t, "3")) == Approx(exponential_length(t, 40, 2)).epsilon(1e-9));
    }
    CHECK(sum_of(lengths_after(model, 21, "0.7")) == Approx(exponential_length(21, 40, 2)).epsilon(1e-9));
}

TEST_CASE("CRootBox: with successors a root approaches lb + la + (nob - 1) ln, with the rounded nob", "[root_box]") {
    // (50 - 10 - 2) / 3 + 1 = 13.67, and so 14 laterals and k = 51.
    const std::string zero = "successors 1 2\nsuccessorP 1 0\n";
    const std::string model =
        rparam.model_of(type_text(1, 2, 10, 3, "lmax 50", 2, 1, zero) + type_text(2, 0, 0, 1, "lmax 4", 1, 1));
    CHECK(sum_of(lengths_after(model, 30, "1")) == Approx(exponential_length(30, 51, 2)).epsilon(1e-9));
    // The number of laterals may stand there itself: Zea mays, 120.4 laterals and so 120.
    const std::string by_number =
        rparam.model_of(type_text(1, 1, 5, 0.7, "nob 120.4", 3, 1, zero) + type_text(2, 0, 0, 1, "lmax 4", 1, 1));
    CHECK(sum_of(lengths_after(by_number, 10, "1")) ==
          Approx(exponential_length(10, 1 + 5 + 119 * 0.7, 3)).epsilon(1e-9));
    // lb and la are longer than lmax: one lateral, and k = lb + la.
    const std::string one =
        rparam.model_of(type_text(1, 8, 10, 3, "lmax 12", 2, 1, zero) + type_text(2, 0, 0, 1, "lmax 4", 1, 1));
    CHECK(sum_of(lengths_after(one, 30, "1")) == Approx(exponential_length(30, 18, 2)).epsilon(1e-9));
}

TEST_CASE("CRootBox: laterals emerge when the tip is la ahead of them", "[root_box]") {
    const double k = 51, r = 2, lb = 2, la = 10, ln = 3;
    const std::string model =
        rparam.model_of(type_text(1, lb, la, ln, "lmax 50", r, 1, bears_2) + type_text(2, 0, 0, 1, "lmax 4", 1, 1));
    for (const std::string dt : {"1", "0.5", "4"}) {
        for (const double t : {8.0, 20.0, 44.0}) {
            double expected = exponential_length(t, k, r);
            for (int i = 0; i < 13; ++i) {  // the last emerges at the end of time
                expected += exponential_length(t - exponential_age(lb + i * ln + la, k, r), 4, 1);
            }
            INFO(dt << " " << t);
            CHECK(sum_of(lengths_after(model, t, dt)) == Approx(expected).epsilon(1e-9));
        }
    }
}

TEST_CASE("CRootBox: growth that is linear, and ends with a root's life", "[root_box]") {
    const std::string linear = rparam.model_of(type_text(1, 0, 0, 1, "lmax 40", 2, 2));
    CHECK(sum_of(lengths_after(linear, 7, "1")) == Approx(14).epsilon(1e-9));
    CHECK(sum_of(lengths_after(linear, 30, "1")) == Approx(40).epsilon(1e-9));
    std::string text = type_text(1, 0, 0, 1, "lmax 40", 2, 1);
    text.replace(text.find("rlt\t1e9"), 7, "rlt\t5");
    CHECK(sum_of(lengths_after(rparam.model_of(text), 20, "2")) == Approx(exponential_length(5, 40, 2)).epsilon(1e-9));
}

TEST_CASE("CRootBox: successors have their chances, and none grows for what is left of 1", "[root_box]") {
    // 400 laterals, of which .5 are of type 2 (1 cm), .3 of type 3 (10 cm), and .2 are none.
    const std::string model =
        rparam.model_of(type_text(1, 0, 0.001, 0.1, "lmax 40", 200, 2, "successors 2 2 3\nsuccessorP 2 0.5 0.3\n") +
                        type_text(2, 0, 0, 1, "lmax 1", 100, 2) + type_text(3, 0, 0, 1, "lmax 10", 100, 2));
    std::map<int, int> of_length;
    for (const double length : lengths_after(model, 10, "1")) ++of_length[static_cast<int>(std::lround(length))];
    const int laterals = of_length[1] + of_length[10] + of_length[0];
    CHECK(laterals == Approx(400).margin(1));
    // Within four standard deviations.
    CHECK(of_length[1] == Approx(200).margin(40));
    CHECK(of_length[10] == Approx(120).margin(37));
}

TEST_CASE("CRootBox: deviations make roots differ around the mean", "[root_box]") {
    const std::string model = rparam.model_of(type_text(1, 0, 0.001, 0.1, "lmax 40", 200, 2, bears_2) +
                                              type_text(2, 0, 0, 1, "lmax 20", 100, 2));
    std::string without_turns = with_setting(model, "WIGGLE", "0");
    test::Grown grown(without_turns);
    grown.steps(10);
    const std::vector<double> lengths = root_lengths(grown);
    double mean = 0, square = 0;
    int count = 0;
    for (const double length : lengths) {
        if (length < 0.1 || length > 35) continue;
        mean += length, square += length * length, ++count;
    }
    mean /= count;
    REQUIRE(count > 350);
    CHECK(mean == Approx(20).margin(4 * 3 / std::sqrt(count)));
    CHECK(std::sqrt(square / count - mean * mean) == Approx(3).margin(0.5));
}

TEST_CASE("CPlantBox: the same parameters as elements make the same model", "[root_box]") {
    const std::string xml =
        "<?xml version=\"1.0\"?>\n<plant name=\"p\"><organ type=\"root\" name=\"t1\" subType=\"1\">"
        "<parameter name=\"lb\" value=\"2\" dev=\"0.5\"/><parameter name=\"la\" value=\"10\" dev=\"0.5\"/>"
        "<parameter name=\"ln\" value=\"3\" dev=\"0.3\"/><parameter name=\"lmax\" value=\"50\" dev=\"3\"/>"
        "<parameter name=\"r\" value=\"2\" dev=\"0.2\"/><parameter name=\"a\" value=\"0.04\" dev=\"0.004\"/>"
        "<parameter name=\"tropismT\" value=\"1\"/><parameter name=\"tropismN\" value=\"1.5\"/>"
        "<parameter name=\"tropismS\" value=\"0.2\"/><parameter name=\"dx\" value=\"0.25\"/>"
        "<parameter name=\"successor\" number=\"0\" type=\"2\" percentage=\"1\"/>"
        "<parameter name=\"theta\" value=\"1.2\" dev=\"0.1\"/><parameter name=\"gf\" value=\"1\"/></organ>"
        "<organ type=\"root\" name=\"t2\"><parameter name=\"subType\" value=\"2\"/><parameter name=\"lb\" value=\"0\" "
        "dev=\"0.5\"/><parameter name=\"la\" value=\"0\" dev=\"0.5\"/><parameter name=\"ln\" value=\"1\" dev=\"0.3\"/>"
        "<parameter name=\"lmax\" value=\"4\" dev=\"3\"/><parameter name=\"r\" value=\"1\" dev=\"0.2\"/>"
        "<parameter name=\"a\" value=\"0.04\" dev=\"0.004\"/><parameter name=\"theta\" value=\"1.2\" dev=\"0.1\"/>"
        "<parameter name=\"tropismN\" value=\"1.5\"/></organ></plant>";
    const auto without_head = [](const std::string& text) { return text.substr(text.find("#define VARIATION")); };
    CHECK(without_head(elements.model_of(xml)) ==
          without_head(rparam.model_of(type_text(1, 2, 10, 3, "lmax 50", 2, 1, bears_2) +
                                       type_text(2, 0, 0, 1, "lmax 4", 1, 1))));
}

TEST_CASE("CPlantBox: basal roots begin as the seed says", "[root_box]") {
    const std::string xml =
        "<plant><organ type=\"seed\" name=\"s\" subType=\"0\"><parameter name=\"firstB\" value=\"2\"/><parameter "
        "name=\"delayB\" value=\"3\"/><parameter name=\"maxB\" value=\"4\"/><parameter name=\"seedPos.z\" "
        "value=\"-3\"/>"
        "</organ><organ type=\"root\" name=\"basal\" subType=\"4\"><parameter name=\"lmax\" value=\"30\"/><parameter "
        "name=\"r\" value=\"1\"/><parameter name=\"a\" value=\"0.03\"/><parameter name=\"theta\" value=\"1\"/></organ>"
        "</plant>";
    const std::string model = elements.model_of(xml);
    CHECK_THAT(model, Contains("axiom: ^(180) f(CM * 3) D(4, 2)"));
    for (const std::string dt : {"1", "4"}) {
        double expected = 0;
        for (int i = 0; i < 4; ++i) expected += exponential_length(8 - (2 + 3 * i), 30, 1);
        INFO(dt);
        CHECK(sum_of(lengths_after(model, 8, dt)) == Approx(expected).epsilon(1e-9));
    }
}

TEST_CASE("CRootBox: what has no equal is named", "[root_box]") {
    const auto warnings = [](const std::string& text) {
        std::string all;
        for (const Diagnostic& each :
             language::translated(*registered<language::NotationType>().at("rparam"), text, "root.rparam").warnings) {
            all += each.message + "\n";
        }
        return all;
    };
    std::string plagio = type_text(1, 2, 10, 3, "lmax 50", 2, 1, bears_2) + type_text(5, 0, 0, 1, "lmax 4", 1, 3);
    plagio.replace(plagio.find("tropism\t1"), 9, "tropism\t0");
    const std::string said = warnings(plagio);
    CHECK_THAT(said, Contains("type 1 (t1) has plagiotropism, which has no equal here"));
    CHECK_THAT(said, Contains("type 1 (t1) bears type 2, which is not there"));
    CHECK_THAT(said, Contains("type 5 (t5) has the growth function 3"));
    CHECK_THAT(said, Contains("type 5 (t5) is borne by no other"));
    CHECK_THAT(said, Contains("the best of N = 1.5 directions"));
    CHECK_THAT(said, Contains("colours of types"));
    CHECK_THAT(said, Contains("ln varies from root to root"));
}

TEST_CASE("CRootBox: mistakes have their place", "[root_box]") {
    CHECK_THAT(rparam.mistake(""), Contains("no types of roots"));
    CHECK_THAT(rparam.mistake("type 1\nname a\nlb x 0\n"), Contains("root.rparam:3:4: lb is a number, not 'x'"));
    CHECK_THAT(rparam.mistake("type 1\nname a\nlb 1"), Contains("the file ends where lb should stand"));
    CHECK_THAT(rparam.mistake("type 1.5\n"), Contains("a whole number from 0 to 99"));
    CHECK_THAT(rparam.mistake(type_text(1, 2, 10, 3, "lmax 50", 2, 1, "successors 1 2\nsuccessorP 2 1 0\n")),
               Contains("as many chances"));
    CHECK_THAT(elements.mistake("<plant/>"), Contains("no <organ type=\"root\">"));
    CHECK_THAT(elements.mistake("<plant><organ type=\"root\"><parameter name=\"r\" value=\"fast\"/></organ></plant>"),
               Contains("r is a number, not 'fast'"));
}
