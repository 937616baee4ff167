#include "espalier/geometry/openvdb_grid.h"

#include "catch.h"
#include "environment/exchange/exchange_plants.h"
#include "temporary_folder.h"

#include <openvdb/io/File.h>

#include <functional>

using namespace espalier;
using namespace espalier::environment;

namespace {

/// A grid of a function at the centres of voxels of half a metre.
template <class Grid>
typename Grid::Ptr grid_of(const std::string& name,
                           const std::function<typename Grid::ValueType(const openvdb::Vec3d&)>& function) {
    const auto grid = Grid::create();
    grid->setName(name);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
    const openvdb::CoordBBox box(openvdb::Coord(-6), openvdb::Coord(6));
    for (auto at = box.beginZYX(); at; ++at) grid->tree().setValue(*at, function(grid->indexToWorld(*at)));
    return grid;
}

/// A file with numbers, "heat", and vectors, "wind".
class Files {
public:
    Files() {
        initialize_openvdb();
        const auto heat = grid_of<openvdb::DoubleGrid>(
            "heat", [](const openvdb::Vec3d& p) { return 20 + 2 * p.x() - p.y() + 0.5 * p.z(); });
        const auto wind = grid_of<openvdb::Vec3SGrid>(
            "wind", [](const openvdb::Vec3d& p) { return openvdb::Vec3f(float(p.z()), 0.25f, float(-p.x())); });
        openvdb::io::File file((folder_.path() / "air.vdb").string());
        file.write({heat, wind});
        file.close();
    }
    Environment environment(const std::string& lines) const {
        const Settings file = Settings::parse_toml("[light]\nprocess = 'vdb'\n" + lines, "scene.toml", folder_.path());
        return Environment({{"light", file.table("light")}}, {});
    }
    void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
    void write(const std::string& name, const openvdb::GridBase::Ptr& grid) const {
        openvdb::io::File file((folder_.path() / name).string());
        file.write({grid});
        file.close();
    }

private:
    TemporaryFolder folder_;
};

std::vector<double> answers_of_vdb(Environment& environment, const std::vector<Asked>& questions, int step) {
    AskingPlants plants;
    plants.add(questions).exchange(environment, step);
    return plants.parameters();
}

std::vector<double> answers_of_vdb(Environment environment, const std::vector<Asked>& questions) {
    return answers_of_vdb(environment, questions, 0);
}

/// Heat at three times: it rises by 3 degrees a metre more in the first four steps, and falls in the other six.
class HeatInTime : public Files {
public:
    HeatInTime() {
        const double steepness[] = {2, 5, -1};
        for (int map = 0; map < 3; ++map) {
            const double slope = steepness[map];
            write("heat" + std::to_string(map) + ".vdb",
                  grid_of<openvdb::FloatGrid>("heat", [&](const openvdb::Vec3d& p) { return float(slope * p.x()); }));
        }
    }
    static std::string maps(const char* last = "{ time = 10, file = 'heat2.vdb' }") {
        return std::string("maps = [{ time = 0, file = 'heat0.vdb' }, { time = 4, file = 'heat1.vdb' }, ") + last +
               "]\n";
    }
};

}  // namespace

TEST_CASE_METHOD(Files, "vdb answers the value and the slope of a grid of numbers", "[vdb]") {
    CHECK(answers_of_vdb(environment("file = 'air.vdb'\n"), {{{0.25, 1, -1.5}, {0}}, {{1, 0.75, 0.5}, {0, 0, 0, 0}}}) ==
          std::vector<double>{18.75, 21.5, 2, -1, 0.5});
}

TEST_CASE_METHOD(Files, "vdb answers the vector of a grid of vectors, and has a field for each component", "[vdb]") {
    Environment air = environment("file = 'air.vdb'\ngrid = 'wind'\nunit = 'm/s'\n");
    for (const char* name : {"light.x", "light.y", "light.z"}) CHECK(air.fields().need(name).unit == "m/s");
    CHECK(answers_of_vdb(std::move(air), {{{0.75, 1, -1.25}, {0, 0, 0}}}) == std::vector<double>{-1.25, 0.25, -0.75});
}

TEST_CASE_METHOD(Files, "vdb refuses what is no grid", "[vdb]") {
    const auto refusal = [&](const std::string& lines) { return message_of([&] { environment(lines); }); };
    CHECK(lacks(refusal("file = 'none.vdb'\n"), {"scene.toml:3:", "none.vdb"}) == "");
    CHECK(lacks(refusal("file = 'air.vdb'\ngrid = 'wint'\n"),
                {"scene.toml:4:", "no grid 'wint' (did you mean 'wind'?); it has: heat, wind"}) == "");
    write("text.vdb", "not a grid");
    CHECK(lacks(refusal("file = 'text.vdb'\n"), {"scene.toml:3:", "text.vdb is no OpenVDB file"}) == "");
}

TEST_CASE_METHOD(HeatInTime, "maps change by straight lines between their times", "[vdb]") {
    Environment soil = environment(maps() + "unit = 'K'\n");
    const std::vector<Asked> asked = {{{0.75, 0, 0.3}, {0, 0, 0, 0}}};
    const auto expected = [](double slope) { return std::vector<double>{0.75 * slope, slope, 0, 0}; };
    CHECK(answers_of_vdb(soil, asked, 0) == expected(2));
    CHECK(answers_of_vdb(soil, asked, 1) == expected(2.75));
    CHECK(answers_of_vdb(soil, asked, 3) == expected(4.25));
    CHECK(answers_of_vdb(soil, asked, 4) == expected(5));
    CHECK(answers_of_vdb(soil, asked, 7) == expected(2));
    CHECK(answers_of_vdb(soil, asked, 10) == expected(-1));
    CHECK(soil.fields().need("light").changes);
    CHECK(lacks(message_of([&] { answers_of_vdb(soil, asked, 11); }),
                {"'light' goes from time 0 to 10, but the run is at 11: give it more maps"}) == "");
}

TEST_CASE_METHOD(HeatInTime, "one map in time holds for ever, as a file does", "[vdb]") {
    Environment soil = environment("maps = [{ time = 3, file = 'heat1.vdb' }]\n");
    CHECK(answers_of_vdb(soil, {{{0.75, 0, 0.3}, {0}}}, 50) == std::vector<double>{3.75});
    CHECK_FALSE(soil.fields().need("light").changes);
}

TEST_CASE_METHOD(HeatInTime, "maps whose voxels are not the same mix with the background where one has none", "[vdb]") {
    const auto spot = openvdb::FloatGrid::create(8);
    spot->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
    spot->tree().setValue(openvdb::Coord(40, 0, 0), 16);
    write("spot.vdb", spot);
    Environment soil = environment("maps = [{ time = 0, file = 'heat0.vdb' }, { time = 4, file = 'spot.vdb' }]\n");
    CHECK(answers_of_vdb(soil, {{{20, 0, 0}, {0}}, {{2, 0, 0}, {0}}}, 1) == std::vector<double>{4, 5});
}

TEST_CASE_METHOD(HeatInTime, "maps of vectors change in time, too", "[vdb]") {
    write("calm.vdb", grid_of<openvdb::Vec3SGrid>("wind", [](const openvdb::Vec3d&) { return openvdb::Vec3f(0); }));
    Environment air =
        environment("grid = 'wind'\nmaps = [{ time = 0, file = 'air.vdb' }, { time = 4, file = 'calm.vdb' }]\n");
    CHECK(answers_of_vdb(air, {{{0.75, 1, -1.25}, {0, 0, 0}}}, 3) == std::vector<double>{-0.3125, 0.0625, -0.1875});
}

TEST_CASE_METHOD(HeatInTime, "vdb refuses maps that do not follow each other or do not match", "[vdb]") {
    const auto refusal = [&](const std::string& lines) { return message_of([&] { environment(lines); }); };
    CHECK(lacks(refusal(maps("{ time = 4, file = 'heat2.vdb' }")),
                {"scene.toml:3:", "time 4 is not behind time 4 of the map before"}) == "");
    CHECK(lacks(refusal(maps("{ time = 10, file = 'air.vdb' }") + "grid = 'wind'\n"), {"no grid 'wind'"}) == "");
    const auto coarse = grid_of<openvdb::FloatGrid>("heat", [](const openvdb::Vec3d&) { return 1.0f; });
    coarse->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    write("coarse.vdb", coarse);
    CHECK(lacks(refusal(maps("{ time = 10, file = 'coarse.vdb' }")),
                {"scene.toml:3:", "does not match the first, 'heat'", "the same lattice"}) == "");
    const auto vectors = grid_of<openvdb::Vec3SGrid>("heat", [](const openvdb::Vec3d&) { return openvdb::Vec3f(0); });
    write("vectors.vdb", vectors);
    CHECK(lacks(refusal(maps("{ time = 10, file = 'vectors.vdb' }")), {"scene.toml:3:", "all hold numbers"}) == "");
    CHECK(lacks(refusal(maps("{ time = 10, file = 'none.vdb' }")), {"scene.toml:3:", "none.vdb"}) == "");
    CHECK(lacks(refusal(maps("{ time = 10 }")), {"scene.toml:3:", "'file'"}) == "");
    CHECK(lacks(refusal("maps = [{ time = 1, file = 'heat0.vdb' }, { time = 4, file = 'heat1.vdb' }]\n"),
                {"scene.toml:3:", "the first map is of time 1, but runs begin at 0"}) == "");
    CHECK(lacks(refusal("maps = []\n"), {"scene.toml:3:", "one map or more"}) == "");
}
