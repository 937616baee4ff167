// Organs by number: each module once, axes before surfaces.
#include "archive/frame_organs.h"

#include "espalier/simulation/simulation.h"
#include "espalier/timeline/last_frame.h"

#include "catch.h"
#include "temporary_folder.h"

#include <algorithm>

using namespace espalier;
using Catch::Contains;

TEST_CASE("organs of a frame have numbers, one for the axes and one for the surfaces of a module", "[archive]") {
    const TemporaryFolder folder;
    Scene scene;
    scene.plants.push_back(plant_of_file(folder.write("model.l",
                                                      "lsystem: 1\nderivation length: 1\naxiom: A F(1)\n"
                                                      "A --> F(1)[+(40)F(0.5){.f(1).+(90)f(1).+(90)f(1).}]@O(0.2)\n"
                                                      "endlsystem\n"),
                                         {}));
    LastFrame last;
    RunOptions options;
    options.recorder = &last;
    espalier::run(scene, options);
    const FrameGeometry& geometry = *last.geometry();
    const archive::FrameOrgans organs(geometry);
    std::size_t axes = 0;
    for (const FrameInternode& internode : internodes_of(geometry)) {
        const auto number = organs.of_point(internode.tip_point.row());
        REQUIRE(number);
        CHECK(organs.all()[*number].identity == internode.identity);
        CHECK(organs.all()[*number].plant == internode.plant);
        CHECK_FALSE(organs.all()[*number].is_leaf);
        axes = std::max<std::size_t>(axes, *number + 1);
    }
    for (std::size_t cell = 0; cell < geometry.polygons.size(); ++cell) {
        const std::size_t row = geometry.polygons.first + cell;
        const auto number = organs.of_cell(row);
        REQUIRE(number);
        CHECK(*number >= axes);
        CHECK(organs.all()[*number].identity == geometry.of_cells.identities[row]);
        CHECK(organs.all()[*number].is_leaf);
    }
    const std::string table = organ_table(organs, geometry.symbol_names, {"a, b"}, 5);
    CHECK_THAT(table, Contains("organ,plant,name,identity,symbol_number,symbol,order,birth,age,leaf\n0,0,\"a, b\","));
    CHECK(std::count(table.begin(), table.end(), '\n') == static_cast<std::ptrdiff_t>(organs.all().size()) + 1);
}
