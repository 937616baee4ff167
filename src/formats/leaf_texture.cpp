#include "formats/leaf_texture.h"

#include "espalier/base/error.h"
#include "espalier/base/random.h"

#include "formats/twig_texture.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::formats {
namespace {

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
