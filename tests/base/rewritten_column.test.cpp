// Columns that every frame writes anew.
#include "base/rewritten_column.h"

#include "catch.h"

#include <algorithm>
#include <limits>
#include <random>
#include <span>
#include <vector>

using namespace espalier;

TEST_CASE("a column written anew knows whether it holds what it held before", "[base]") {
    std::mt19937 random(3);
    RewrittenColumn<float> column;
    std::vector<float> before, now;
    for (int frame = 0; frame < 2000; ++frame) {
        // Mostly as it was, else longer, shorter or with another number; some are none.
        if (random() % 3 == 0) now.resize(random() % 40, std::numeric_limits<float>::quiet_NaN());
        if (random() % 3 == 0 && !now.empty()) now[random() % now.size()] = float(random() % 5);
        if (random() % 5 == 0) column.reserve(random() % 100);
        column.begin();
        std::size_t at = 0;
        while (at < now.size()) {
            const std::size_t tuples = std::min<std::size_t>((now.size() - at) / 3, random() % 4);
            column.add_tuples<3>(tuples, [&](std::size_t, float* tuple) {
                for (int k = 0; k < 3; ++k) tuple[k] = now[at++];
            });
            if (at < now.size()) column.add(now[at++]);
        }
        const auto same = [](std::span<const float> a, std::span<const float> b) {
            return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_bits<float>);
        };
        CHECK(same(column.values(), now));
        CHECK(column.changed() == !same(before, now));
        before = now;
    }
}
