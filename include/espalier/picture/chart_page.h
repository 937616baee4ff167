// A page of charts: what it shows, and the picture of it.
#pragma once

#include "espalier/base/stations.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace espalier::picture {

/// A line of a chart. `key` is its place in the page's legend: lines of one key look alike in all charts.
struct Series {
    std::size_t key = 0;
    std::vector<double> x, y;           ///< NaN leaves a gap
    std::vector<double> low{}, high{};  ///< a band around the line; empty: none
    bool joined = true;                 ///< or small dots
};

/// A number for every pair of two names, as coloured cells.
struct HeatMap {
    std::vector<std::string> columns, rows;  ///< from the left, from below
    std::vector<double> values;              ///< row after row; NaN leaves a cell empty
    std::string title;                       ///< title of the values
};

struct Chart {
    std::string x_title, y_title;  ///< with their units
    std::vector<Series> series;
    std::vector<std::string> x_names{};  ///< what x = 0, 1, 2, ... are called; empty: x is a number
    std::optional<HeatMap> map{};        ///< instead of series
    bool upright = false;                ///< what is measured lies along x, over heights or depths
};

/// How lines of a key look: one of `colour_count` colours that colour-blind readers tell apart, one of
/// `dash_count` dashes.
struct Key {
    static constexpr int colour_count = 7, dash_count = 4;
    std::string name;
    int colour = 0, dash = 0;
};

struct ChartPage {
    std::string title;
    std::vector<Key> keys;
    std::vector<Chart> charts;
    bool dark = false;
};

struct PictureSize {
    int width = 0, height = 0;
};
/// A size that gives every chart of the page room.
PictureSize fitting_size(const ChartPage& page);

/// The page as .png or .svg, by the path's extension. Complete or not at all. Throws UserError for other extensions,
/// RunError where nothing can be drawn.
void write_picture(const ChartPage& page, const PictureSize& size, const std::filesystem::path& path);

/// Where an axis over [low, high] has its ticks, at most about `count` of them, and the range they span: multiples of
/// 1, 2 or 5 times a power of ten.
struct Ticks {
    std::vector<double> places;
    std::vector<std::string> labels;  ///< "0.5", "20k", "1.5M"
    double low = 0, high = 1;
};
Ticks ticks_over(double low, double high, int count);

}  // namespace espalier::picture
