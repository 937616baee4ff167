// Distributions of what is known of a parameter before.
#include "study/fit/prior.h"

#include "catch.h"

#include <cmath>

using namespace espalier::study;

TEST_CASE("the normal distribution has the quantiles of tables", "[fit]") {
    CHECK(normal_quantile(0.5) == 0);
    CHECK(normal_quantile(0.975) == Approx(1.959963984540054).epsilon(1e-14));
    CHECK(normal_quantile(0.05) == Approx(-1.6448536269514722).epsilon(1e-14));
    CHECK(normal_quantile(1e-10) == Approx(-6.361340902404056).epsilon(1e-13));
    for (const double share : {1e-8, 0.01, 0.3, 0.77, 0.9999}) {
        CHECK(normal_share(normal_quantile(share)) == Approx(share).epsilon(1e-12));
    }
}

TEST_CASE("the share below a quantile is the one it was asked for", "[fit]") {
    const Prior priors[] = {Prior::uniform(-2, 5), Prior::log_uniform(0.01, 3), Prior::normal(40, 5, 0, 90),
                            Prior::normal(1, 4, 0.5, 2)};
    for (const Prior& prior : priors) {
        INFO(prior.text());
        for (const double share : {0.001, 0.2, 0.5, 0.93}) {
            CHECK(prior.share_below(prior.quantile(share)) == Approx(share).epsilon(1e-9));
        }
    }
    CHECK(Prior::log_uniform(0.01, 1).quantile(0.5) == Approx(0.1));
    CHECK(Prior::normal(40, 5, -1e9, 1e9).quantile(0.5) == Approx(40));
}

TEST_CASE("whole numbers are equally probable, both ends among them", "[fit]") {
    const Prior dice = Prior::uniform(1, 6, true);
    int counts[7] = {};
    for (int i = 0; i < 600; ++i) ++counts[static_cast<int>(dice.quantile((i + 0.5) / 600))];
    for (int face = 1; face <= 6; ++face) CHECK(counts[face] == 100);
    CHECK(dice.share_below(3) == Approx(2.5 / 6));
}
