// Measures of branching on trees whose answers are known.
#include "analysis/branching.h"
#include "analysis/trees.h"
#include "analysis/widths.h"
#include "catch.h"

#include <array>

using namespace espalier;
using namespace espalier::analysis;

namespace {

int strahler(const BranchTree& tree) {
    return strahler_orders(tree).highest;
}

RamificationMatrix ramification(const BranchTree& tree) {
    return ramification_matrix(tree, strahler_orders(tree));
}

HortonRatios horton(const BranchTree& tree) {
    return horton_ratios(streams(tree, strahler_orders(tree)));
}

/// A stem with branches of these radii on it.
BranchTree fork(double radius, const std::vector<double>& radii) {
    BranchTree tree;
    tree.add(BranchTree::ground, {0, 0, 0}, {0, 1, 0}, radius, radius);
    for (const double branch : radii) tree.add(0, {0, 1, 0}, {0, 2, 0}, branch, branch);
    return tree;
}

void check_sums(const RamificationMatrix& matrix) {
    for (const std::vector<double>& row : matrix.rows) {
        double sum = 0;
        for (const double part : row) sum += part;
        CHECK(sum == Approx(1).epsilon(1e-12));
    }
}

}  // namespace

TEST_CASE("Strahler: nothing is 0, a chain 1, a caterpillar 2, a perfect binary tree its depth + 1", "[analysis]") {
    CHECK(strahler({}) == 0);
    CHECK(strahler(chain(1)) == 1);
    CHECK(strahler(chain(100)) == 1);
    CHECK(strahler(caterpillar(100)) == 2);
    for (const int depth : {1, 2, 5, 12}) CHECK(strahler(binary_tree(depth)) == depth + 1);
}

TEST_CASE("Strahler: two branches of equal order raise it by one, three too, a lower one does not", "[analysis]") {
    CHECK(strahler(fork(1, {1, 1})) == 2);
    CHECK(strahler(fork(1, {1, 1, 1})) == 2);
    BranchTree tree = fork(1, {1, 1});
    tree.add(1, {0, 2, 0}, {0, 3, 0}, 1, 1);
    tree.add(1, {0, 2, 0}, {1, 3, 0}, 1, 1);
    const StrahlerOrders orders = strahler_orders(tree);
    CHECK(orders.orders == std::vector<std::uint8_t>{2, 2, 1, 1, 1});
}

TEST_CASE("Strahler: branches that meet on the ground meet as at a fork", "[analysis]") {
    BranchTree tree = chain(3);
    tree.add(BranchTree::ground, {0, 0, 0}, {1, 0, 0}, 1, 1);
    CHECK(strahler(tree) == 2);
    const RamificationMatrix matrix = ramification(tree);
    REQUIRE(matrix.rows.size() == 1);
    CHECK(matrix.rows[0] == std::vector<double>{0, 1});
    CHECK(streams(tree, strahler_orders(tree)).size() == 1);
    CHECK(count_branching(tree).forks == 1);
}

TEST_CASE("ramification: a perfect binary tree gives the shifted identity, a caterpillar one fork of equals",
          "[analysis]") {
    const RamificationMatrix perfect = ramification(binary_tree(6));
    REQUIRE(perfect.rows.size() == 6);
    for (std::size_t i = 0; i < perfect.rows.size(); ++i) {
        std::vector<double> expected(i + 2, 0);
        expected.back() = 1;
        CHECK(perfect.rows[i] == expected);
        CHECK(perfect.forks[i] == std::size_t{1} << (5 - i));
    }
    const RamificationMatrix comb = ramification(caterpillar(101));
    REQUIRE(comb.rows.size() == 1);
    CHECK(comb.rows[0][0] == Approx(0.99));
    CHECK(comb.rows[0][1] == Approx(0.01));
    CHECK(comb.forks[0] == 100);
}

TEST_CASE("ramification: a fork of four is three forks of two, the highest orders first", "[analysis]") {
    const RamificationMatrix matrix = ramification(fork(1, {1, 1, 1, 1}));  // (1,1), then (2,1) twice
    REQUIRE(matrix.rows.size() == 1);
    CHECK(matrix.forks[0] == 3);
    CHECK(matrix.rows[0][0] == Approx(2.0 / 3));
    CHECK(matrix.rows[0][1] == Approx(1.0 / 3));
}

TEST_CASE("ramification: random binary trees of 10^5 nodes tend to 1/2, 1/4, 1/8, ..., the last two equal",
          "[analysis]") {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const BranchTree tree = random_binary_tree(50000, seed);
        REQUIRE(tree.size() == 100001);
        const RamificationMatrix matrix = ramification(tree);
        check_sums(matrix);
        std::size_t rows = 0;
        for (std::size_t i = 0; i < matrix.rows.size() && matrix.forks[i] >= 1500; ++i, ++rows) {
            const std::vector<double>& row = matrix.rows[i];
            for (std::size_t j = 0; j < row.size(); ++j) {
                const auto power = static_cast<double>(std::min(j + 1, row.size() - 1));
                CAPTURE(seed, i, j, matrix.forks[i]);
                CHECK(std::abs(row[j] - std::exp2(-power)) < 0.02);
            }
        }
        CHECK(rows >= 3);
        CHECK(matrix.rows.size() >= 7);
    }
}

TEST_CASE("Horton: a perfect binary tree doubles; lengths and diameters grow by the ratios it was made with",
          "[analysis]") {
    const HortonRatios ratios = horton(binary_tree(7, 0.8, 0.6));
    CHECK(ratios.branching == Approx(2).epsilon(1e-9));
    CHECK(ratios.length == Approx(1 / 0.8).epsilon(1e-9));
    CHECK(ratios.diameter == Approx(1 / 0.6).epsilon(1e-9));
    CHECK(std::isnan(horton(chain(5)).branching));
    CHECK(std::isnan(horton(binary_tree(3, 1, 0)).diameter));
    // Random trees tend to 4 (Shreve 1966).
    CHECK(horton(random_binary_tree(50000, 4)).branching == Approx(4).epsilon(0.1));
}

TEST_CASE("streams: their number, internodes, lengths and widths are counted by order", "[analysis]") {
    BranchTree tree = chain(4);
    tree.add(1, {0, 2, 0}, {3, 2, 0}, 0.5, 0.5);
    const std::vector<StreamOrder> of = streams(tree, strahler_orders(tree));
    REQUIRE(of.size() == 2);
    CHECK(of[0].streams == 2);
    CHECK(of[0].internodes == 3);
    CHECK(of[0].mean_length == Approx((2 + 3) / 2.0));
    CHECK(of[0].mean_diameter == Approx((2 * 2 + 3 * 1) / 5.0));
    CHECK(of[1].streams == 1);
    CHECK(of[1].mean_length == Approx(2));
}

TEST_CASE("counts: tips, forks, depth and the longest path", "[analysis]") {
    const BranchingCounts perfect = count_branching(binary_tree(5));
    CHECK(perfect.tips == 32);
    CHECK(perfect.forks == 31);
    CHECK(perfect.depth == 5);
    CHECK(perfect.longest_path == Approx(6));
    const BranchingCounts comb = count_branching(caterpillar(100));
    CHECK(comb.tips == 100);
    CHECK(comb.depth == 99);
    CHECK(comb.longest_path == Approx(100));
}

TEST_CASE("a chain of a million internodes is measured without recursion", "[analysis]") {
    const BranchTree tree = caterpillar(500001);
    CHECK(strahler(tree) == 2);
    CHECK(count_branching(tree).depth == 500000);
    CHECK(ramification(tree).forks[0] == 500000);
    CHECK(fork_widths(tree).forks == 500000);
}

TEST_CASE("pipe model: the exponent a tree was made with comes back, of two branches and of three", "[analysis]") {
    for (const double exponent : {0.7, 1.0, 2.0, 2.49, 3.0, 5.0}) {
        const ForkWidths widths = fork_widths(binary_tree(6, 0.9, std::exp2(-1 / exponent)));
        CHECK(widths.exponent == Approx(exponent).epsilon(1e-12));
        CHECK(widths.median_exponent == Approx(exponent).epsilon(1e-12));
        CHECK(widths.forks_with_exponent == 63);
        const double third = std::pow(1 - std::pow(0.9, exponent) - std::pow(0.2, exponent), 1 / exponent);
        if (third > 0) CHECK(fork_widths(fork(1, {0.9, 0.2, third})).exponent == Approx(exponent).epsilon(1e-9));
    }
}

TEST_CASE("pipe model: pieces that one module is drawn in, tapering, count as one", "[analysis]") {
    const double thin = std::pow(0.5, 1 / 2.4);
    BranchTree tree;
    std::int32_t at = tree.add(BranchTree::ground, {0, 0, 0}, {0, 1, 0}, 1, 1, 1);
    for (const double side : {-1.0, 1.0}) {
        std::int32_t below = at;
        for (int piece = 0; piece < 3; ++piece) {
            const double r = 1 + (thin - 1) * (piece + 1) / 3.0;
            const auto module = static_cast<std::uint64_t>(side + 5);
            below = tree.add(below, {side * piece, 1 + piece, 0}, {side * (piece + 1), 2 + piece, 0}, 1, r, module);
        }
    }
    const ForkWidths widths = fork_widths(tree);
    CHECK(widths.forks == 1);
    CHECK(widths.exponent == Approx(2.4));
    CHECK(widths.area_ratio == Approx(2 * thin * thin));
}

TEST_CASE("pipe model: a fork with a branch as thick as its bearer has no exponent and spoils no other", "[analysis]") {
    BranchTree tree = fork(1, {1, 0.5});
    tree.add(1, {0, 2, 0}, {0, 3, 0}, std::sqrt(0.5), std::sqrt(0.5));
    tree.add(1, {0, 2, 0}, {1, 3, 0}, std::sqrt(0.5), std::sqrt(0.5));
    const ForkWidths widths = fork_widths(tree);
    CHECK(widths.forks == 2);
    CHECK(widths.forks_with_exponent == 1);
    CHECK(widths.exponent == Approx(2));
    CHECK(std::isnan(fork_widths(fork(1, {1, 1})).exponent));
    CHECK(std::isnan(fork_widths(fork(0, {1, 1})).area_ratio));
    CHECK(fork_widths(fork(1, {1 - 1e-12, 1e-9})).exponent > 1);
    // Between two exponents of single forks lies that of both.
    BranchTree two = binary_tree(1, 1, std::exp2(-1 / 2.0));
    const BranchTree other = fork(std::exp2(-1 / 2.0), {0.5, 0.5});
    for (std::size_t i = 1; i < 3; ++i) two.add(1, other.bases[i], other.tips[i], 0.4, 0.4);
    const ForkWidths both = fork_widths(two);
    CHECK(both.exponent > 1);
    CHECK(both.exponent < 2);
}

TEST_CASE("da Vinci: a Pythagoras tree keeps the sum of areas at every fork", "[analysis]") {
    const ForkWidths widths = fork_widths(binary_tree(10, std::sqrt(0.5), std::sqrt(0.5)));
    CHECK(widths.forks == 1023);
    CHECK(widths.area_ratio == Approx(1).epsilon(1e-12));
    CHECK(widths.largest_area_error < 1e-9);
    const ForkWidths unequal = fork_widths(fork(5, {3, 4.1}));
    CHECK(unequal.area_ratio == Approx((9 + 4.1 * 4.1) / 25));
    CHECK(unequal.largest_area_error == Approx((9 + 4.1 * 4.1) / 25 - 1));
}
