#include "formats/twig_texture.h"

#include "espalier/base/error.h"
#include "espalier/base/random.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace espalier::formats {
namespace {

constexpr std::uint64_t twig_salt = 0x74776967;
constexpr double leaf_slenderness = 0.42;                   ///< width by length of a leaf
constexpr double twig_length = 0.68, twig_width = 0.014;    ///< by the side of the picture
constexpr std::array<double, 3> twig_tint{0.8, 0.56, 0.5};  ///< bark by the colour of leaves
constexpr double twig_margin = 0.01;

/// Half the width of a blade at a share of its length, by its greatest half width: round at the base, pointed ahead.
double blade_outline(double along) {
    return along <= 0 || along >= 1 ? 0 : std::sin(std::numbers::pi * std::pow(along, 0.72)) * (1 - 0.2 * along) / 0.88;
}

double area_by_square_of_length() {
    constexpr int parts = 1000;
    double sum = 0;
    for (int i = 0; i < parts; ++i) sum += blade_outline((i + 0.5) / parts) / parts;
    return leaf_slenderness * sum;
}

/// A leaf or a piece of the twig: it stands at `foot` along a unit vector. Sides of the picture, v upwards.
struct Blade {
    glm::dvec2 foot, along;
    double length, brightness;
};

class TwigPainter {
public:
    explicit TwigPainter(const LeafTexture& texture)
        : texture_(texture), samples_(RandomKey(texture.seed, 0, Stream::placement, twig_salt), 0, 0) {
        const auto [red, green, blue] = texture.rgb;
        result_.picture = {texture.size, texture.size, {}};
        result_.picture.pixels.assign(texture.size * texture.size, {red, green, blue, 0});
        length_ = std::sqrt(texture.coverage / static_cast<double>(texture.blobs) / area_by_square_of_length());
        if (length_ * static_cast<double>(texture.size) < 8) {
            throw UserError(fmt::format(
                "{} leaves are too many for {} x {} pixels: some would be shorter than 8 pixels; a larger --size, a "
                "larger --coverage or fewer --blobs leave room",
                texture.blobs, texture.size, texture.size));
        }
    }

    LeafPicture paint() {
        paint_twig();
        for (std::size_t i = 0; i + 1 < texture_.blobs; ++i) paint_leaf(blade(i));
        const glm::dvec2 ahead = glm::normalize(glm::dvec2(between(-0.15, 0.15), 1));
        paint_leaf({on_twig(1), ahead, std::min(length_, 1 - twig_margin - twig_length), brightness()});
        return std::move(result_);
    }

private:
    double between(double low, double high) { return low + (high - low) * samples_.uniform(); }
    double brightness() { return 1 + texture_.variation * between(-1, 1); }

    /// The twig bends a little to one side and back.
    static glm::dvec2 on_twig(double share) {
        return {0.5 + 0.025 * std::sin(2 * std::numbers::pi * share), twig_length * share};
    }

    /// The leaves of the two sides in turn: those ahead stand steeper and are shorter.
    Blade blade(std::size_t number) {
        const double share = 0.12 + 0.84 * (static_cast<double>(number) + 0.5) / static_cast<double>(texture_.blobs);
        const double side = number % 2 == 0 ? -1 : 1;
        const double angle = (66 - 28 * share + between(-8, 8)) * std::numbers::pi / 180;
        const glm::dvec2 foot = on_twig(share), along(side * std::sin(angle), std::cos(angle));
        const double length = length_ * (1.1 - 0.25 * share) * between(0.85, 1.1);
        const double room = (0.5 - twig_margin - std::abs(foot.x - 0.5)) / std::abs(along.x);
        return {foot, along, std::min({length, room, (1 - twig_margin - foot.y) / along.y}), brightness()};
    }

    void paint_twig() {
        constexpr int pieces = 40;
        for (int i = 0; i < pieces; ++i) {
            const glm::dvec2 from = on_twig(double(i) / pieces), to = on_twig((i + 1.0) / pieces);
            paint_line(from, to, twig_width * (1 - 0.6 * i / pieces));
        }
    }

    /// Calls visit(x, y, place) for the pixels of a box about two places, widened.
    template <class Visit>
    void each_pixel(const glm::dvec2& a, const glm::dvec2& b, double wider, const Visit& visit) const {
        const auto size = static_cast<double>(texture_.size);
        const auto bound = [&](double value) {
            return static_cast<std::size_t>(std::clamp(value * size, 0.0, size - 1));
        };
        for (std::size_t y = bound(std::min(a.y, b.y) - wider); y <= bound(std::max(a.y, b.y) + wider); ++y) {
            for (std::size_t x = bound(std::min(a.x, b.x) - wider); x <= bound(std::max(a.x, b.x) + wider); ++x) {
                visit(x, texture_.size - 1 - y, (glm::dvec2(double(x), double(y)) + 0.5) / size);
            }
        }
    }

    void paint_line(const glm::dvec2& from, const glm::dvec2& to, double width) {
        const glm::dvec2 along = to - from;
        each_pixel(from, to, width, [&](std::size_t x, std::size_t y, const glm::dvec2& place) {
            const double share = std::clamp(glm::dot(place - from, along) / glm::dot(along, along), 0.0, 1.0);
            const double off = glm::distance(place, from + share * along);
            put(x, y, twig_tint, 1, width / 2 - off);
        });
    }

    void paint_leaf(const Blade& leaf) {
        const glm::dvec2 across(-leaf.along.y, leaf.along.x);
        const double half = leaf_slenderness / 2 * leaf.length;
        each_pixel(leaf.foot, leaf.foot + leaf.length * leaf.along, half,
                   [&](std::size_t x, std::size_t y, const glm::dvec2& place) {
                       const double t = glm::dot(place - leaf.foot, leaf.along) / leaf.length;
                       const double s = glm::dot(place - leaf.foot, across);
                       if (t < 0 || t > 1) return;
                       const double inside = half * blade_outline(t) - std::abs(s);
                       put(x, y, {1, 1, 1}, leaf.brightness * shade(t, s / half, leaf.length), inside);
                   });
    }

    /// A pale midrib, side veins that go ahead, one half in the other's shadow, darker towards the rim.
    double shade(double t, double s, double length) const {
        const double pixel = 1 / (length * static_cast<double>(texture_.size));
        if (std::abs(s) * leaf_slenderness / 2 < std::max(0.012 * (1 - 0.6 * t), 0.6 * pixel)) return 1.16;
        const double vein = std::abs(std::remainder(8 * (t - 0.32 * std::abs(s)), 1));
        return (s > 0 ? 0.94 : 1.04) * (1 - 0.1 * std::abs(s)) * (vein < 0.09 ? 0.9 : 1);
    }

    /// Over what is there; `inside` is the distance to the rim, half a pixel of which is soft.
    void put(std::size_t x, std::size_t y, const std::array<double, 3>& tint, double brightness, double inside) {
        const double cover = std::clamp(inside * static_cast<double>(texture_.size) + 0.5, 0.0, 1.0);
        if (cover == 0) return;
        OpacityPicture::Pixel& pixel = result_.picture.at(x, y);
        const double below = pixel[3] / 255.0, opacity = cover + below * (1 - cover);
        for (std::size_t k = 0; k < 3; ++k) {
            const double colour = std::min(tint[k] * brightness * texture_.rgb[k], 255.0);
            pixel[k] =
                static_cast<std::uint8_t>(std::lround((cover * colour + below * (1 - cover) * pixel[k]) / opacity));
        }
        pixel[3] = static_cast<std::uint8_t>(std::lround(255 * opacity));
    }

    const LeafTexture& texture_;
    RandomSamples samples_;
    LeafPicture result_;
    double length_;
};

}  // namespace

LeafPicture twig_picture(const LeafTexture& texture) {
    return TwigPainter(texture).paint();
}

}  // namespace espalier::formats
