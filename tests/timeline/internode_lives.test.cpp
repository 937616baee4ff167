#include "timeline/measures/internode_lives.h"

#include "base/bytes.h"
#include "catch.h"

#include <sstream>

using namespace espalier;
using namespace espalier::timeline;

namespace {

/// Bytes of a checkpoint with one internode, at step 3.
std::string with_life(std::uint8_t alive) {
    std::ostringstream out;
    InternodeLife life{};
    life.identity = 7;
    life.alive = alive;
    put(out, 3);
    put(out, std::uint64_t{1});
    put(out, life);
    put(out, std::uint64_t{0});
    return out.str();
}

}  // namespace

TEST_CASE("a life of a checkpoint that is neither alive nor dead is refused", "[timeline]") {
    for (const std::uint8_t alive : {0, 1, 2}) {
        InternodeLives lives;
        std::istringstream in(with_life(alive));
        if (alive > 1) {
            CHECK_THROWS_WITH(lives.restore(in), "the checkpoint is damaged");
            continue;
        }
        lives.restore(in);
        REQUIRE(lives.all().size() == 1);
        CHECK(lives.all()[0].identity == 7);
        CHECK(lives.all()[0].alive == alive);
    }
}
