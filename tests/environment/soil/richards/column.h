// A soil to test with, in double precision behind the process: one column, or a block.
#pragma once

#include "environment/soil/richards/richards.h"

#include <fmt/format.h>

#include <string>

namespace espalier::test {

using namespace espalier::environment;

struct SoilBlock {
    explicit SoilBlock(const std::string& text)
        : settings(Settings::parse_toml(text, "soil.toml")),
          parameters(read_soil_parameters(settings, EnvironmentContext{})),
          grid(parameters.space.grid()),
          layout(grid, parameters, std::vector<std::uint8_t>(grid.voxels(), 1), fields),
          soil(layout, parameters) {
        settings.reject_unread();
    }

    void advance(double days) { soil.advance(days, {}); }
    int height() const { return grid.size().y; }
    double head(int y, int x = 0, int z = 0) const { return soil.heads()[grid.cell({x, y, z})]; }
    double content(int y, int x = 0, int z = 0) const { return soil.contents()[grid.cell({x, y, z})]; }
    /// Centimetres below the surface.
    double depth(int y) const { return layout.edge() * (height() - 0.5 - y); }
    const SoilRates& flown() const { return soil.balance().flown; }

    /// The head of a column at a depth, between the centres of its voxels.
    double head_at_depth(double cm) const {
        const double at = height() - 0.5 - cm / layout.edge();
        const int y = std::min(static_cast<int>(at), height() - 2);
        return head(y) + (at - y) * (head(y + 1) - head(y));
    }
    /// The depth, cm, where the content of a column falls below this for the first time.
    double front(double of_content) const {
        for (int y = height() - 1; y > 0; --y) {
            if (content(y - 1) >= of_content) continue;
            return depth(y) + layout.edge() * (content(y) - of_content) / (content(y) - content(y - 1));
        }
        return layout.edge() * height();
    }

    Settings settings;
    SoilParameters parameters;
    Fields fields;
    WaterGrid grid;
    SoilLayout layout;
    Richards soil;
};

/// A column `depth` m deep of voxels of `voxel` m; the rest of the table as text.
inline std::string column_of(double depth, double voxel, const std::string& rest) {
    return fmt::format("domain = {{ lower = [0, {}, 0], upper = [{}, 0, 0] }}\nvoxel = {}\n", -depth, voxel, voxel) +
           rest;
}

/// The soils of Vanderborght et al. (2005).
inline const std::string test_sand = "{ theta_r = 0.045, theta_s = 0.43, alpha = 0.15, n = 3, ks = 1000 }";
inline const std::string test_loam = "{ theta_r = 0.08, theta_s = 0.43, alpha = 0.04, n = 1.6, ks = 50 }";
inline const std::string test_clay = "{ theta_r = 0.1, theta_s = 0.4, alpha = 0.01, n = 1.1, ks = 10 }";

}  // namespace espalier::test
