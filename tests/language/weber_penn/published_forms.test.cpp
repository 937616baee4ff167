// Species as other programs publish them: the XML of Arbaro, the arrays of tree-gen, and the table of the paper.
#include "catch.h"
#include "language/notation_text.h"

#include <fmt/format.h>

using namespace espalier;

namespace {

const NotationText table{"species", "tree"}, arbaro{"arbaro", "tree"}, tree_gen{"species", "tree"};

/// The first parameters of the quaking aspen (Weber & Penn 1995, table 2), as each program writes them.
const std::string of_paper =
    "Shape = 7\nBaseSize = 0.4\nScale, ScaleV = 13, 3\nLevels = 2\nRatio, RatioPower = 0.015, 1.2\nFlare = 0.6\n"
    "0Length, 0LengthV = 1, 0\n0CurveRes, 0Curve, 0CurveV = 3, 0, 20\n0BaseSplits = -2\n0SplitAngle = 10\n"
    "1DownAngle, 1DownAngleV = 60, -50\n1Rotate, 1RotateV = 140, 0\n1Branches = 50\n1Length = 0.3\n1Taper = 1\n"
    "1CurveRes, 1Curve, 1CurveV = 5, -40, 50\n2DownAngle, 2Rotate = 45, 140\nLeaves, LeafShape = 25, 0\n"
    "LeafScale, LeafScaleX, LeafBend = 0.17, 1, 0.3\nAttractionUp = 0.5\n";

std::string xml(const std::string& parameters) {
    return "<?xml version='1.0' ?>\n<!DOCTYPE arbaro>\n<arbaro>\n  <species name='aspen'>\n<!-- general -->\n" +
           parameters + "  </species>\n</arbaro>\n";
}

std::string parameter(const std::string& name, const std::string& value) {
    return fmt::format("    <param name='{}' value='{}'/>\n", name, value);
}

/// The same lines as parameters of Arbaro.
std::string as_arbaro(const std::string& lines) {
    std::string all;
    for (std::size_t begin = 0; begin < lines.size();) {
        const std::size_t equals = lines.find(" = ", begin), end = lines.find('\n', begin);
        std::string names = lines.substr(begin, equals - begin), values = lines.substr(equals + 3, end - equals - 3);
        while (!names.empty()) {
            const std::size_t name = std::min(names.find(", "), names.size());
            const std::size_t value = std::min(values.find(", "), values.size());
            all += parameter(names.substr(0, name), values.substr(0, value));
            names.erase(0, name + 2);
            values.erase(0, value + 2);
        }
        begin = end + 1;
    }
    return xml(all);
}

const std::string of_tree_gen = R"(# aspen
params = {
    'shape': 7,
    "g_scale": 13, 'g_scale_v': 3,
    'levels': 2,
    'ratio': 0.015,
    'ratio_power': 1.2,
    'flare': 0.6,
    'base_splits': -2,
    'base_size': [0.4, 0, 0, 9],
    'down_angle': [-0, 60, 45, 999],
    'down_angle_v': [-0, -50, 0, 10],
    'rotate': [-0, 140, 140, 77],
    'rotate_v': [0, 0, 0, 0],
    'branches': [1, 50, 30, 1],
    'length': [1, 0.3, 0.6, 0],
    'length_v': [0, 0, 0, 0],
    'taper': [1, 1, 1, 1],
    'seg_splits': [0, 0, 0, 0],
    'split_angle': [10, 0, 0, 0],
    'split_angle_v': [0, 0, 0, 0],
    'curve_res': [3, 5, 0, 0],   # of levels that there are
    'curve': [0, -40, -40, 0],
    'curve_back': [0, 0, 0, 0],
    'curve_v': [20, 50, 75, 0],
    'bend_v': [-0, 0, 0, 0],
    'branch_dist': [-0, 0, 0, 0],
    'radius_mod': [1, 1, 1, 1],
    'leaf_blos_num': 25,
    'leaf_shape': 0,
    'leaf_scale': 0.17,
    'leaf_scale_x': 1,
    'leaf_bend': 0.3,
    'blossom_shape': 1,
    'blossom_scale': 0,
    'blossom_rate': 0,
    'tropism': [0, 0, 0.5],
    'prune_ratio': 0,
    'prune_width': 0.5,
    'prune_width_peak': 0.5,
    'prune_power_low': 0.5,
    'prune_power_high': 0.5,
}
)";

std::vector<std::string> warnings_of(const char* notation, const std::string& text) {
    std::vector<std::string> all;
    for (const Diagnostic& each : registered<NotationType>().at(notation)->translate(text, "tree").warnings) {
        all.push_back(to_string(each.place) + ": " + each.message);
    }
    return all;
}

}  // namespace

TEST_CASE("species: the paper's table, Arbaro's XML and tree-gen's arrays are one model", "[species]") {
    const std::string model = table.model_of(of_paper);
    CHECK_THAT(model, Catch::Contains("#define Branches_1 50"));
    CHECK(arbaro.model_of(as_arbaro(of_paper)) == model);
    CHECK(tree_gen.model_of(of_tree_gen) == model);
    CHECK(table.model_of(as_arbaro(of_paper)) == model);
    CHECK_FALSE(table.model_of(" \n").empty());  // all defaults
    CHECK(warnings_of("species", of_paper).empty());
    CHECK(warnings_of("arbaro", as_arbaro(of_paper)).empty());
    CHECK(warnings_of("species", of_tree_gen).empty());
}

TEST_CASE("species: what Arbaro's and tree-gen's files say and nothing reads is named once", "[species]") {
    const std::string said =
        xml(parameter("Smooth", "0.5") + parameter("0DownAngle", "0.0") + parameter("0Branches", "1") +
            parameter("0Rotate", "30") + parameter("LeafShape", "sphere"));
    const std::vector<std::string> warnings = warnings_of("arbaro", said);
    REQUIRE(warnings.size() == 3);
    CHECK_THAT(warnings[0], Catch::StartsWith("tree:6:5: 'Smooth' is not read"));
    CHECK_THAT(warnings[1], Catch::StartsWith("tree:9:5: '0Rotate' is not read: there is one trunk"));
    CHECK_THAT(warnings[2], Catch::Contains("'sphere' are drawn as ovals"));
    const std::vector<std::string> others = warnings_of(
        "species", "{'levels': 2, 'branch_dist': [0, 1.5, 0, 0], 'tropism': [1, 0, 0], 'branches': [3, 20, 0, 0]}");
    REQUIRE(others.size() == 3);
    CHECK_THAT(others[0], Catch::StartsWith("tree:1:34: this number of 'branch_dist' is not read: whorls"));
    CHECK_THAT(others[1], Catch::Contains("'tropism' is not read"));
    CHECK_THAT(others[2], Catch::Contains("'branches' is not read: there is one trunk"));
}

TEST_CASE("species: mistakes in published forms are told at their places", "[species]") {
    CHECK_THAT(arbaro.mistake(xml(parameter("1Lenght", "1"))),
               Catch::Contains("tree:6:5: there is no parameter '1Lenght' (did you mean '1Length'?)"));
    CHECK_THAT(arbaro.mistake(xml(parameter("Scale", "-3"))),
               Catch::Contains("'Scale' must be at least 0.001 m, not -3"));
    CHECK_THAT(arbaro.mistake(xml(parameter("Scale", "big"))), Catch::Contains("'Scale' is a number, not 'big'"));
    CHECK_THAT(arbaro.mistake("<plant/>"), Catch::Contains("no file of Arbaro"));
    CHECK_THAT(arbaro.mistake("<arbaro/>"), Catch::Contains("no <species>"));
    CHECK_THAT(arbaro.mistake("<arbaro><species/><species/></arbaro>"), Catch::Contains("a second species"));
    CHECK_THAT(arbaro.mistake("<arbaro><species>"), Catch::Contains("tree:1:18: "));
    CHECK_THAT(tree_gen.mistake("params = {'shape': 7"), Catch::Contains("tree:1:21: expected ',' or '}'"));
    CHECK_THAT(tree_gen.mistake("import os"), Catch::Contains("expected '=' between the names"));
    CHECK_THAT(tree_gen.mistake("# aspen\nparams {"), Catch::Contains("tree:2:8: expected '='"));
    CHECK_THAT(tree_gen.mistake("{'shap': 7}"),
               Catch::Contains("there is no parameter 'shap' (did you mean 'shape'?)"));
    CHECK_THAT(tree_gen.mistake("{'shape': 9}"), Catch::Contains("tree:1:11: 'Shape' must be from 0 to 8, not 9"));
    CHECK_THAT(tree_gen.mistake("{'shape': [1]}"), Catch::Contains("'shape' is a number, not a list"));
    CHECK_THAT(tree_gen.mistake("{'length': 1}"), Catch::Contains("'length' is a list of 4 numbers at most"));
    CHECK_THAT(tree_gen.mistake("{'ratio': x}"), Catch::Contains("'ratio' is a number"));
    CHECK_THAT(tree_gen.mistake("{'ratio': 1} 2"), Catch::Contains("nothing behind the '}'"));
    CHECK_THAT(tree_gen.mistake("{shape: 7}"), Catch::Contains("the name of a parameter in quotes"));
    CHECK_THAT(table.mistake("LeafBend = 0.2\nLeafOrient = 0.3\n"), Catch::Contains("'LeafBend' is set twice"));
    CHECK_THAT(table.mistake("LeafOrient = x\n"), Catch::Contains("'LeafOrient' is a number, not 'x'"));
}
