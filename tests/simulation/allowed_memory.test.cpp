#include "simulation/run/allowed_memory.h"

#include "espalier/simulation/simulation.h"

#include "base/link_mark.h"
#include "catch.h"
#include "temporary_folder.h"

#include <algorithm>

using namespace espalier;

TEST_CASE("what came by a link may take 1 GiB, unless the user says otherwise", "[simulation]") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "shared/name/deep");
    folder.write("shared/name/" + std::string(link_mark), "");
    const std::size_t gibibyte = std::size_t{1} << 30, three = 3 * gibibyte;
    for (const char* inside : {"shared/name", "shared/name/plant.l", "shared/name/deep/plant.l"}) {
        CHECK(simulation::allowed_memory(0, folder.path() / inside) == std::min(gibibyte, default_memory()));
        CHECK(simulation::allowed_memory(three, folder.path() / inside) == three);
    }
    CHECK(simulation::allowed_memory(0, folder.path() / "shared/plant.l") == default_memory());
    CHECK(simulation::allowed_memory(three, folder.path() / "plant.l") == three);
}
