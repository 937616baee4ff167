// Frames that are cut into several files read back as one.
#include "archive/joined_pieces.h"

#include "archive/equal_columns.h"
#include "archive/recorded_folder.h"
#include "catch.h"

#include <array>
#include <cmath>
#include <cstdint>

using namespace espalier;
using namespace espalier::archive;

TEST_CASE("a frame in several files is the frame in one", "[reading]") {
    const RecordedFolder whole, cut("points_per_file = 1\n");
    const RecordedRun one(whole.folder.path), several(cut.folder.path);
    CHECK(one.frame(4).more_plants.empty());
    REQUIRE(several.frame(4).more_plants.size() == 1);
    CHECK(several.frame(4).more_plants.front().filename() == "0004-1.vtp");
    for (const int step : {0, 4}) {
        INFO("step " << step);
        const FrameGeometry a = one.geometry(one.frame(step)), b = several.geometry(several.frame(step));
        REQUIRE(a.polygons.size() == 1);
        CHECK(a.points == b.points);
        CHECK(a.normals == b.normals);
        CHECK(a.uvs == b.uvs);
        CHECK(a.radii == b.radii);
        CHECK(a.textures == b.textures);
        CHECK(a.back_colours == b.back_colours);
        CHECK(a.symbol_names == b.symbol_names);
        check_equal(a.of_points, b.of_points);
        check_equal(a.of_cells, b.of_cells);
        check_equal(a.vertices, b.vertices);
        check_equal(a.lines, b.lines);
        check_equal(a.polygons, b.polygons);
        REQUIRE(b.parameters.size() == 2);
        for (const auto& [name, column] : a.parameters) {
            const auto& other = b.parameters.at(name);
            REQUIRE(other.size() == column.size());
            for (std::size_t i = 0; i < column.size(); ++i) {
                CHECK((other[i] == column[i] || (std::isnan(other[i]) && std::isnan(column[i]))));
            }
        }
        CHECK(internodes_of(a).size() == internodes_of(b).size());
    }
}

TEST_CASE("pieces that lack a column get the values of none", "[reading]") {
    const auto piece_of = [](std::size_t points) {
        FrameGeometry piece;
        piece.points.resize(points);
        piece.normals.resize(points);
        piece.uvs.resize(points);
        piece.radii.resize(points);
        piece.of_points.for_columns([&](const char*, auto& column) { column.resize(points); });
        return piece;
    };
    const FrameGeometry plain = piece_of(2);
    FrameGeometry rich = piece_of(1);
    rich.pixels = {2.5f};
    rich.parameters["mass"] = {7};
    rich.of_points.rgb = {{1, 2, 3}};
    const FrameGeometry all = joined({plain, rich, plain});
    CHECK(all.pixels == Column<float>{0, 0, 2.5f, 0, 0});
    CHECK(all.of_points.rgb.size() == 5);
    CHECK(all.of_points.rgb[2] == std::array<std::uint8_t, 3>{1, 2, 3});
    REQUIRE(all.parameters.at("mass").size() == 5);
    CHECK(std::isnan(all.parameters.at("mass")[1]));
    CHECK(all.parameters.at("mass")[2] == 7);
    CHECK(std::isnan(all.parameters.at("mass")[4]));
}
