// Which steps of a run its log tells of.
#include "app/progress.h"

#include "catch.h"

#include <vector>

using namespace espalier;

namespace {

/// Of a run of so many steps that take so many seconds each.
std::vector<int> told(int steps, double seconds) {
    app::LoggedSteps logged;
    std::vector<int> told;
    for (int step = 0; step <= steps; ++step) {
        if (logged.take({step, steps, 1, step * seconds})) told.push_back(step);
    }
    return told;
}

}  // namespace

TEST_CASE("a log tells of every tenth part of a run, and of a step a minute", "[app]") {
    CHECK(told(40, 0.01) == std::vector<int>{4, 8, 12, 16, 20, 24, 28, 32, 36, 40});
    CHECK(told(3, 0.01) == std::vector<int>{1, 2, 3});
    CHECK(told(100, 20) == std::vector<int>{3,  6,  9,  10, 13, 16, 19, 20, 23, 26, 29, 30, 33, 36,
                                            39, 40, 43, 46, 49, 50, 53, 56, 59, 60, 63, 66, 69, 70,
                                            73, 76, 79, 80, 83, 86, 89, 90, 93, 96, 99, 100});
    CHECK(told(1000, 60).size() == 1000);
    CHECK(told(0, 1).empty());
}
