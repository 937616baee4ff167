// Water in a tree of roots, and the soil around a root: closed forms and a dense reference.
#include "catch.h"
#include "environment/soil/roots/hydraulic_tree.h"
#include "environment/soil/roots/zone.h"

#include <cmath>
#include <numbers>

namespace espalier::test {
namespace {

using namespace espalier::environment;

constexpr double radius = 0.2, axial = 0.0432, radial = 1.73e-4;
constexpr double around = 2 * std::numbers::pi * radius;

/// One root of 50 cm in soil at one total head, in equal pieces.
std::vector<RootPiece> one_root(int pieces, double outside) {
    std::vector<RootPiece> root;
    for (int i = 0; i < pieces; ++i) {
        const std::uint32_t bearer = i == 0 ? RootPiece::collar : static_cast<std::uint32_t>(i - 1);
        root.push_back({bearer, 50.0 / pieces, around, axial, radial, outside});
    }
    return root;
}

/// A main root with two laterals, each length cut into `parts`, in soil that is drier above.
std::vector<RootPiece> forked(int parts) {
    std::vector<RootPiece> pieces;
    const auto grow = [&](std::uint32_t bearer, double length, double kx, double kr, double outside) {
        for (int i = 0; i < parts; ++i) {
            pieces.push_back({bearer, length / parts, around, kx, kr, outside});
            bearer = static_cast<std::uint32_t>(pieces.size() - 1);
        }
        return bearer;
    };
    const std::uint32_t fork = grow(RootPiece::collar, 10, 0.4, 5e-5, -600);
    const std::uint32_t lower = grow(fork, 12, 0.1, 1e-4, -200);
    grow(fork, 8, 0.02, 4e-4, -500);
    grow(lower, 20, 0.02, 3e-4, -100);
    return pieces;
}

/// Nodes at tips, each with half the walls of the pieces that meet there; Gaussian elimination of the full matrix.
double dense_transpiration(const std::vector<RootPiece>& pieces, double collar) {
    const std::size_t n = pieces.size();
    std::vector<std::vector<double>> m(n, std::vector<double>(n + 1, 0));
    for (std::size_t i = 0; i < n; ++i) {
        const RootPiece& piece = pieces[i];
        const double along = piece.axial / piece.length;
        const double wall = 0.5 * piece.radial * piece.surface_per_length * piece.length;
        m[i][i] += along + wall;
        m[i][n] += wall * piece.outside;
        if (piece.bearer == RootPiece::collar) {
            m[i][n] += along * collar;
            continue;
        }
        m[piece.bearer][piece.bearer] += along + wall;
        m[piece.bearer][n] += wall * piece.outside;
        m[i][piece.bearer] -= along;
        m[piece.bearer][i] -= along;
    }
    for (std::size_t k = n; k-- > 0;) {  // from the tips: the matrix fills little
        for (std::size_t i = 0; i < k; ++i) {
            if (m[i][k] == 0) continue;
            const double f = m[i][k] / m[k][k];
            for (std::size_t j = 0; j <= k; ++j) m[i][j] -= f * m[k][j];
            m[i][n] -= f * m[k][n];
        }
    }
    std::vector<double> head(n);
    for (std::size_t i = 0; i < n; ++i) {
        double sum = m[i][n];
        for (std::size_t j = 0; j < i; ++j) sum -= m[i][j] * head[j];
        head[i] = sum / m[i][i];
    }
    const RootPiece& first = pieces[0];
    const double wall = 0.5 * first.radial * first.surface_per_length * first.length;
    return first.axial / first.length * (head[0] - collar) + wall * (first.outside - collar);
}

}  // namespace

TEST_CASE("one root has its closed form, however finely it is cut", "[environment][roots]") {
    const double tau = std::sqrt(around * radial / axial);
    const double exact = axial * tau * std::tanh(50 * tau) * 800;
    for (const int count : {1, 7, 100}) {
        const std::vector<RootPiece> root = one_root(count, -200);
        HydraulicTree tree;
        const CollarView view = tree.look(root);
        CHECK(view.head == Approx(-200));
        CHECK(view.conductance == Approx(exact / 800).epsilon(1e-12));
        RootFlow flow;
        tree.flow(root, -1000, flow);
        CHECK(flow.transpiration == Approx(exact).epsilon(1e-12));
        double sum = 0;
        for (int i = 0; i < count; ++i) {
            sum += flow.uptake[i];
            const double s = 50.0 * (i + 1) / count;
            CHECK(flow.tip[i] == Approx(-200 - 800 * std::cosh(tau * (50 - s)) / std::cosh(tau * 50)).epsilon(1e-10));
        }
        CHECK(sum == Approx(exact).epsilon(1e-12));
    }
}

TEST_CASE("a branched root is what a dense matrix of many small pieces has", "[environment][roots]") {
    HydraulicTree tree;
    RootFlow coarse;
    const std::vector<RootPiece> few = forked(1);
    tree.look(few);
    tree.flow(few, -3000, coarse);
    CHECK(coarse.transpiration == Approx(dense_transpiration(forked(100), -3000)).epsilon(5e-5));
    // The dense one converges with the second power of its pieces.
    const double e10 = dense_transpiration(forked(10), -3000) - coarse.transpiration;
    const double e20 = dense_transpiration(forked(20), -3000) - coarse.transpiration;
    CHECK(std::log2(e10 / e20) == Approx(2).margin(0.1));
}

TEST_CASE("what roots take changes with the head at the collar as they say", "[environment][roots]") {
    const std::vector<RootPiece> root = forked(6);
    HydraulicTree tree;
    const CollarView view = tree.look(root);
    std::vector<double> by_collar;
    tree.answer_collar(root, by_collar);
    RootFlow wet, dry;
    tree.flow(root, -1000, wet);
    tree.flow(root, -1500, dry);
    double sum = 0;
    for (std::size_t i = 0; i < root.size(); ++i) {
        CHECK(by_collar[i] == Approx((dry.uptake[i] - wet.uptake[i]) / 500).epsilon(1e-9));
        sum += by_collar[i];
    }
    CHECK(sum == Approx(view.conductance).epsilon(1e-12));
}

TEST_CASE("water moves from wet to dry soil through roots that transpire nothing", "[environment][roots]") {
    const std::vector<RootPiece> root = forked(4);
    HydraulicTree tree;
    const CollarView view = tree.look(root);
    RootFlow flow;
    tree.flow(root, view.head, flow);
    CHECK(flow.transpiration == Approx(0).margin(1e-12));
    CHECK(flow.uptake.front() < 0);  // the dry top gets water
    CHECK(flow.uptake.back() > 0);
}

TEST_CASE("a root in hydrostatic soil is at rest", "[environment][roots]") {
    const std::vector<RootPiece> root = one_root(9, -300);
    HydraulicTree tree;
    tree.look(root);
    RootFlow flow;
    tree.flow(root, -300, flow);
    for (const double uptake : flow.uptake) CHECK(std::abs(uptake) < 1e-12);
}

TEST_CASE("very long, very conductive and very tight roots stay finite", "[environment][roots]") {
    for (const double kr : {0.0, 1e-12, 1e3, 1e9}) {
        std::vector<RootPiece> root = one_root(3, -100);
        for (RootPiece& piece : root) piece.radial = kr;
        HydraulicTree tree;
        const CollarView view = tree.look(root);
        CHECK(std::isfinite(view.conductance));
        CHECK(std::isfinite(view.head));
        RootFlow flow;
        tree.flow(root, -5000, flow);
        double sum = 0;
        for (const double uptake : flow.uptake) sum += uptake;
        CHECK(sum == Approx(flow.transpiration).epsilon(1e-6).margin(1e-9));
    }
}

TEST_CASE("a root in a cylinder of loam is stressed after the published time", "[environment][roots]") {
    // Schroeder et al. (2008): r 0.02 cm, cylinder 0.6 cm, 0.1 cm/d, from -100 cm to -15,000 cm at the surface: 9.96 d.
    const SoilHydraulics loam({SoilKind::Model::van_genuchten, 0.08, 0.43, 0.04, 1.6, 50, 0.5});
    const double r = 0.02, outer = 0.6, flux = 0.1;
    const double resistance = r * zone_factor(r, outer);
    double day = 0;
    for (;; day += 0.001) {
        const double content = loam.at(-100).content - day * 2 * r * flux / (outer * outer - r * r);
        const SoilPoint mean = loam.at(loam.head_at(content));
        if (mean.potential - loam.at(-15000).potential < flux * resistance) break;
    }
    CHECK(day == Approx(9.96).epsilon(0.005));
}

TEST_CASE("what enters a root is the same in the soil around it and through its wall", "[environment][roots]") {
    const SoilHydraulics loam({SoilKind::Model::van_genuchten, 0.08, 0.43, 0.04, 1.6, 50, 0.5});
    const double resistance = 0.02 * zone_factor(0.02, 0.5), kr = 2e-4;
    for (const double soil : {-30.0, -900.0, -8000.0}) {
        for (const double xylem : {-100.0, -4000.0, -15000.0}) {
            const SoilPoint voxel = loam.at(soil);
            const RadialFlow flow = radial_flow(loam, voxel, xylem, kr, resistance);
            CHECK(flow.flux == Approx(kr * (flow.surface_head - xylem)).epsilon(1e-9).margin(1e-15));
            CHECK(flow.flux * resistance ==
                  Approx(voxel.potential - loam.at(flow.surface_head).potential).epsilon(1e-6).margin(1e-12));
            const auto at = [&](double change, double by_soil) {
                return radial_flow(loam, loam.at(soil + by_soil), xylem + change, kr, resistance).flux;
            };
            CHECK(flow.by_xylem == Approx((at(0.1, 0) - at(-0.1, 0)) / 0.2).epsilon(1e-3).margin(1e-12));
            CHECK(flow.by_soil == Approx((at(0, 0.01) - at(0, -0.01)) / 0.02).epsilon(1e-3).margin(1e-12));
        }
    }
    // In dry soil the zone holds back what the root alone would take.
    const SoilPoint dry = loam.at(-8000);
    CHECK(radial_flow(loam, dry, -15000, kr, resistance).flux < 0.5 * radial_flow(loam, dry, -15000, kr, 0).flux);
    CHECK(zone_factor(0.1, 0.15) == 0);
}

}  // namespace espalier::test
