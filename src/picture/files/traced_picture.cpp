#include "picture/files/traced_picture.h"

#include "picture/light/colour_space.h"
#include "picture/light/tone.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::picture {
namespace {

constexpr int samples_of_pass = 16;     // so many of a pixel, then of the next
constexpr std::size_t band = 1U << 14;  // samples between two calls of the progress: a tenth of a second or less

/// What the samples of a pixel add up to.
struct PixelSum {
    glm::vec3 radiance{0};
    float opacity = 0, square = 0;  ///< square: of shown luminances
    float shown = 0;
    std::int32_t samples = 0;
    bool is_done = false;
};

/// From an even number to one with the density of a tent from -1 to 1.
double tent(double u) {
    return u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
}

class Tracing {
public:
    Tracing(const PathTracer& tracer, const RayCamera& camera, const PictureSize& size, const PictureLight& wanted,
            float exposure)
        : tracer_(tracer),
          camera_(camera),
          wanted_(wanted),
          exposure_(exposure),
          width_(static_cast<std::size_t>(size.width)),
          sums_(width_ * static_cast<std::size_t>(size.height)) {}

    void trace(const TraceProgress& progress) {
        const int passes = (wanted_.samples + samples_of_pass - 1) / samples_of_pass;
        const std::size_t pixels_of_band = std::max<std::size_t>(1, band / samples_of_pass);
        std::size_t left = sums_.size();
        for (int pass = 0; pass < passes && left > 0; ++pass) {
            const int from = pass * samples_of_pass, to = std::min(wanted_.samples, from + samples_of_pass);
            for (std::size_t first = 0; first < sums_.size(); first += pixels_of_band) {
                const std::size_t last = std::min(sums_.size(), first + pixels_of_band);
                tbb::parallel_for(first, last, [&](std::size_t i) { add_samples(i, from, to); });
                const double of_pass = static_cast<double>(last) / static_cast<double>(sums_.size());
                if (progress) progress((pass + of_pass) / passes);
            }
            left = static_cast<std::size_t>(
                std::count_if(sums_.begin(), sums_.end(), [](const PixelSum& sum) { return !sum.is_done; }));
        }
        if (progress) progress(1);
    }

    OpacityPicture picture() const {
        OpacityPicture made{width_, sums_.size() / width_, {}};
        for (const PixelSum& sum : sums_) {
            const glm::vec3 colour = sum.opacity > 0 ? exposure_ * sum.radiance / sum.opacity : glm::vec3(0);
            const auto [red, green, blue] = screen_bytes(toned(colour));
            const float opacity = sum.opacity / static_cast<float>(std::max(1, sum.samples));
            made.pixels.push_back({red, green, blue, static_cast<std::uint8_t>(std::lround(255 * opacity))});
        }
        return made;
    }

private:
    void add_samples(std::size_t pixel, int from, int to) {
        PixelSum& sum = sums_[pixel];
        if (sum.is_done) return;
        for (int sample = from; sample < to; ++sample) add_sample(pixel, static_cast<std::uint32_t>(sample), sum);
        if (!(wanted_.noise > 0) || sum.samples < 2 * samples_of_pass) return;
        const auto count = static_cast<float>(sum.samples);
        const float mean = sum.shown / count, variance = std::max(0.0F, sum.square / count - mean * mean);
        sum.is_done = std::sqrt(variance / (count - 1)) < wanted_.noise;
    }

    void add_sample(std::size_t pixel, std::uint32_t sample, PixelSum& sum) const {
        PathNumbers numbers(pixel, sample);
        const auto [u, v, spare, unused] = numbers.next();
        const glm::dvec2 place(static_cast<double>(pixel % width_) + 0.5 + tent(u),
                               static_cast<double>(pixel / width_) + 0.5 + tent(v));
        const auto [origin, direction] = camera_.through(place);
        const PathTracer::Seen seen = tracer_.seen(origin, direction, wanted_.shows_sky, numbers);
        sum.radiance += seen.opacity * seen.radiance;
        sum.opacity += seen.opacity;
        const float shown = seen.opacity * screen_of_linear(luminance_of(toned(exposure_ * seen.radiance)));
        sum.shown += shown;
        sum.square += shown * shown;
        ++sum.samples;
    }

    const PathTracer& tracer_;
    const RayCamera& camera_;
    const PictureLight& wanted_;
    float exposure_;
    std::size_t width_;
    std::vector<PixelSum> sums_;
};

}  // namespace

RayCamera::RayCamera(const CameraView& view, const PictureSize& size)
    : view_(view), ahead_(glm::normalize(view.focus - view.position)), width_(size.width), height_(size.height) {
    right_ = glm::normalize(glm::cross(ahead_, view.up));
    view_.up = glm::cross(right_, ahead_);
    half_height_ = view.is_parallel ? view.half_height : std::tan(glm::radians(view.view_angle / 2));
}

RayCamera::Ray RayCamera::through(const glm::dvec2& place) const {
    const double x = 2 * place.x / width_ - 1 - view_.shift.x, y = 1 - 2 * place.y / height_ - view_.shift.y;
    const glm::dvec3 off = half_height_ * (x * width_ / height_ * right_ + y * view_.up);
    if (view_.is_parallel) return {glm::vec3(view_.position + off), glm::vec3(ahead_)};
    return {glm::vec3(view_.position), glm::vec3(glm::normalize(ahead_ + off))};
}

float exposed_for(const SkyLight& light) {
    constexpr float reflectance = 0.6F;
    return reflectance * luminance_of(light.on_ground()) * std::numbers::inv_pi_v<float>;
}

OpacityPicture traced_picture(const PathTracer& tracer, const SkyLight& light, const CameraView& view,
                              const PictureSize& size, const PictureLight& wanted, const TraceProgress& progress) {
    const auto stops = static_cast<float>(std::exp2(wanted.stops));
    const RayCamera camera(view, size);
    Tracing tracing(tracer, camera, size, wanted, stops / exposed_for(light));
    tracing.trace(progress);
    return tracing.picture();
}

}  // namespace espalier::picture
