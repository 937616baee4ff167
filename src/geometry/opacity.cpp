#include "geometry/opacity.h"

#include "espalier/base/error.h"

#include "base/picture_file.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

namespace espalier::geometry {
namespace {

namespace fs = std::filesystem;

std::shared_ptr<const Opacity> read_opacity(const fs::path& file) {
    if (file.extension() != ".png") return nullptr;
    try {
        const Picture picture = read_picture(file);
        const bool has_holes = std::any_of(picture.opacity.begin(), picture.opacity.end(),
                                           [](std::uint8_t opacity) { return opacity < 255; });
        if (!has_holes) return nullptr;
        return std::make_shared<const Opacity>(picture.width, picture.height, picture.opacity);
    } catch (const UserError&) {
        return nullptr;  // drawn without it, too
    }
}

double twice_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Whether the corners are those of a rectangle along the axes.
bool is_upright_box(std::span<const glm::dvec2> corners) {
    if (corners.size() != 4) return false;
    constexpr double rounding = 1e-9;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 side = glm::abs(corners[(i + 1) % 4] - corners[i]);
        const glm::dvec2 next = glm::abs(corners[(i + 2) % 4] - corners[(i + 1) % 4]);
        const bool turns = (side.x <= rounding && next.y <= rounding) || (side.y <= rounding && next.x <= rounding);
        if (!turns) return false;
    }
    return true;
}

}  // namespace

std::shared_ptr<const Opacity> Opacity::of(const fs::path& file) {
    struct Known {
        fs::file_time_type written;
        std::shared_ptr<const Opacity> opacity;
    };
    static std::mutex mutex;
    static std::map<fs::path, Known> known;
    std::error_code missing;
    const fs::file_time_type written = fs::last_write_time(file, missing);
    if (missing) return nullptr;
    const std::lock_guard lock(mutex);
    const auto found = known.find(file);
    if (found != known.end() && found->second.written == written) return found->second.opacity;
    return known.insert_or_assign(file, Known{written, read_opacity(file)}).first->second.opacity;
}

Opacity::Opacity(std::size_t width, std::size_t height, const std::vector<std::uint8_t>& pixels)
    : width_(width), height_(height), sums_((width + 1) * (height + 1), 0.0) {
    for (std::size_t y = 0; y < height; ++y) {
        double row = 0;
        for (std::size_t x = 0; x < width; ++x) {
            row += pixels[y * width + x] / 255.0;
            sums_[(y + 1) * (width + 1) + x + 1] = sums_[y * (width + 1) + x + 1] + row;
        }
    }
}

double Opacity::over(std::span<const glm::dvec2> corners) const {
    glm::dvec2 lower(0), upper(1);
    double area = 0;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        area += std::abs(twice_area(corners[0], corners[i], corners[i + 1]));
    }
    if (!(area > 0) || !std::isfinite(area)) return over_box(lower, upper);
    if (is_upright_box(corners)) {
        lower = upper = corners[0];
        for (const glm::dvec2& corner : corners) lower = glm::min(lower, corner), upper = glm::max(upper, corner);
        return over_box(lower, upper);
    }
    double sum = 0;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const double part = std::abs(twice_area(corners[0], corners[i], corners[i + 1]));
        if (part > 0) sum += part * over_triangle(corners[0], corners[i], corners[i + 1]);
    }
    return sum / area;
}

double Opacity::over_box(const glm::dvec2& lower, const glm::dvec2& upper) const {
    // Of an integral over the repeated picture: whole pictures, and the rest of the last.
    const auto integral = [&](double u, double v) {
        const double columns = std::floor(u), rows = std::floor(v), x = u - columns, y = v - rows;
        return columns * rows * sum_to(1, 1) + columns * sum_to(1, y) + rows * sum_to(x, 1) + sum_to(x, y);
    };
    const double sum = integral(upper.x, upper.y) - integral(lower.x, upper.y) - integral(upper.x, lower.y) +
                       integral(lower.x, lower.y);
    const glm::dvec2 size = upper - lower;
    const double pixels = size.x * size.y * static_cast<double>(width_) * static_cast<double>(height_);
    return std::clamp(sum / pixels, 0.0, 1.0);
}

double Opacity::over_triangle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) const {
    constexpr int rows = 32;  // of similar triangles, whose middles are the places: 32 * 32
    double sum = 0;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; i + j < rows; ++j) {
            const double s = (i + 1 / 3.0) / rows, t = (j + 1 / 3.0) / rows;
            sum += at(a + s * (b - a) + t * (c - a));
            if (i + j + 1 < rows) sum += at(a + (s + 1.0 / (3 * rows)) * (b - a) + (t + 1.0 / (3 * rows)) * (c - a));
        }
    }
    return sum / (rows * rows);
}

double Opacity::sum_to(double u, double v) const {
    const double x = u * static_cast<double>(width_), y = v * static_cast<double>(height_);
    const auto column = std::min(static_cast<std::size_t>(x), width_ - 1);
    const auto row = std::min(static_cast<std::size_t>(y), height_ - 1);
    const double right = x - static_cast<double>(column), up = y - static_cast<double>(row);
    const auto sum = [&](std::size_t i, std::size_t j) { return sums_[j * (width_ + 1) + i]; };
    return (1 - up) * ((1 - right) * sum(column, row) + right * sum(column + 1, row)) +
           up * ((1 - right) * sum(column, row + 1) + right * sum(column + 1, row + 1));
}

double Opacity::at(const glm::dvec2& place) const {
    const auto pixel = [](double part, std::size_t count) {
        return std::min(static_cast<std::size_t>((part - std::floor(part)) * static_cast<double>(count)), count - 1);
    };
    const std::size_t x = pixel(place.x, width_), y = pixel(place.y, height_), next = width_ + 1;
    return sums_[(y + 1) * next + x + 1] - sums_[(y + 1) * next + x] - sums_[y * next + x + 1] + sums_[y * next + x];
}

}  // namespace espalier::geometry
