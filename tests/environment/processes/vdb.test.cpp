#include "espalier/geometry/openvdb_grid.h"

#include "catch.h"
#include "environment/exchange_plants.h"
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

private:
    TemporaryFolder folder_;
};

std::vector<double> answers(Environment environment, const std::vector<Asked>& questions) {
    AskingPlants plants;
    plants.add(questions).exchange(environment);
    return plants.parameters();
}

}  // namespace

TEST_CASE_METHOD(Files, "vdb answers the value and the slope of a grid of numbers", "[vdb]") {
    CHECK(answers(environment("file = 'air.vdb'\n"), {{{0.25, 1, -1.5}, {0}}, {{1, 0.75, 0.5}, {0, 0, 0, 0}}}) ==
          std::vector<double>{18.75, 21.5, 2, -1, 0.5});
}

TEST_CASE_METHOD(Files, "vdb answers the vector of a grid of vectors, and has a field for each component", "[vdb]") {
    Environment air = environment("file = 'air.vdb'\ngrid = 'wind'\nunit = 'm/s'\n");
    for (const char* name : {"light.x", "light.y", "light.z"}) CHECK(air.fields().need(name).unit == "m/s");
    CHECK(answers(std::move(air), {{{0.75, 1, -1.25}, {0, 0, 0}}}) == std::vector<double>{-1.25, 0.25, -0.75});
}

TEST_CASE_METHOD(Files, "vdb refuses what is no grid", "[vdb]") {
    const auto refusal = [&](const std::string& lines) { return message_of([&] { environment(lines); }); };
    CHECK(lacks(refusal("file = 'none.vdb'\n"), {"scene.toml:3:", "none.vdb"}) == "");
    CHECK(lacks(refusal("file = 'air.vdb'\ngrid = 'wint'\n"),
                {"scene.toml:4:", "no grid 'wint' (did you mean 'wind'?); it has: heat, wind"}) == "");
    write("text.vdb", "not a grid");
    CHECK(lacks(refusal("file = 'text.vdb'\n"), {"scene.toml:3:", "text.vdb is no OpenVDB file"}) == "");
}
