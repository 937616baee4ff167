#include "environment/space/neighbours/ground_grid.h"

#include "environment/space/neighbours/reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>

namespace espalier::environment {
namespace {

constexpr double most_cells = 1 << 28;
constexpr std::uint32_t most_discs = 255;  // where discs cover what they touch
// In parts of a cell's width: a disc that reaches into a cell by no more does not touch it. Measured: 0.022 is too
// little.
constexpr double least_touch = 0.03;

}  // namespace

GroundGrid::GroundGrid(ParameterFile& file, const EnvironmentContext& context, Rule rule) : rule_(rule) {
    const std::vector<double> size = file.numbers("grid size", {512, 512}, Range::between(1, 1e9));
    const std::vector<double> range = file.numbers("grid range", {1, 1}, Range::positive());
    const std::vector<double> lower = file.numbers("grid position", {0, 0}, Range::between(-1e100, 1e100));
    for (int axis = 0; axis < 2; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        size_[i] = static_cast<std::int64_t>(size[i]);
        lower_[axis] = lower[i];
        range_[axis] = range[i];
    }
    const double cells = std::floor(size[0]) * std::floor(size[1]);
    if (cells > most_cells || cells * sizeof(std::uint32_t) > static_cast<double>(context.memory)) {
        throw UserError(file.place("grid size"),
                        fmt::format("a grid of {} x {} cells needs {:.3g} GiB of memory; take fewer cells", size_[0],
                                    size_[1], cells * sizeof(std::uint32_t) / 1073741824.0));
    }
    counts_.assign(static_cast<std::size_t>(cells), 0);
    if (const auto path = file.file("input image")) image_ = read_picture(*path);
}

std::optional<std::size_t> GroundGrid::cell(const glm::dvec2& place) const {
    const glm::dvec2 part = (place - lower_) / range_;
    if (!(part.x >= 0 && part.x < 1 && part.y >= 0 && part.y < 1)) return std::nullopt;
    const auto index = [&](int axis) {
        const auto i = static_cast<std::int64_t>(part[axis] * static_cast<double>(size_[axis]));
        return std::min(i, size_[axis] - 1);
    };
    return static_cast<std::size_t>(index(1) * size_[0] + index(0));
}

// Returns the distance of a place from what must be inside a disc: the centre of the cell, or any point of it but its
// rim.
double GroundGrid::distance(int axis, std::int64_t index, double place) const {
    const double edge = range_[axis] / static_cast<double>(size_[axis]);
    const double centre = lower_[axis] + edge * (static_cast<double>(index) + 0.5);
    const double away = std::abs(centre - place);
    return rule_ == Rule::centres ? away : std::max(away - edge * (0.5 - least_touch), 0.0);
}

template <class Change>
void GroundGrid::visit_disc(const glm::dvec2& centre, double radius, const Change& change) {
    if (!(radius > 0)) return;
    std::int64_t begin[2], end[2];
    for (int axis = 0; axis < 2; ++axis) {
        const auto cells = static_cast<double>(size_[axis]);
        const double scale = cells / range_[axis];
        const double from = (centre[axis] - radius - lower_[axis]) * scale - 1;
        const double to = (centre[axis] + radius - lower_[axis]) * scale;
        begin[axis] = static_cast<std::int64_t>(std::clamp(std::floor(from), 0.0, cells));
        end[axis] = static_cast<std::int64_t>(std::clamp(std::ceil(to) + 1, 0.0, cells));
    }
    for (std::int64_t j = begin[1]; j < end[1]; ++j) {
        const double aside = distance(1, j, centre.y);
        for (std::int64_t i = begin[0]; i < end[0]; ++i) {
            const double along = distance(0, i, centre.x);
            if (along * along + aside * aside <= radius * radius) {
                change(counts_[static_cast<std::size_t>(j * size_[0] + i)]);
            }
        }
    }
}

void GroundGrid::add_disc(const glm::dvec2& centre, double radius) {
    const std::uint32_t most = rule_ == Rule::touched ? most_discs : std::uint32_t(-1);
    visit_disc(centre, radius, [most](std::uint32_t& count) { count += count < most; });
}

void GroundGrid::remove_disc(const glm::dvec2& centre, double radius) {
    visit_disc(centre, radius, [](std::uint32_t& count) { count -= count > 0; });
}

glm::dvec2 GroundGrid::reach(double radius) const {
    return beyond_rounding *
           (radius + range_ / glm::dvec2(static_cast<double>(size_[0]), static_cast<double>(size_[1])));
}

Picture::Colour GroundGrid::colour(std::size_t cell) const {
    if (image_.empty()) return {255, 255, 255};
    const auto width = static_cast<std::size_t>(size_[0]), height = static_cast<std::size_t>(size_[1]);
    if (rule_ == Rule::touched) {
        const auto stretched = [](std::size_t index, std::size_t cells, std::size_t pixels) {
            return cells > 1 ? index * (pixels - 1) / (cells - 1) : 0;
        };
        return image_.pixels[stretched(cell / width, height, image_.height) * image_.width +
                             stretched(cell % width, width, image_.width)];
    }
    return image_.at((static_cast<double>(cell % width) + 0.5) / static_cast<double>(size_[0]),
                     (static_cast<double>(cell / width) + 0.5) / static_cast<double>(size_[1]));
}

void GroundGrid::save(std::ostream& out) const {
    out.write(reinterpret_cast<const char*>(counts_.data()),
              static_cast<std::streamsize>(counts_.size() * sizeof(std::uint32_t)));
}

void GroundGrid::restore(std::istream& in) {
    in.read(reinterpret_cast<char*>(counts_.data()),
            static_cast<std::streamsize>(counts_.size() * sizeof(std::uint32_t)));
    if (!in) throw UserError("the checkpoint is of another ground grid");
}

}  // namespace espalier::environment
