// Root systems that were measured, from outside: they are what the file says, in the soil and out again.
#include "base/csv_file.h"
#include "catch.h"
#include "program.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <numbers>
#include <sstream>

namespace {

std::string measured_root(const std::string& content, const std::string& points) {
    return "<root><geometry><polyline>" + points + "</polyline></geometry>" + content + "</root>";
}

std::string measured_point(double x, double y, double z) {
    return fmt::format("<point x=\"{}\" y=\"{}\" z=\"{}\"/>", x, y, z);
}

std::string measured_plants(const std::string& scene) {
    return "<rsml><metadata><unit>cm</unit><up>z</up></metadata><scene>" + scene + "</scene></rsml>\n";
}

/// A tap root of 20 cm with a lateral of 6 cm at half its length.
const std::string tap_and_lateral =
    measured_plants("<plant>" +
                    measured_root("<properties><diameter>0.1</diameter></properties>" +
                                      measured_root("<properties><diameter>0.05</diameter></properties>",
                                                    measured_point(0, 0, -10) + measured_point(6, 0, -10)),
                                  measured_point(0, 0, 0) + measured_point(0, 0, -10) + measured_point(0, 0, -20)) +
                    "</plant>");

/// The same, drawn by a model.
const std::string tap_and_lateral_grown =
    "lsystem: 1\nderivation length: 0\n"
    "axiom: @R(0,-1,0) !(0.001) F(0.1) [@R(1,0,0) !(0.0005) F(0.06)] !(0.001) F(0.1)\nendlsystem\n";

/// Laterals take up a tenth of what the tap root does.
std::string soil_scene(const std::string& model) {
    return "[simulation]\nsteps = 2\ndt = 0.5\ntime_unit = \"day\"\n[[plant]]\nmodel = \"" + model +
           "\"\n[environment.water]\nprocess = \"soil-water\"\nmodel = \"richards\"\ndomain = { lower = [-0.08, "
           "-0.24, -0.08], upper = [0.08, 0, 0.08] }\nvoxel = 0.04\nsoil = \"loam\"\ninitial = { head = -300 }\n"
           "[environment.roots]\nprocess = \"root-water\"\nsoil = \"water\"\ncollar = { transpiration = 0.5, limit = "
           "-15000 }\n[[environment.roots.orders]]\nradial = 1e-4\naxial = 1\n[[environment.roots.orders]]\nradial = "
           "1e-5\naxial = 0.1\n";
}

/// The last row of statistics.csv, by column.
std::map<std::string, std::string> last_statistics(const Workplace& place, const std::string& run) {
    std::istringstream text(text_of(place.path() / run / "statistics.csv"));
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(text, line);) rows.push_back(espalier::csv_cells(line));
    std::map<std::string, std::string> last;
    for (std::size_t i = 0; i < rows.front().size(); ++i) last[rows.front()[i]] = rows.back()[i];
    return last;
}

nlohmann::json measures_of(const Workplace& place, const std::string& file) {
    const Outcome outcome = place.run("info " + file + " --json");
    REQUIRE(outcome.code == 0);
    return nlohmann::json::parse(outcome.out);
}

void check_same_measures(const nlohmann::json& a, const nlohmann::json& b) {
    for (const char* const count : {"plants", "axes", "axes_of_order", "nodes"}) {
        INFO(count);
        CHECK(a[count] == b[count]);
    }
    for (const char* const size : {"length", "surface", "volume", "link_length"}) {
        INFO(size);
        CHECK(a[size].get<double>() == Approx(b[size].get<double>()).epsilon(2e-6).margin(1e-12));
    }
    for (const char* const corner : {"lowest", "highest"}) {
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(a[corner][axis].get<double>() == Approx(b[corner][axis].get<double>()).margin(1e-6));
        }
    }
}

}  // namespace

TEST_CASE("an imported tap root has order 0, and root-water sees it as a grown one", "[measured]") {
    const Workplace place;
    place.write("measured.rsml", tap_and_lateral);
    place.write("grown.l", tap_and_lateral_grown);
    place.write("measured.toml", soil_scene("measured.rsml"));
    place.write("grown.toml", soil_scene("grown.l"));
    std::map<std::string, std::map<std::string, std::string>> last;
    for (const std::string run : {"measured", "grown"}) {
        REQUIRE(place.run("run " + run + ".toml --quiet --output " + run).code == 0);
        last[run] = last_statistics(place, run);
    }
    for (const std::string column :
         {"length", "roots.conductance", "roots.suf_depth", "roots.transpiration", "roots.collar", "roots.depth"}) {
        INFO(column);
        CHECK(std::stod(last["measured"].at(column)) == Approx(std::stod(last["grown"].at(column))).epsilon(1e-9));
    }
    // The orders make a difference: as laterals, all roots would take up a tenth.
    std::string shifted = soil_scene("measured.rsml");
    const std::size_t orders = shifted.find("[[environment.roots.orders]]");
    const std::size_t second = shifted.find("[[environment.roots.orders]]", orders + 1);
    place.write("shifted.toml", shifted.substr(0, orders) + shifted.substr(second));
    REQUIRE(place.run("run shifted.toml --quiet --output shifted").code == 0);
    CHECK(std::stod(last_statistics(place, "shifted").at("roots.conductance")) <
          0.5 * std::stod(last["grown"].at("roots.conductance")));
}

TEST_CASE("what is imported and exported as RSML is the same plants", "[measured]") {
    const Workplace place;
    const auto root_with = [](const std::string& diameters, const std::string& points, const std::string& laterals) {
        std::string samples;
        for (const std::string& each : espalier::csv_cells(diameters)) samples += "<sample>" + each + "</sample>";
        return measured_root("<functions><function name=\"diameter\">" + samples + "</function></functions>" + laterals,
                             points);
    };
    // Three orders, links, diameters along an axis, two plants, one of which has two first axes.
    place.write(
        "two.rsml",
        measured_plants(
            "<plant label=\"left\">" +
            root_with(
                "0.3,0.3,0.2,0.1",
                measured_point(0, 0, 0) + measured_point(0, 0, -5) + measured_point(1, 0, -9) +
                    measured_point(1, 2, -20),
                root_with(
                    "0.05,0.05", measured_point(1, 0, -4) + measured_point(6, 0, -10),
                    root_with("0.02,0.02,0.01",
                              measured_point(3, 1, -6) + measured_point(3, 4, -7) + measured_point(3, 5, -8), "")) +
                    root_with("0.04,0.04", measured_point(0, 0, -5) + measured_point(-5, 0, -6), "")) +
            "</plant><plant label=\"right\">" +
            root_with("0.1,0.1", measured_point(20, 0, -1) + measured_point(20, 0, -9), "") +
            root_with("0.1,0.1", measured_point(20, 1, -1) + measured_point(24, 1, -9), "") + "</plant>"));
    REQUIRE(place.run("run two.rsml --quiet --output run").code == 0);
    REQUIRE(place.run("export run --format rsml --up z --output out").code == 0);
    const auto before = measures_of(place, "two.rsml");
    CHECK(before["link_length"].get<double>() > 0.01);
    check_same_measures(before, measures_of(place, "out/two-0000.rsml"));
    CHECK_THAT(text_of(place.path() / "out/two-0000.rsml"), Catch::Contains("label=\"two-left\""));
}

TEST_CASE("grown plants that are exported as RSML, grown again and exported are the same file", "[measured]") {
    const auto [model, steps] = GENERATE(std::pair("models/roots/lupine.l", 14), std::pair("models/roots/maize.l", 12),
                                         std::pair("models/roots/tree.l", 8), std::pair("models/trees/honda.l", 6),
                                         std::pair("models/roots/wheat.l", 12));
    const std::filesystem::path path = std::filesystem::path(ESPALIER_SOURCE_DIR) / model;
    if (!std::filesystem::exists(path)) return;
    INFO(model);
    const Workplace place;
    place.write("scene.toml", fmt::format("[simulation]\nsteps = {}\n[[plant]]\nmodel = \"{}\"\nposition = [0, 0, 0]\n"
                                          "[[plant]]\nmodel = \"{}\"\nposition = [1, 0, 2]\n",
                                          steps, path.string(), path.string()));
    REQUIRE(place.run("run scene.toml --quiet --output run").code == 0);
    REQUIRE(place.run("export run --format rsml --output first.rsml").code == 0);
    REQUIRE(place.run("run first.rsml --quiet --output again").code == 0);
    REQUIRE(place.run("export again --format rsml --output second.rsml").code == 0);
    check_same_measures(measures_of(place, "first.rsml"), measures_of(place, "second.rsml"));
    CHECK(measures_of(place, "first.rsml")["axes"] > 3);
}

TEST_CASE("analyse tells the uptake over depth, and when a plant first lacked water", "[measured]") {
    const Workplace place;
    place.write("measured.rsml", tap_and_lateral);
    std::string scene = soil_scene("measured.rsml");
    scene.replace(scene.find("steps = 2"), 9, "steps = 40");
    scene.replace(scene.find("transpiration = 0.5"), 19,
                  "by_day = true, transpiration = { file = \"demand.csv\", column = \"demand\" }");
    place.write("demand.csv", "day,demand\n0,0.3\n5,0.3\n6,12\n11,12\n");
    scene.replace(scene.find("dt = 0.5"), 8, "dt = 0.25");
    place.write("scene.toml", scene + "[timeline]\nevery = 3\norgans = [\"roots.mean_uptake\"]\n");
    REQUIRE(place.run("run scene.toml --quiet --output run").code == 0);
    const Outcome outcome = place.run("analyse run --layer 0.04 --no-picture");
    REQUIRE(outcome.code == 0);

    std::map<std::pair<std::string, std::string>, double> transpired, taken;  // by step and plant
    std::istringstream statistics(text_of(place.path() / "run/statistics.csv"));
    double first_stress = -1, transpired_in_all = 0;
    std::vector<std::string> header;
    const auto cell = [&](const std::vector<std::string>& row, const std::string& name) {
        return row.at(static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin()));
    };
    for (std::string line; std::getline(statistics, line);) {
        const std::vector<std::string> row = espalier::csv_cells(line);
        if (header.empty()) {
            header = row;
            continue;
        }
        const double flow = std::stod(cell(row, "roots.transpiration")), demand = std::stod(cell(row, "roots.demand"));
        transpired[{cell(row, "step"), cell(row, "plant")}] = flow;
        if (cell(row, "step") == "0") continue;
        transpired_in_all += 0.25 * flow;
        if (first_stress < 0 && demand > 0 && flow < 0.99 * demand) first_stress = std::stod(cell(row, "time"));
    }
    REQUIRE(first_stress > 1);

    header.clear();
    std::istringstream layers(text_of(place.path() / "run/analysis/layers.csv"));
    for (std::string line; std::getline(layers, line);) {
        const std::vector<std::string> row = espalier::csv_cells(line);
        if (header.empty()) {
            header = row;
            continue;
        }
        taken[{cell(row, "step"), cell(row, "plant")}] += std::stod(cell(row, "uptake"));
    }
    REQUIRE(taken.size() > 10);
    for (const auto& [at, flow] : taken) {
        INFO("step " << at.first);
        CHECK(flow == Approx(transpired.at(at)).epsilon(1e-3).margin(1e-4));
    }

    header.clear();
    std::istringstream stress(text_of(place.path() / "run/analysis/stress.csv"));
    std::string line;
    std::getline(stress, line);
    header = espalier::csv_cells(line);
    REQUIRE(std::getline(stress, line));
    const std::vector<std::string> row = espalier::csv_cells(line);
    CHECK(std::stod(cell(row, "first_time")) == Approx(first_stress));
    CHECK(std::stod(cell(row, "transpired")) == Approx(transpired_in_all).epsilon(1e-6));
    CHECK_THAT(outcome.out, Catch::Contains(fmt::format("lacked water first at {} day", first_stress)));
}

TEST_CASE("info says the volume of cylinders and that of the cones which a run draws and analyse counts",
          "[measured]") {
    const Workplace place;
    place.write("tree.csv",
                "radius,length,start_x,start_y,start_z,axis_x,axis_y,axis_z,parent,extension,branch\n"
                "0.1,1,0,0,0,0,0,1,0,2,1\n0.05,1,0,0,1,0,0,1,1,3,1\n0.04,1,0,0,2.5,0,0,1,2,0,1\n"
                "0.02,0.5,0.1,0,0.5,1,0,0,1,0,2\n");
    const nlohmann::json info = measures_of(place, "tree.csv");
    constexpr double pi = std::numbers::pi;
    CHECK(info["volume"].get<double>() == Approx(pi * (0.01 + 0.0025 + 0.0016 + 0.0002)));
    // The second cylinder tapers; behind the gap and in the branch nothing does.
    CHECK(info["drawn_volume"].get<double>() == Approx(pi * (0.01 + 0.0175 / 3 + 0.0016 + 0.0002)));
    REQUIRE(place.run("import tree.csv --output tree.toml").code == 0);
    REQUIRE(place.run("run tree.toml --output run --quiet").code == 0);
    REQUIRE(place.run("analyse run").code == 0);
    std::istringstream rows(text_of(place.path() / "run/analysis/analysis.csv"));
    std::string names, values;
    std::getline(rows, names);
    std::getline(rows, values);
    std::map<std::string, std::string> counted;
    for (std::size_t i = 0; i < espalier::csv_cells(names).size(); ++i) {
        counted[espalier::csv_cells(names)[i]] = espalier::csv_cells(values)[i];
    }
    CHECK(std::stod(counted["volume"]) == Approx(info["drawn_volume"].get<double>()).epsilon(1e-6));
    CHECK(std::stod(counted["surface"]) == Approx(info["drawn_surface"].get<double>()).epsilon(1e-6));
}
