// Pages colour plants by what the processes of a growth know of each organ.
#include "espalier/simulation/world.h"

#include "session_fixture.h"

#include <cmath>

using namespace studio_test;

namespace {

/// A stem with leaves above each other, in light from above.
const char* const ladder = R"(lsystem: 1
derivation length: 3
axiom: A
A --> F(0.3) L A
homomorphism
L --> { . f(0.1) . +(90) f(0.1) . +(90) f(0.1) . }
endlsystem
)";

const char* const scene_of_columns = R"([[plant]]
model = "plant.l"
[environment.light]
process = "canopy-light"
voxel = 0.1
sky = { par = 1000, diffuse = 1 }
[timeline]
organs = ["light.front", "light.brightest"]
)";

struct OpenLadder : OpenStudio {
    OpenLadder() : OpenStudio(ladder) { options.opened.path = folder.write("scene.toml", scene_of_columns); }

    /// A value for each module.
    std::vector<float> column(int step, const std::string& name) {
        page.packets.clear();
        const Json growth = page.last("growth")["growth"];
        ask({{"do", "column"}, {"growth", growth}, {"step", step}, {"name", name}});
        REQUIRE(!page.packets.empty());
        const std::string& bytes = page.packets.back();
        REQUIRE(bytes.substr(0, 4) == "ESC1");
        CHECK(number_at<std::int32_t>(bytes, 8) == step);
        std::vector<float> values(number_at<std::uint32_t>(bytes, 12));
        std::memcpy(values.data(), bytes.data() + bytes.size() - 4 * values.size(), 4 * values.size());
        return values;
    }
};

}  // namespace

TEST_CASE("a growth is coloured by the light that organs absorb, and by what its scene records of them", "[studio]") {
    OpenLadder studio;
    ListeningPage& page = studio.begin();
    studio.wait_until_grown();
    const Json names = page.last("columns")["columns"];
    CHECK(names[0] == "light.absorbed");
    CHECK(names[1] == "light.front");
    CHECK(names[2] == "age");  // directions are no numbers

    espalier::World world(read_as_run({studio.options.opened.path, {}, {}}));
    world.start();
    for (int step = 1; step <= 3; ++step) {
        world.step();
        for (const char* name : {"light.absorbed", "light.front"}) {
            INFO(name << " in step " << step);
            const std::vector<float> wanted = *world.environment().organ_values(name, 0);
            const std::vector<float> told = studio.column(step, name);
            REQUIRE(told.size() == wanted.size());
            int known = 0;
            for (std::size_t i = 0; i < told.size(); ++i) {
                CHECK((told[i] == wanted[i] || (std::isnan(told[i]) && std::isnan(wanted[i]))));
                known += std::isnan(told[i]) ? 0 : 1;
            }
            CHECK(known >= step);  // each step has made a leaf
        }
    }
    CHECK(studio.ask({{"do", "column"}, {"growth", 1}, {"step", 9}, {"name", "light.absorbed"}}).contains("error"));
}
