#include "espalier/base/index.h"

#include "catch.h"

#include <type_traits>
#include <unordered_set>

using namespace espalier;

namespace {

using AppleIndex = Index<struct Apple>;
using PearIndex = Index<struct Pear>;

template <class Rows, class Key>
concept IsIndexedBy = requires(Rows rows, Key key) {
    rows[key];
};

using Weights = RowsOf<Apple, double>;

}  // namespace

TEST_CASE("indices of two kinds are neither equal nor exchanged, and no number becomes one by itself", "[base]") {
    STATIC_REQUIRE_FALSE(std::is_convertible_v<AppleIndex, PearIndex>);
    STATIC_REQUIRE_FALSE(std::is_convertible_v<int, AppleIndex>);
    STATIC_REQUIRE_FALSE(std::is_convertible_v<AppleIndex, int>);
    STATIC_REQUIRE_FALSE(std::is_constructible_v<PearIndex, AppleIndex>);
    STATIC_REQUIRE_FALSE(std::equality_comparable_with<AppleIndex, PearIndex>);
    STATIC_REQUIRE(IsIndexedBy<Weights, AppleIndex>);
    STATIC_REQUIRE_FALSE(IsIndexedBy<Weights, PearIndex>);
    STATIC_REQUIRE_FALSE(IsIndexedBy<Weights, int>);
}

TEST_CASE("an index is the integer that it holds", "[base]") {
    STATIC_REQUIRE(sizeof(AppleIndex) == 4);
    STATIC_REQUIRE(std::is_trivially_copyable_v<AppleIndex>);
    CHECK(AppleIndex().is_none());
    CHECK(AppleIndex(std::size_t{3}).row() == 3);
    CHECK(AppleIndex(3).next() == AppleIndex(4));
    CHECK(AppleIndex(3).before() < AppleIndex(3));
    CHECK(std::unordered_set<AppleIndex>{AppleIndex(1), AppleIndex(1), AppleIndex(2)}.size() == 2);
}

TEST_CASE("rows are found by the index that they were added with", "[base]") {
    Weights weights;
    const AppleIndex first = weights.next();
    weights.push_back(0.25);
    const AppleIndex second = weights.next();
    weights.push_back(0.5);
    weights[first] = 0.125;
    CHECK(weights[first] == 0.125);
    CHECK(weights[second] == 0.5);
    CHECK(weights.next() == AppleIndex(2));
    double sum = 0;
    for (const double weight : weights) sum += weight;
    CHECK(sum == 0.625);
}
