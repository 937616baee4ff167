// A plain reference: one column of equal cells, Celia's modified Picard iteration, arithmetic means of the
// conductivity, van Genuchten's formulae as printed, equal time steps. It shares no line with what it tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

namespace espalier::test {

struct ReferenceSoil {
    double residual, saturated, alpha, n, ks;

    double saturation(double h) const { return h >= 0 ? 1 : std::pow(1 + std::pow(-alpha * h, n), 1 / n - 1); }
    double content(double h) const { return residual + (saturated - residual) * saturation(h); }
    double conductivity(double h) const {
        const double s = saturation(h), m = 1 - 1 / n;
        const double part = 1 - std::pow(1 - std::pow(s, 1 / m), m);
        return ks * std::sqrt(s) * part * part;
    }
    double capacity(double h) const {
        if (h >= 0) return 0;
        const double m = 1 - 1 / n, x = std::pow(-alpha * h, n);
        return (saturated - residual) * m * n * alpha * std::pow(-alpha * h, n - 1) * std::pow(1 + x, -m - 1);
    }
};

/// Cells from the top downwards, centimetres and days.
class ReferenceColumn {
public:
    ReferenceColumn(ReferenceSoil soil, double depth, int cells, double head)
        : soil_(soil), cell_(depth / cells), h(cells, head) {}

    std::optional<double> top_head, bottom_head;  ///< at the faces; none: the flux below, or none at the bottom
    double potential_flux = 0;                    ///< downwards through the top; upwards no more than at -10,000 cm
    bool free_drainage = false;
    double passed = 0;  ///< downwards through the top since the beginning, cm
    double flux = 0;    ///< of the last step

    void advance(double days, int steps) {
        for (int step = 0; step < steps; ++step) advance_once(days / steps);
    }

private:
    double through_top(const std::vector<double>& k) const {
        const auto from = [&](double face) {
            return 0.5 * (soil_.conductivity(face) + k[0]) * ((face - h[0]) / (cell_ / 2) + 1);
        };
        if (top_head) return from(*top_head);
        return potential_flux >= 0 ? potential_flux : std::max(potential_flux, std::min(from(-10000), 0.0));
    }

    void advance_once(double dt) {
        const std::size_t n = h.size();
        std::vector<double> before(n), k(n), a(n), b(n), c(n), r(n);
        for (std::size_t i = 0; i < n; ++i) before[i] = soil_.content(h[i]);
        for (int iteration = 0; iteration < 60; ++iteration) {
            for (std::size_t i = 0; i < n; ++i) k[i] = soil_.conductivity(h[i]);
            const double top = through_top(k);
            const bool held = top_head || (potential_flux < 0 && top > potential_flux);
            for (std::size_t i = 0; i < n; ++i) {
                const double up = i > 0 ? 0.5 * (k[i] + k[i - 1]) : 0, down = i + 1 < n ? 0.5 * (k[i] + k[i + 1]) : 0;
                double out = i > 0 ? -up * ((h[i - 1] - h[i]) / cell_ + 1) : -top;
                b[i] = (up + down) / cell_ + cell_ * soil_.capacity(h[i]) / dt;
                if (i == 0 && held) b[i] += 0.5 * (k[0] + soil_.conductivity(top_head.value_or(-10000))) / (cell_ / 2);
                if (i + 1 < n) {
                    out += down * ((h[i] - h[i + 1]) / cell_ + 1);
                } else if (bottom_head) {
                    const double face = 0.5 * (k[i] + soil_.conductivity(*bottom_head));
                    out += face * ((h[i] - *bottom_head) / (cell_ / 2) + 1);
                    b[i] += face / (cell_ / 2);
                } else if (free_drainage) {
                    out += k[i];
                }
                a[i] = -up / cell_;
                c[i] = -down / cell_;
                r[i] = -(out + cell_ * (soil_.content(h[i]) - before[i]) / dt);
            }
            for (std::size_t i = 1; i < n; ++i) {
                const double f = a[i] / b[i - 1];
                b[i] -= f * c[i - 1];
                r[i] -= f * r[i - 1];
            }
            double largest = 0;
            for (std::size_t i = n; i-- > 0;) {
                r[i] = (r[i] - (i + 1 < n ? c[i] * r[i + 1] : 0)) / b[i];
                h[i] += r[i];
                largest = std::max(largest, std::abs(r[i]) / (1 + std::abs(h[i])));
            }
            flux = top;
            if (largest < 1e-7) break;
        }
        passed += flux * dt;
    }

    ReferenceSoil soil_;
    double cell_;

public:
    std::vector<double> h;
};

}  // namespace espalier::test
