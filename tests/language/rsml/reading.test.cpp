// Measured roots: axes, units, nodes with times, and what is no RSML.
#include "catch.h"
#include "language/notation_text.h"

using namespace espalier;

namespace {

const NotationText rsml{"rsml", "root.rsml"};

std::string model_of_rsml(const std::string& text) {
    return rsml.model_of(text);
}

std::string mistake_of_rsml(const std::string& text) {
    return rsml.mistake(text);
}

std::string file(const std::string& metadata, const std::string& roots) {
    return "<?xml version=\"1.0\"?>\n<rsml><metadata>" + metadata + "</metadata><scene><plant ID=\"1\">" + roots +
           "</plant></scene></rsml>\n";
}

std::string root(const std::string& points, const std::string& rest = "") {
    return "<root ID=\"1\" label=\"r\"><geometry><polyline>" + points + "</polyline></geometry>" + rest + "</root>";
}

const std::string straight =
    "<point x=\"0\" y=\"0\" z=\"0\"/><point x=\"0\" y=\"0\" z=\"-2\"/><point x=\"0\" y=\"0\" z=\"-5\"/>";

}  // namespace

TEST_CASE("RSML: roots of CPlantBox, in cm and with z upwards, hang down in metres", "[rsml]") {
    CHECK_THAT(model_of_rsml(file("<unit>cm</unit><resolution>1</resolution>", root(straight))),
               Catch::Contains("!(0.0005) @R(0, -1, 0) F(0.02) !(0.0005) @R(0, -1, 0) F(0.03) Tip(0)"));
    // z downwards, and a picture.
    CHECK_THAT(
        model_of_rsml(file("<unit>m</unit>", root("<point x=\"0\" y=\"0\" z=\"0\"/><point x=\"0\" y=\"0\" z=\"2\"/>"))),
        Catch::Contains("@R(0, -1, 0) F(2)"));
    CHECK_THAT(model_of_rsml(file("<unit>cm</unit><resolution>100</resolution>",
                                  root("<point x=\"0\" y=\"0\"/><point x=\"0\" y=\"200\"/>"))),
               Catch::Contains("@R(0, -1, 0) F(0.02)"));
}

TEST_CASE("RSML: a lateral stands on the node that the file names, or on the nearest", "[rsml]") {
    const std::string lateral = "<point x=\"0\" y=\"0\" z=\"-2\"/><point x=\"1\" y=\"0\" z=\"-2\"/>";
    const std::string expected = "F(0.02)\n\t[!(0.0005) @R(1, 0, 0) F(0.01) Tip(1)] !(0.0005)";
    CHECK_THAT(model_of_rsml(file("", root(straight, root(lateral)))), Catch::Contains(expected));
    CHECK_THAT(
        model_of_rsml(file("", root(straight, root(lateral, "<properties><parent-node value=\"1\"/></properties>")))),
        Catch::Contains(expected));
}

TEST_CASE("RSML: nodes with times appear on their days", "[rsml]") {
    const std::string times =
        "<functions><function name=\"diameter\" "
        "domain=\"polyline\"><sample>0.1</sample><sample>0.1</sample><sample>0.05"
        "</sample></function><function name=\"node_creation_time\" domain=\"polyline\"><sample "
        "value=\"0\"/><sample>1</sample><sample>2.5</sample></function></functions>";
    const std::string text = model_of_rsml(file("<unit>cm</unit>", root(straight, times)));
    CHECK_THAT(text, Catch::Contains("derivation length: 2.5 / DT + 0.999"));
    CHECK_THAT(text, Catch::Contains("Node(1, 0, -1, 0, 0.02, 0.001) Node(2.5, 0, -1, 0, 0.03, 0.0005)"));
}

TEST_CASE("RSML: what is no RSML is refused at its place", "[rsml]") {
    using Catch::Contains;
    CHECK_THAT(mistake_of_rsml("<rsml><scene>"), Contains("root.rsml:1:"));
    CHECK_THAT(mistake_of_rsml("<html/>"), Contains("outermost element"));
    CHECK_THAT(mistake_of_rsml(""), Contains("root.rsml"));
    CHECK_THAT(mistake_of_rsml(file("", "")), Contains("no roots"));
    CHECK_THAT(mistake_of_rsml(file("<unit>parsec</unit>", root(straight))), Contains("parsec"));
    CHECK_THAT(mistake_of_rsml(file("", root("<point x=\"nan\" y=\"0\"/>"))), Contains("root.rsml:2:"));
    CHECK_THAT(mistake_of_rsml(file("", root("<point y=\"0\"/>"))), Contains("x is a number"));
    CHECK_THAT(mistake_of_rsml(file("", root("<root/>"))), Contains("no root of this file has points"));
    CHECK_THAT(mistake_of_rsml("<!DOCTYPE r [<!ENTITY a \"b\">]><rsml>&a;</rsml>"), Contains("entities"));
    std::string deep;
    for (int i = 0; i < 200; ++i) deep += "<root><geometry><polyline><point x=\"0\" y=\"0\"/></polyline></geometry>";
    CHECK_THAT(mistake_of_rsml("<rsml><scene><plant>" + deep), Contains("nested"));
}
