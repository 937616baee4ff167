// The linear equations of soil that stores next to nothing, in which every voxel feels every other.
#include "environment/soil/richards/linear_system.h"

#include "catch.h"

#include <Eigen/Dense>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <random>

namespace espalier::test {
namespace {

using namespace espalier::environment;

/// Conductances over two decades, a drift downwards, and little storage.
struct Equations {
    SoilRows rows;
    std::array<FaceFluxes, 3> fluxes;
    WaterBrick diagonal, b;
    std::vector<SoilMatrix::RankOne> less;

    Equations(glm::ivec3 size, bool periodic, unsigned seed, double storage = 1e-12)
        : rows(WaterGrid(Box{glm::dvec3(0), glm::dvec3(size)}, 1, false), periodic) {
        const WaterGrid& grid = rows.grid();
        for (FaceFluxes& axis : fluxes) axis.resize(grid.cells());
        for (WaterBrick* brick : {&diagonal, &b}) brick->assign(grid.cells(), 0.0);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> uniform(-1, 1);
        grid.for_each_cell([&](std::size_t c) {
            diagonal[c] += storage;
            b[c] = uniform(random);
            for (int axis = 0; axis < 3; ++axis) join(axis, c, std::pow(10, uniform(random)));
        });
        grid.for_rows([&](std::size_t row) {
            for (WaterBrick* brick : {&fluxes[0].by_own, &fluxes[0].by_next}) {
                rows.wrap(brick->data() + grid.row_begin(row));
            }
        });
    }

    void join(int axis, std::size_t c, double conductance) {
        const WaterGrid& grid = rows.grid();
        glm::ivec3 next = grid.voxel_of(c);
        const int length = grid.size()[axis];
        const bool joined = axis == 0 ? rows.joined_x() : axis == 2 && rows.joined_z();
        if (++next[axis] == length && !joined) return;
        next[axis] %= length;
        if (grid.cell(next) == c) return;
        const double drift = axis == 1 ? 0.1 : 0;
        fluxes[axis].by_own[c] = conductance * (1 - drift);
        fluxes[axis].by_next[c] = -conductance * (1 + drift);
        diagonal[c] += fluxes[axis].by_own[c];
        diagonal[grid.cell(next)] -= fluxes[axis].by_next[c];
    }

    /// Roots of one collar in every third voxel, which take from one what they do not take from another.
    void join_uptake() {
        SoilMatrix::RankOne& roots = less.emplace_back();
        rows.grid().for_each_cell([&](std::size_t c) {
            if (c % 3 != 0) return;
            diagonal[c] += 1;
            roots.u.emplace_back(c, 1.0);
        });
        roots.factor = 0.9 / static_cast<double>(roots.u.size());
    }

    int solve(WaterBrick& x, double tolerance) {
        SoilLinearSystem system(rows);
        system.diagonal() = diagonal;
        system.less() = less;
        x.assign(rows.grid().cells(), 0.0);
        return system.solve(fluxes, b, tolerance, x);
    }

    Eigen::MatrixXd dense(std::vector<std::size_t>& cells) const {
        const WaterGrid& grid = rows.grid();
        std::vector<Eigen::Index> number(grid.cells());
        grid.for_each_cell([&](std::size_t c) {
            number[c] = static_cast<Eigen::Index>(cells.size());
            cells.push_back(c);
        });
        Eigen::MatrixXd j = Eigen::MatrixXd::Zero(number[cells.back()] + 1, number[cells.back()] + 1);
        for (const std::size_t c : cells) {
            j(number[c], number[c]) += diagonal[c];
            for (int axis = 0; axis < 3; ++axis) {
                glm::ivec3 next = grid.voxel_of(c);
                next[axis] = (next[axis] + 1) % grid.size()[axis];
                const Eigen::Index other = number[grid.cell(next)];
                j(number[c], other) += fluxes[axis].by_next[c];
                j(other, number[c]) -= fluxes[axis].by_own[c];
            }
        }
        for (const SoilMatrix::RankOne& one : less) {
            for (const auto& [a, of_a] : one.u) {
                for (const auto& [b, of_b] : one.u) j(number[a], number[b]) -= one.factor * of_a * of_b;
            }
        }
        return j;
    }
};

}  // namespace

TEST_CASE("heads of soil that stores next to nothing are those of a direct solver", "[environment][soil]") {
    const bool periodic = GENERATE(false, true);
    const glm::ivec3 size = GENERATE(glm::ivec3(5, 4, 3), glm::ivec3(2, 9, 2), glm::ivec3(7, 3, 1), glm::ivec3(1, 6, 4),
                                     glm::ivec3(4, 5, 3), glm::ivec3(13, 4, 1), glm::ivec3(8, 5, 6));
    const bool joint = GENERATE(false, true);
    Equations equations(size, periodic, 5, 1e-5);
    if (joint) equations.join_uptake();
    std::vector<std::size_t> cells;
    const Eigen::MatrixXd j = equations.dense(cells);
    WaterBrick x;
    CHECK(equations.solve(x, 1e-12) >= 0);
    Eigen::VectorXd ours(j.rows()), b(j.rows());
    for (Eigen::Index i = 0; i < j.rows(); ++i) {
        ours[i] = x[cells[static_cast<std::size_t>(i)]];
        b[i] = equations.b[cells[static_cast<std::size_t>(i)]];
    }
    const Eigen::VectorXd theirs = j.fullPivLu().solve(b);
    CHECK((ours - theirs).norm() < 1e-6 * theirs.norm());
}

TEST_CASE("few columns of full soil are solved without iterations", "[environment][soil]") {
    const bool periodic = GENERATE(false, true);
    const glm::ivec3 size = GENERATE(glm::ivec3(1, 200, 1), glm::ivec3(2, 200, 1), glm::ivec3(2, 200, 2),
                                     glm::ivec3(3, 100, 3), glm::ivec3(1, 50, 12));
    WaterBrick x;
    CHECK(Equations(size, periodic, 11, 1e-9).solve(x, 1e-5) == 0);
}

TEST_CASE("the iterations do not grow with the width of full soil", "[environment][soil]") {
    const bool periodic = GENERATE(false, true);
    const unsigned seed = GENERATE(1u, 2u, 3u);
    WaterBrick x;
    for (const int width : {8, 16, 32, 45}) {
        CHECK(Equations(glm::ivec3(width, 12, width), periodic, seed).solve(x, 1e-6) <= 25);
    }
}

TEST_CASE("multigrid gives the same bytes with any number of threads", "[environment][soil]") {
    std::array<WaterBrick, 2> x;
    for (int threads = 1; threads <= 2; ++threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        CHECK(Equations(glm::ivec3(40, 20, 40), true, 7).solve(x[threads - 1], 1e-8) > 0);
    }
    CHECK(std::memcmp(x[0].data(), x[1].data(), x[0].size() * sizeof(double)) == 0);
}

}  // namespace espalier::test
