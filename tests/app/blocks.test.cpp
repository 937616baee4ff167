// A world of which some blocks of plants wait on disk, on the command line.
#include "catch.h"
#include "program.h"
#include "recorded_files.h"

using Catch::Contains;

namespace {

class Blocks : public Workplace {
public:
    Blocks() {
        write("growing.l",
              "environment light;\nlsystem: 1\nseed: 2\nderivation length: 12\naxiom: A(1)\n"
              "A(x) --> F(x)[+A(x*0.9)?light(1)] : 1\nA(x) --> F(x)A(x*0.99) : 2\nendlsystem\n");
        write("stand.toml",
              "[[plant]]\nmodel = \"growing.l\"\ngrid = { columns = 3, rows = 3, spacing = 1 }\n"
              "[environment.light]\nprocess = \"voxel-shade\"\n");
    }
};

}  // namespace

TEST_CASE_METHOD(Blocks, "--blocks and --resident change no file of a run", "[app][store]") {
    REQUIRE(run("run stand.toml --quiet --output whole").code == 0);
    REQUIRE(run("run stand.toml --quiet --output cut --blocks 5 --resident 2").code == 0);
    const auto whole = recorded_files(path() / "whole");
    CHECK(whole.size() > 10);
    CHECK(recorded_files(path() / "cut") == whole);
}

TEST_CASE_METHOD(Blocks, "--resident without --blocks, and no blocks at all, are errors", "[app][store]") {
    const Outcome alone = run("run stand.toml --quiet --resident 2");
    CHECK(alone.code == 1);
    CHECK_THAT(alone.err, Contains("--blocks"));
    const Outcome none = run("run stand.toml --quiet --blocks 0");
    CHECK(none.code == 1);
    CHECK_THAT(none.err, Contains("--blocks"));
}
