#include "formats/leaf_texture.h"

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

/// Throws UserError if leaves would be shorter than eight pixels.
LeafPicture twig_picture(const LeafTexture& texture) {
    return TwigPainter(texture).paint();
}

constexpr std::uint64_t salt = 0x6c656166;
constexpr double slenderness = 0.5;     ///< width by length of a blob
constexpr double shortest_share = 0.7;  ///< share of the longest blob's length
constexpr int places_tried = 1000;

struct Blob {
    glm::dvec2 centre, along;
    double length, width;  ///< halves of the axes

    /// 1 on the outline of the blob, widened by so many pixels; less inside.
    double distance(const glm::dvec2& place, double wider = 0) const {
        const glm::dvec2 off = place - centre;
        return std::hypot(glm::dot(off, along) / (length + wider),
                          glm::dot(off, glm::dvec2(-along.y, along.x)) / (width + wider));
    }
};

class Painter {
public:
    explicit Painter(const LeafTexture& texture)
        : texture_(texture), samples_(RandomKey(texture.seed, 0, Stream::placement, salt), 0, 0) {
        const auto [red, green, blue] = texture.rgb;
        result_.picture = {texture.size, texture.size, {}};
        result_.picture.pixels.assign(texture.size * texture.size, {red, green, blue, 0});
        const double area = texture.coverage * double(texture.size * texture.size) / double(texture.blobs);
        // The mean square of a length that is uniform between its bounds.
        const double mean_square = (1 + shortest_share + shortest_share * shortest_share) / 3;
        longest_ = std::sqrt(area / (std::numbers::pi * slenderness * mean_square));
        longest_ = std::min(longest_, double(texture.size) / 2 - 2);
        if (slenderness * shortest_share * longest_ < 1) {
            throw UserError(
                fmt::format("{} blobs are too many for {} x {} pixels: some would be narrower than 2 pixels; "
                            "a larger --size, a larger --coverage or fewer --blobs leave room",
                            texture.blobs, texture.size, texture.size));
        }
    }

    LeafPicture paint() {
        for (std::size_t i = 0; i < texture_.blobs; ++i) add_blob();
        return std::move(result_);
    }

private:
    double between(double low, double high) { return low + (high - low) * samples_.uniform(); }

    void add_blob() {
        const double length = longest_ * between(shortest_share, 1), angle = between(0, 2 * std::numbers::pi);
        Blob best{{}, {std::cos(angle), std::sin(angle)}, length, slenderness * length};
        std::size_t least = texture_.size * texture_.size + 1;
        for (int i = 0; i < places_tried && least > 0; ++i) {
            Blob blob = best;
            const double margin = length + 1, far = double(texture_.size) - margin;
            blob.centre = {between(margin, far), between(margin, far)};
            const std::size_t covered = covered_pixels(blob, least);
            if (covered >= least) continue;
            least = covered;
            best = blob;
        }
        if (least > 0) ++result_.overlapping;
        draw(best, 1 + texture_.variation * between(-1, 1));
    }

    /// Calls `visit` with the pixels that a blob may touch while it returns true.
    template <class Visit>
    void each_pixel(const Blob& blob, const Visit& visit) const {
        const double reach = blob.length + 2, last = double(texture_.size - 1);
        const auto bound = [&](double value) { return static_cast<std::size_t>(std::clamp(value, 0.0, last)); };
        for (std::size_t y = bound(blob.centre.y - reach); y <= bound(blob.centre.y + reach); ++y) {
            for (std::size_t x = bound(blob.centre.x - reach); x <= bound(blob.centre.x + reach); ++x) {
                if (!visit(x, y, glm::dvec2(double(x) + 0.5, double(y) + 0.5))) return;
            }
        }
    }

    /// Returns how many pixels of a blob, two around it included, others cover already; counts no more than `enough`.
    std::size_t covered_pixels(const Blob& blob, std::size_t enough) const {
        std::size_t covered = 0;
        each_pixel(blob, [&](std::size_t x, std::size_t y, const glm::dvec2& place) {
            covered += result_.picture.at(x, y)[3] > 0 && blob.distance(place, 2) <= 1;
            return covered < enough;
        });
        return covered;
    }

    // Brighter along the middle, as a leaf with a vein.
    void draw(const Blob& blob, double brightness) {
        each_pixel(blob, [&](std::size_t x, std::size_t y, const glm::dvec2& place) {
            if (blob.distance(place) > 1) return true;
            const double across = std::abs(glm::dot(place - blob.centre, glm::dvec2(-blob.along.y, blob.along.x)));
            const double here = brightness * (1.08 - 0.16 * across / blob.width);
            for (std::size_t k = 0; k < 3; ++k) {
                result_.picture.at(x, y)[k] = static_cast<std::uint8_t>(std::clamp(texture_.rgb[k] * here, 0.0, 255.0));
            }
            result_.picture.at(x, y)[3] = 255;
            return true;
        });
    }

    const LeafTexture& texture_;
    RandomSamples samples_;
    LeafPicture result_;
    double longest_;
};

}  // namespace

LeafPicture leaf_picture(const LeafTexture& texture) {
    return texture.form == LeafTexture::Form::twig ? twig_picture(texture) : Painter(texture).paint();
}

}  // namespace espalier::formats
