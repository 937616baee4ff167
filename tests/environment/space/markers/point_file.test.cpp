// Points of files: rows, meshes, units and directions, places on a map, and what is no such file.
#include "environment/space/markers/point_file.h"

#include "espalier/base/map_origin.h"

#include "catch.h"
#include "temporary_folder.h"

#include <fmt/format.h>

using namespace espalier;
using namespace espalier::environment;

namespace {

class PointFile {
public:
    PointFile(const std::string& name, const std::string& text, const std::string& keys = "") {
        table_ =
            Settings::parse_toml(fmt::format("file = '{}'\n{}", folder_.write(name, text).string(), keys), "s.toml");
    }

    std::vector<glm::dvec3> points(std::size_t most = 100) { return read_point_file(table_, most, &warnings_); }

    std::string mistake(std::size_t most = 100) {
        try {
            points(most);
        } catch (const UserError& error) {
            return error.what();
        }
        return "";
    }

    Settings table_;
    std::vector<Diagnostic> warnings_;

private:
    TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("rows of points have z upwards, and may have names above and colours behind", "[markers]") {
    PointFile file("crown.xyz", "// scanned\nX Y Z R\n1 2 3 255\n-1\t0\t0.5\t17\n");
    CHECK(file.points() == std::vector<glm::dvec3>{{1, 3, -2}, {-1, 0.5, 0}});
    REQUIRE(file.warnings_.size() == 1);
    CHECK_THAT(file.warnings_[0].message, Catch::Contains("behind x, y and z is not used (2 rows)"));
    CHECK(PointFile("crown.csv", "x,y,z\n100,200,300\n", "unit = 'cm'\nup = 'y'\n").points() ==
          std::vector<glm::dvec3>{{1, 2, 3}});
}

TEST_CASE("the corners of meshes are points, with y upwards", "[markers]") {
    CHECK(PointFile("crown.obj", "v 1 2 3\nv 4 5 6\n").points() == std::vector<glm::dvec3>{{1, 2, 3}, {4, 5, 6}});
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\n"
        "property double z\nend_header\n1 2 3\n";
    CHECK(PointFile("crown.ply", ply).points() == std::vector<glm::dvec3>{{1, 2, 3}});
}

TEST_CASE("points on a map are relative to the origin of the scene", "[markers]") {
    PointFile file("crown.xyz", "592783.25 5432100.5 3\n");
    MapOrigin origin(glm::dvec3(592783, 0, -5432100));
    const MapOrigin::Scope of_files(&origin);
    CHECK(file.points() == std::vector<glm::dvec3>{{0.25, 3, -0.5}});
}

TEST_CASE("files without points, or with too many, are refused", "[markers]") {
    CHECK_THAT(PointFile("crown.xyz", "# nothing\n").mistake(), Catch::Contains("has no points"));
    CHECK_THAT(PointFile("crown.xyz", "1 2 3\n1 2\n").mistake(), Catch::Contains("a row of points is x, y and z"));
    CHECK_THAT(PointFile("crown.xyz", "1 2 3\n4 5 6\n").mistake(1), Catch::Contains("2 points, more than"));
    CHECK_THAT(PointFile("crown.las", "LASF").mistake(), Catch::Contains("is LAS, which is not read"));
    CHECK_THAT(PointFile("crown.png", "1 2 3").mistake(), Catch::Contains("holds no points that are read"));
    CHECK_THAT(PointFile("crown.ply", "ply\n").mistake(), Catch::Contains("is not a whole ply file"));
}
