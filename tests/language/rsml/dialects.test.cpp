// RSML as programs write it: each habit in a small file whose lengths and diameters are known.
#include "language/measured_file.h"

using namespace espalier;
using Catch::Contains;

namespace {

const MeasuredText rsml_file{"rsml", "root.rsml"};

std::string rsml_document(const std::string& metadata, const std::string& scene) {
    return "<?xml version=\"1.0\"?>\n<rsml><metadata>" + metadata + "</metadata><scene>" + scene + "</scene></rsml>\n";
}

std::string root_plant(const std::string& roots, const std::string& attributes = "") {
    return "<plant" + attributes + ">" + roots + "</plant>";
}

std::string root_line(const std::string& points) {
    return "<geometry><polyline>" + points + "</polyline></geometry>";
}

std::string point_at(double x, double y, double z) {
    return "<point x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(y) + "\" z=\"" + std::to_string(z) + "\"/>";
}

const std::string in_cm = "<unit>cm</unit><resolution>1</resolution><up>z</up>";
/// 20 cm downwards, with a node at 10 cm.
const std::string tap = root_line(point_at(0, 0, 0) + point_at(0, 0, -10) + point_at(0, 0, -20));

/// One plant in cm, z upwards, of a tap root that holds this beside its line.
language::MeasuredPlants tap_with(const std::string& content, const std::string& metadata = in_cm) {
    return rsml_file.read(rsml_document(metadata, root_plant("<root ID=\"1\">" + tap + content + "</root>")));
}

std::vector<double> root_diameters(const language::MeasuredPlants& plants, std::size_t axis = 0) {
    std::vector<double> values;
    for (const language::MeasuredNode& node : plants.axes.at(axis).nodes) values.push_back(node.diameter);
    return values;
}

std::vector<double> root_days(const language::MeasuredPlants& plants, std::size_t axis = 0) {
    std::vector<double> values;
    for (const language::MeasuredNode& node : plants.axes.at(axis).nodes) values.push_back(node.day);
    return values;
}

auto near_values(const std::vector<double>& values) {
    return Catch::Matchers::Approx(values).margin(1e-12);
}

}  // namespace

TEST_CASE("RSML: points count only in geometry/polyline", "[rsml]") {
    const auto plants = rsml_file.read(rsml_document(
        in_cm, root_plant("<root ID=\"1\">" + tap + "<annotations><annotation name=\"a\">" + point_at(50, 0, 0) +
                          "<value>1</value></annotation></annotations></root><annotations/>") +
                   "<annotations><annotation>" + point_at(9, 9, 9) + "</annotation></annotations>"));
    check_measures(plants, {1, 1, 0.20, {0, 0.20, 0}});
    CHECK_THAT(warnings_of(plants), Contains("element <annotations> is not used (3 places)"));
    CHECK_THAT(warnings_of(plants), !Contains("point"));
}

TEST_CASE("RSML: a lateral divides the segment of its parent on which it begins", "[rsml]") {
    const auto plants = tap_with("<root>" + root_line(point_at(0, 0, -4) + point_at(5, 0, -4)) + "</root>");
    check_measures(plants, {1, 2, 0.25, {0.05, 0.20, 0}});
    REQUIRE(plants.axes[0].nodes.size() == 4);
    CHECK(plants.axes[1].on_node == 1);
    CHECK(plants.axes[0].order == 0);
    CHECK(plants.axes[1].order == 1);
}

TEST_CASE("RSML: a lateral that begins beside its parent hangs on the nearest point by a link", "[rsml]") {
    const auto plants = tap_with("<root>" + root_line(point_at(1, 0, -4) + point_at(6, 0, -4)) + "</root>");
    check_measures(plants, {1, 2, 0.25, {0.06, 0.20, 0}, 0.01});
    const glm::dvec3 hangs_on = plants.axes[0].nodes[plants.axes[1].on_node].at;
    CHECK(glm::distance(hangs_on, {0, -0.04, 0}) < 1e-12);
    // No wood and no surface: the model moves there.
    CHECK_THAT(measured_model_text(plants), Contains(") f(0.01) !(0.0005) @R(1, 0, 0) F(0.05) Tip(1)]"));
}

TEST_CASE("RSML: parent-node counts from 0, as an attribute, a property or a text", "[rsml]") {
    const std::string lateral = root_line(point_at(1, 0, -4) + point_at(6, 0, -4));
    const std::string root = GENERATE_COPY("<root parent-node=\"1\">" + lateral,
                                           "<root>" + lateral + "<properties><parent-node value=\"1\"/></properties>",
                                           "<root><properties><Parent-Node>1</Parent-Node></properties>" + lateral);
    const auto plants = tap_with(root + "</root>");
    check_measures(plants, {1, 2, 0.25, {0.06, 0.20, 0}, std::hypot(0.01, 0.06)});
    CHECK(glm::distance(plants.axes[0].nodes[plants.axes[1].on_node].at, {0, -0.10, 0}) < 1e-12);
}

TEST_CASE("RSML: a parent-node that is not there, or counts from 1, is told", "[rsml]") {
    const std::string lateral = root_line(point_at(0, 0, -10) + point_at(5, 0, -10));
    const auto beyond = tap_with("<root parent-node=\"3\">" + lateral + "</root>");
    CHECK_THAT(warnings_of(beyond), Contains("parent-node beyond the last point"));
    check_measures(beyond, {1, 2, 0.25, {0.05, 0.20, 0}});
    const auto from_one = tap_with("<root parent-node=\"2\">" + lateral + "</root>");
    CHECK_THAT(warnings_of(from_one), Contains("counts from 0"));
    check_measures(from_one, {1, 2, 0.25, {0.05, 0.20, 0}});
    CHECK_THAT(warnings_of(tap_with("<root parent-node=\"-1\">" + lateral + "</root>")), !Contains("parent-node"));
}

TEST_CASE("RSML: roots without points are left out and counted, and what they bear hangs on their bearer", "[rsml]") {
    const auto plants =
        tap_with("<root/><root><root>" + root_line(point_at(0, 0, -10) + point_at(5, 0, -10)) + "</root></root>");
    check_measures(plants, {1, 2, 0.25, {0.05, 0.20, 0}});
    CHECK(plants.axes[1].order == 1);
    CHECK_THAT(warnings_of(plants), Contains("a root has no points and is left out; what it bears is borne by its "
                                             "bearer (2 places)"));
}

TEST_CASE("RSML: a second polyline of a root is joined by a link", "[rsml]") {
    const auto plants = rsml_file.read(rsml_document(
        in_cm,
        root_plant("<root><geometry><polyline>" + point_at(0, 0, 0) + point_at(0, 0, -5) + "</polyline><polyline>" +
                   point_at(0, 0, -7) + point_at(0, 0, -20) + "</polyline></geometry></root>")));
    check_measures(plants, {1, 1, 0.18, {0, 0.20, 0}, 0.02});
}

TEST_CASE("RSML: elements in other letters, and with prefixes", "[rsml]") {
    const auto plants = rsml_file.read(
        "<r:RSML xmlns:r=\"a\"><r:Metadata><r:Unit> cm </r:Unit><r:Up>Z</r:Up></r:Metadata><r:Scene><r:Plant><r:Root>"
        "<r:Geometry><r:Polyline><r:Point X=\"0\" Y=\"0\" Z=\"0\"/><r:Point X=\"0\" Y=\"0\" Z=\"-20\"/></r:Polyline>"
        "</r:Geometry></r:Root></r:Plant></r:Scene></r:RSML>");
    check_measures(plants, {1, 1, 0.20, {0, 0.20, 0}});
}

TEST_CASE("RSML: a diameter is a function or a property, and a radius is half of it", "[rsml]") {
    const std::string samples = "<sample>0.2</sample><sample value=\"0.1\"/><Sample>0.1</Sample>";
    const std::string content = GENERATE_COPY(
        "<functions><function name=\"diameter\" domain=\"polyline\">" + samples + "</function></functions>",
        "<functions><function1 name=\"rootDiameter\" domain=\"polyline\">" + samples + "</function1></functions>",
        "<functions><functions name=\"diameter\" domain=\"polyline\">" + samples + "</functions></functions>",
        "<functions name=\"diameter\" domain=\"polyline\">" + samples + "</functions>",
        "<functions><function name=\"radius\"><sample>0.1</sample><sample>0.05</sample><sample>0.05</sample>"
        "</function></functions>");
    const auto plants = tap_with(content);
    CHECK_THAT(root_diameters(plants), near_values({0.002, 0.001, 0.001}));
    CHECK(plants.warnings.empty());
    CHECK(summary_of(plants).surface == Approx(3.14159265358979 * 0.001 * 0.2));
}

TEST_CASE("RSML: a property gives a root one diameter", "[rsml]") {
    const std::string property =
        GENERATE("<diameter value=\"0.2\"/>", "<diameter> 0.2 </diameter>", "<radius value=\"0.1\"/>",
                 "<rootDiameter>0.2</rootDiameter>", "<property name=\"diameter\" value=\"0.2\"/>");
    const auto plants = tap_with("<properties>" + std::string(property) + "</properties>");
    CHECK_THAT(root_diameters(plants), near_values({0.002, 0.002, 0.002}));
    CHECK(plants.warnings.empty());
}

TEST_CASE("RSML: a function goes before a property, which is told", "[rsml]") {
    const auto plants = tap_with(
        "<properties><diameter>9</diameter></properties><functions><function name=\"diameter\"><sample>0.1</sample>"
        "</function><function name=\"radius\"><sample>7</sample></function></functions>");
    CHECK_THAT(root_diameters(plants), near_values({0.001, 0.001, 0.001}));
    CHECK_THAT(warnings_of(plants), Contains("property 'diameter' is not used"));
    CHECK_THAT(warnings_of(plants), Contains("function 'radius' is not used"));
}

TEST_CASE("RSML: samples along the length, and evenly spread, are read at the points", "[rsml]") {
    // 0.4 cm at the base and 0 at the tip: half at the point in the middle.
    const std::string function = GENERATE(
        "domain=\"length\"><sample position=\"0\" value=\"0.4\"/><sample position=\"20\" value=\"0\"/>",
        "domain=\"length\"><sample position=\"20\">0</sample><sample position=\"0\">0.4</sample>",
        "domain=\"uniform\"><sample>0.4</sample><sample>0.3</sample><sample>0.2</sample><sample>0.1</sample>"
        "<sample>0</sample>",
        "domain=\"uniform\" origin=\"0\" step=\"10\"><sample>0.4</sample><sample>0.2</sample><sample>0</sample>");
    const auto plants =
        tap_with("<functions><function name=\"diameter\" " + std::string(function) + "</function></functions>");
    CHECK_THAT(root_diameters(plants), near_values({0.004, 0.002, 0}));
    CHECK(plants.warnings.empty());
}

TEST_CASE("RSML: samples that lack are filled from their neighbours, and told", "[rsml]") {
    const auto plants = tap_with(
        "<functions><function name=\"diameter\"><sample>0.2</sample><sample>NaN</sample><sample>0.1</sample></function>"
        "</functions>");
    CHECK_THAT(root_diameters(plants), near_values({0.002, 0.0015, 0.001}));
    CHECK_THAT(warnings_of(plants), Contains("has no value"));
    const auto few = tap_with(
        "<functions><function name=\"diameter\"><sample>0.2</sample><sample>0.1</sample></function></functions>");
    CHECK_THAT(root_diameters(few), near_values({0.002, 0.001, 0.001}));
    CHECK_THAT(warnings_of(few), Contains("the last one counts on"));
}

TEST_CASE("RSML: times of birth, by every name", "[rsml]") {
    const std::string name = GENERATE("node_creation_time", "emergence_time", "creationTime", "emergence", "time");
    const auto plants = tap_with("<functions><function name=\"" + name +
                                 "\"><sample>1</sample><sample>2</sample><sample>4</sample></function></functions>");
    CHECK_THAT(root_days(plants), near_values({1, 2, 4}));
    CHECK(plants.has_times);
    const auto hours =
        tap_with("<functions><function name=\"" + name +
                     "\"><sample>24</sample><sample>48</sample><sample>96</sample>" + "</function></functions>",
                 in_cm + "<property-definitions><property-definition><label>" + name +
                     "</label><type>float</type><unit>h</unit></property-definition></property-definitions>");
    CHECK_THAT(root_days(hours), near_values({1, 2, 4}));
}

TEST_CASE("RSML: ages fall towards the tip; what grows there is a time of birth", "[rsml]") {
    const auto ages = tap_with(
        "<functions><function name=\"age\"><sample>10</sample><sample>6</sample><sample>0</sample></function>"
        "</functions>");
    CHECK_THAT(root_days(ages), near_values({0, 4, 10}));
    CHECK_THAT(warnings_of(ages), !Contains("'age'"));
    const auto births = tap_with(
        "<functions><function name=\"age\"><sample>0</sample><sample>4</sample><sample>10</sample></function>"
        "</functions>");
    CHECK_THAT(root_days(births), near_values({0, 4, 10}));
    CHECK_THAT(warnings_of(births), Contains("'age' grows from the bases of roots to their tips"));
    // Ages of whole roots.
    const auto whole =
        tap_with("<properties><age value=\"10\"/></properties><root><properties><age>3</age></properties>" +
                 root_line(point_at(0, 0, -10) + point_at(5, 0, -10)) + "</root>");
    CHECK_THAT(root_days(whole, 1), near_values({7, 7}));
}

TEST_CASE("RSML: nothing appears before what bears it", "[rsml]") {
    const auto plants = tap_with(
        "<functions><function name=\"time\"><sample>0</sample><sample>5</sample><sample>6</sample></function>"
        "</functions><root><functions><function name=\"time\"><sample>2</sample></function></functions>" +
        root_line(point_at(0, 0, -10) + point_at(5, 0, -10)) + "</root>");
    CHECK_THAT(root_days(plants, 1), near_values({5, 5}));
    CHECK_THAT(warnings_of(plants), Contains("before what bears it"));
}

TEST_CASE("RSML: pixels by their number per inch or cm, or by the width that is given", "[rsml]") {
    const std::string flat = root_plant(
        "<root><geometry><polyline><point x=\"10\" y=\"100\"/><point x=\"10\" y=\"700\"/>"
        "</polyline></geometry></root>");
    const auto inch = rsml_file.read(rsml_document("<unit>inch</unit><resolution>300</resolution>", flat));
    check_measures(inch, {1, 1, 0.0508, {0, 0.0508, 0}});
    CHECK(inch.unit == "pixels, 300 per inch");
    CHECK(summary_of(inch).extent[1].y == Approx(-100 / 300. * 0.0254));  // y grew downwards
    const auto cm = rsml_file.read(rsml_document("<unit>cm</unit><resolution>30</resolution>", flat));
    check_measures(cm, {1, 1, 0.20, {0, 0.20, 0}});
    const auto given =
        rsml_file.read(rsml_document("<unit>inch</unit><resolution>300</resolution>", flat), {.pixel = 1e-4});
    check_measures(given, {1, 1, 0.06, {0, 0.06, 0}});
    const auto unit = rsml_file.read(rsml_document("<unit>pixel</unit>", flat), {.unit = "mm"});
    check_measures(unit, {1, 1, 0.60, {0, 0.60, 0}});
}

TEST_CASE("RSML: the width of a pixel is guessed and told where the unit is the pixel", "[rsml]") {
    const auto root = [](const std::string& content) {
        return root_plant(
            "<root><geometry><polyline><point x=\"10\" y=\"100\"/><point x=\"10\" y=\"700\"/></polyline>"
            "</geometry>" +
            content + "</root>");
    };
    const auto plain = rsml_file.read(rsml_document("<unit>pixel</unit><resolution>1</resolution>", root("")));
    check_measures(plain, {1, 1, 0.0508, {0, 0.0508, 0}});
    CHECK_THAT(warnings_of(plain), Contains("taken as 300 per inch"));
    const auto dots = rsml_file.read(rsml_document("<unit>pixel</unit><resolution>150</resolution>", root("")));
    check_measures(dots, {1, 1, 0.1016, {0, 0.1016, 0}});
    CHECK_THAT(warnings_of(dots), Contains("the resolution 150 is taken as pixels per inch"));
    // A length that the writer measured says it.
    const auto length = rsml_file.read(rsml_document(
        "<unit>pixel</unit><property-definitions><property-definition><label>length</label><unit>cm</unit>"
        "</property-definition></property-definitions>",
        root("<properties><length>30</length></properties>")));
    check_measures(length, {1, 1, 0.30, {0, 0.30, 0}});
    CHECK_THAT(warnings_of(length), Contains("property 'length'"));
}

TEST_CASE("RSML: coordinates below 0 are no pixels", "[rsml]") {
    const auto plants = rsml_file.read(rsml_document("<unit>cm</unit><resolution>37.95</resolution><up>z</up>",
                                                     root_plant("<root>" + tap + "</root>")));
    check_measures(plants, {1, 1, 0.20, {0, 0.20, 0}});
    CHECK_THAT(warnings_of(plants), Contains("the resolution 37.95 is not used"));
}

TEST_CASE("RSML: without a unit, cm are guessed and told", "[rsml]") {
    const auto plants = tap_with("", "<up>z</up>");
    check_measures(plants, {1, 1, 0.20, {0, 0.20, 0}});
    CHECK_THAT(warnings_of(plants), Contains("no <unit>: taken as cm"));
    CHECK_THAT(warnings_of(tap_with("")), !Contains("unit"));
}

TEST_CASE("RSML: what points upwards is said, or a habit, or told by the roots of first order", "[rsml]") {
    const auto read = [](const std::string& metadata, const std::string& points,
                         language::MeasuredOptions options = {}) {
        return rsml_file.read(
            rsml_document("<unit>cm</unit>" + metadata, root_plant("<root>" + root_line(points) + "</root>")), options);
    };
    const std::string flat = point_at(3, 0, 0) + point_at(3, 20, 0);
    CHECK(read("", flat).up == "-y");
    CHECK_THAT(warnings_of(read("", flat)), !Contains("up"));
    CHECK_THAT(warnings_of(read("", point_at(3, 20, 0) + point_at(3, 0, 0))), Contains("run upwards"));
    CHECK(read("", flat, {.up = "y"}).up == "y");

    const std::string depth_is_y = point_at(3, 0, 5) + point_at(3, 10, 25);  // runs furthest along z
    CHECK(read("<software>archiSimple</software>", depth_is_y).up == "-y");
    CHECK_THAT(warnings_of(read("<software>archiSimple</software>", depth_is_y)), Contains("-y, as archiSimple"));
    CHECK(read("", depth_is_y).up == "-z");
    CHECK_THAT(warnings_of(read("", depth_is_y)), Contains("-z, because roots of first order run furthest along z"));
    CHECK(read("", point_at(0, 0, 0) + point_at(20, 1, 1)).up == "-x");
    CHECK(read("", point_at(0, 0, 0) + point_at(0, 1, -20)).up == "z");
    CHECK(read("<up>-x</up>", depth_is_y).up == "-x");
    CHECK_THAT(warnings_of(read("<up>north</up>", depth_is_y)), Contains("not 'north'"));
}

TEST_CASE("RSML: the direction is that of first-order roots together, not of spreading laterals", "[rsml]") {
    // Two basal roots run 30 to either side and 10 down.
    const auto plants = rsml_file.read(rsml_document(
        "<unit>cm</unit>", root_plant("<root>" + root_line(point_at(0, 0, 0) + point_at(30, 0, -10)) + "</root><root>" +
                                      root_line(point_at(0, 0, 0) + point_at(-30, 0, -10)) + "</root>")));
    CHECK(plants.up == "z");
    check_measures(plants, {1, 2, 2 * std::hypot(0.3, 0.1), {0.60, 0.10, 0}});
}

TEST_CASE("RSML: diameters that are labelled cm and written in pixels", "[rsml]") {
    const std::string metadata =
        "<unit>inch</unit><resolution>300</resolution><property-definitions><property-definition>"
        "<label>diameter</label><type>float</type><unit>cm</unit></property-definition></property-definitions>";
    const auto read = [&](const std::string& diameter) {
        return rsml_file.read(rsml_document(
            metadata,
            root_plant("<root><geometry><polyline><point x=\"10\" y=\"0\"/><point x=\"10\" y=\"3000\"/></polyline>"
                       "</geometry><properties><diameter>" +
                       diameter + "</diameter></properties></root>")));
    };
    const auto pixels = read("30");
    CHECK_THAT(root_diameters(pixels), near_values({0.00254, 0.00254}));
    CHECK_THAT(warnings_of(pixels), Contains("larger than a tenth of the plant"));
    const auto cm = read("0.2");
    CHECK_THAT(root_diameters(cm), near_values({0.002, 0.002}));
    CHECK(cm.warnings.empty());
    CHECK_THAT(warnings_of(read("900")), Contains("diameters up to 0.0762 m are larger than a tenth of the plant"));
}

TEST_CASE("RSML: each plant of a file is one of its own, with its name and base", "[rsml]") {
    const auto plants = rsml_file.read(rsml_document(
        in_cm,
        root_plant("<root>" + tap + "</root>", " ID=\"1\" label=\"left\"") + root_plant("") +
            root_plant("<root>" + root_line(point_at(10, 0, -1) + point_at(10, 0, -6)) + "</root>", " ID=\"3\"")));
    check_measures(plants, {2, 2, 0.25, {0.10, 0.20, 0}});
    CHECK(plants.plants[0].label == "left");
    CHECK(plants.plants[1].label == "3");
    CHECK(plants.axes[1].plant == 1);
    CHECK_FALSE(plants.axes[1].bearer);
    CHECK_THAT(warnings_of(plants), Contains("plants without points are left out: 1 of 3"));
}

TEST_CASE("RSML: every element, function and property that is not used is named once", "[rsml]") {
    const std::string lateral = "<root po=\"PO:1\">" + root_line(point_at(0, 0, -10) + point_at(5, 0, -10)) +
                                "<properties><angle>3</angle></properties></root>";
    const auto plants = tap_with(
        lateral + lateral + "<functions><function name=\"orientation\"><sample>1</sample></function></functions>",
        in_cm + "<user>me</user><image><name>a.png</name></image>");
    const std::string warnings = warnings_of(plants);
    CHECK_THAT(warnings, Contains("attribute 'po' of <root> is not used (2 places)"));
    CHECK_THAT(warnings, Contains("property 'angle' is not used (2 places)"));
    CHECK_THAT(warnings, Contains("function 'orientation' is not used"));
    CHECK_THAT(warnings, Contains("element <image> is not used"));
    CHECK_THAT(warnings, Contains("metadata <user> is not used"));
    CHECK_THAT(warnings, !Contains("<name>"));
}

TEST_CASE("RSML: thousands of things that are not used end in a hundred lines", "[rsml]") {
    std::string properties;
    for (int i = 0; i < 2000; ++i) properties += "<p" + std::to_string(i) + ">1</p" + std::to_string(i) + ">";
    const auto plants = tap_with("<properties>" + properties + "</properties>");
    CHECK(plants.warnings.size() == 102);  // with that of the rest, and of the diameter
    CHECK_THAT(warnings_of(plants), Contains("more is not used, in 1900 places"));
}

TEST_CASE("RSML: lengths that the writer measured are compared with the lines", "[rsml]") {
    CHECK_THAT(warnings_of(tap_with("<properties><length>20.1</length></properties>")), !Contains("length"));
    CHECK_THAT(warnings_of(tap_with("<properties><length>40</length></properties>")),
               Contains("property 'length' says 2 times what its lines measure"));
}
