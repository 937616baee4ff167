// Plants that shade each other, and whether two runs of them recorded the same.
#pragma once

#include "catch.h"
#include "recorded_files.h"

#include <filesystem>

// Branches of 2 m and more reach across the borders of blocks that are 2 m wide.
inline const char* const shading =
    "environment light;\nlsystem: 1\nseed: 2\nderivation length: 9\naxiom: A(1)\n"
    "A(x) --> F(x)?light(1)[+A(x*0.9)?light(1)]/(90)A(x) : 1\n"
    "A(x) --> F(x)[-A(x*0.8)?light(1)]A(x*0.99)?light(1) : 2\n"
    "?light(q) : q < 0.2 --> \nF(x) : x < 4 --> F(x*1.01)\nhomomorphism\nA(x) --> @O(0.1)\nendlsystem\n";

// 16 plants of 160,000 modules at the end; recorded are the first frame and the last.
inline const char* const doubling = "lsystem: 1\nderivation length: 15\naxiom: A\nA --> F[+A]A\nendlsystem\n";
inline const char* const doubling_stand =
    "[[plant]]\nmodel = 'doubling.l'\ngrid = { columns = 16, rows = 1, spacing = 9 }\n"
    "[timeline]\nevery = 15\nlifespans = false\n";

inline const char* const light =
    "[environment.light]\nprocess = 'voxel-shade'\nvoxel = 0.5\nmode = 'attenuate'\ndepth = 5\n";

inline void check_same_files(const std::filesystem::path& one, const std::filesystem::path& other) {
    const auto expected = recorded_files(one), recorded = recorded_files(other);
    REQUIRE(expected.size() > 10);
    REQUIRE(recorded.size() == expected.size());
    for (const auto& [name, bytes] : expected) {
        INFO(name);
        CHECK(recorded.at(name) == bytes);
    }
}
