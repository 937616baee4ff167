// Pictures by light paths against what light does in simple scenes.
#include "catch.h"
#include "picture/files/traced_picture.h"
#include "picture/light/colour_space.h"
#include "picture/light/path_tracer.h"
#include "picture/light/tone.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <tbb/global_control.h>

#include <numbers>

using namespace espalier;
using namespace espalier::picture;

namespace {

using Rgb = std::array<std::uint8_t, 3>;

/// Triangles that a part refers to.
struct Shape {
    std::vector<glm::vec3> points, normals;
    std::vector<glm::vec2> uvs;
    std::vector<std::int32_t> corners;

    void add_square(const glm::vec3& corner, const glm::vec3& right, const glm::vec3& up) {
        const auto first = static_cast<std::int32_t>(points.size());
        for (const glm::vec2 uv : {glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
            points.push_back(corner + uv.x * right + uv.y * up);
            normals.push_back(glm::normalize(glm::cross(right, up)));
            uvs.push_back(uv);
        }
        for (const int k : {0, 1, 2, 0, 2, 3}) corners.push_back(first + k);
    }

    void add_sphere(int rings) {
        for (int i = 0; i <= rings; ++i) {
            for (int k = 0; k <= 2 * rings; ++k) {
                const float zenith = std::numbers::pi_v<float> * i / rings,
                            turn = std::numbers::pi_v<float> * k / rings;
                normals.emplace_back(std::sin(zenith) * std::cos(turn), std::cos(zenith),
                                     std::sin(zenith) * std::sin(turn));
            }
        }
        points = normals;
        uvs.resize(points.size());
        const int row = 2 * rings + 1;
        for (int i = 0; i < rings; ++i) {
            for (int k = 0; k < 2 * rings; ++k) {
                const int a = i * row + k;
                for (const int corner : {a, a + 1, a + row, a + 1, a + row + 1, a + row}) corners.push_back(corner);
            }
        }
    }

    LitPart part(const Rgb& colour) const {
        return {points, normals, uvs, corners, std::vector<Rgb>(points.size(), colour)};
    }
};

PictureSky sky_of(PictureSky::Kind kind) {
    PictureSky sky;
    sky.kind = kind;
    return sky;
}

/// The mean of what a ray sees.
glm::vec3 mean_seen(const PathTracer& tracer, const glm::vec3& origin, const glm::vec3& direction, int samples,
                    std::uint64_t pixel = 1) {
    glm::vec3 sum(0);
    for (int i = 0; i < samples; ++i) {
        PathNumbers numbers(pixel, static_cast<std::uint32_t>(i));
        sum += tracer.seen(origin, glm::normalize(direction), true, numbers).radiance;
    }
    return sum / static_cast<float>(samples);
}

const glm::vec3 white(1), high_sun(0, 1, 0);
constexpr float pi = std::numbers::pi_v<float>;

}  // namespace

TEST_CASE("furnace: a white sphere under a uniform sky over white ground cannot be told from the sky", "[light]") {
    Shape sphere;
    sphere.add_sphere(24);
    const LitScene scene({sphere.part({255, 255, 255})}, std::nullopt);
    const SkyLight light(sky_of(PictureSky::Kind::uniform), high_sun);
    const PathTracer tracer(scene, light, white);
    for (const glm::vec3 to : {glm::vec3(0, 0, 0), {0.5f, 0.4f, 0}, {-0.7f, -0.6f, 0}, {0, 0.93f, 0}, {3, 3, 0}}) {
        const glm::vec3 seen = mean_seen(tracer, {0, 0, 5}, to - glm::vec3(0, 0, 5), 64);
        CHECK(seen.x == Approx(1).epsilon(1e-4));
        CHECK(seen.z == Approx(1).epsilon(1e-4));
    }
}

TEST_CASE("open ground has the irradiance of its sky: pi of a uniform one, 7/9 of the zenith's pi of an overcast one",
          "[light]") {
    CHECK(SkyLight(sky_of(PictureSky::Kind::uniform), high_sun).on_ground().y == Approx(pi).epsilon(1e-4));
    // 1 + 2 cos: integral of cos (1 + 2 cos) over the hemisphere is pi + 4 pi / 3.
    CHECK(SkyLight(sky_of(PictureSky::Kind::overcast), high_sun).on_ground().y == Approx(7 * pi / 3).epsilon(1e-3));
}

TEST_CASE("level ground sends back its share of sky and sun, from every side alike", "[light]") {
    const glm::vec3 sun = glm::normalize(glm::vec3(0.5f, 0.7f, -0.2f));
    for (const auto kind : {PictureSky::Kind::clear, PictureSky::Kind::overcast}) {
        const SkyLight light(sky_of(kind), sun);
        LitGround ground;
        ground.reflectance = glm::vec3(0.3F, 0.2F, 0.1F);
        ground.is_disc = true;  // without patches
        ground.radius = 1e6;
        const LitScene scene({}, ground);
        const PathTracer tracer(scene, light, white);
        const glm::vec3 expected = light.on_ground() * ground.reflectance / pi;
        for (const glm::vec3 from : {glm::vec3(0, 5, 0.1f), {3, 1, 2}}) {
            const glm::vec3 seen = mean_seen(tracer, from, -from, 1024) / 1.0F;
            CHECK(seen.x == Approx(expected.x).epsilon(0.02));
            CHECK(seen.y == Approx(expected.y).epsilon(0.02));
            CHECK(seen.z == Approx(expected.z).epsilon(0.02));
        }
    }
}

TEST_CASE("a clear day has about 100 klx, most of them by a sun that is redder than the sky", "[light]") {
    const SkyLight light(sky_of(PictureSky::Kind::clear),
                         glm::normalize(glm::vec3(0, std::sqrt(3.0F), 1)));  // 60 degrees
    const float all = luminance_of(light.on_ground()), sky = luminance_of(light.sky_on_ground());
    CHECK(all > 80);
    CHECK(all < 120);
    CHECK(sky / all > 0.1);
    CHECK(sky / all < 0.35);
    CHECK(light.sun().x > light.sun().z);
    CHECK(light.sky_on_ground().x < light.sky_on_ground().z);
    const SkyLight low(sky_of(PictureSky::Kind::clear), glm::normalize(glm::vec3(0, 0.15f, 1)));
    CHECK(low.sun().x / low.sun().z > 1.5 * light.sun().x / light.sun().z);
}

TEST_CASE("the share of the sky is the one that is asked for", "[light]") {
    for (const double diffuse : {0.2, 0.7, 1.0}) {
        PictureSky sky = sky_of(PictureSky::Kind::overcast);
        sky.diffuse = diffuse;
        const SkyLight light(sky, glm::normalize(glm::vec3(1, 1, 0)));
        CHECK(light.sky_on_ground().y / light.on_ground().y == Approx(diffuse).epsilon(1e-3));
        CHECK(light.has_sun() == (diffuse < 1));
    }
}

TEST_CASE("the penumbra of an edge is as wide as the sun's disc is at its distance", "[light]") {
    // A wall's upper edge, 10 m above a black sky's ground, in the light of a sun 45 degrees high.
    PictureSky sky = sky_of(PictureSky::Kind::uniform);
    sky.diffuse = 0.01;
    const SkyLight light(sky, glm::normalize(glm::vec3(1, 1, 0)));
    Shape wall;
    wall.add_square({0, 0, -100}, {0, 0, 200}, {0, 10, 0});
    LitGround ground;
    ground.is_disc = true;
    ground.radius = 1e6;
    ground.reflectance = glm::vec3(0.5F);
    const LitScene scene({wall.part({0, 0, 0})}, ground);
    const PathTracer tracer(scene, light, white);
    const auto lit = [&](float x) {
        const glm::vec3 eye(x - 3, 6, 0.2f);
        return mean_seen(tracer, eye, glm::vec3(x, 0, 0.2f) - eye, 512).y;
    };
    const float dark = lit(-9.5F), bright = lit(-10.5F);
    CHECK(dark < 0.05 * bright);
    // Distance to the edge 10 sqrt(2), the angle 0.5332 degrees, and the ground lies aslant: by another sqrt(2).
    const float width = 20 * glm::radians(0.5332F);
    CHECK(lit(-10 + 0.55F * width) < dark + 0.03F * bright);
    CHECK(lit(-10 - 0.55F * width) > 0.97F * bright);
    CHECK(lit(-10) == Approx((dark + bright) / 2).epsilon(0.06));
    // A quarter of the disc's width hides acos(1/2)/pi - sqrt(3)/(4 pi) of it.
    CHECK(lit(-10 + 0.25F * width) / bright == Approx(0.1955).margin(0.03));
}

TEST_CASE("a leaf against the sun shows the light that it lets through, in its colour", "[light]") {
    const glm::vec3 towards_sun = glm::normalize(glm::vec3(0, 0.5f, -1));
    PictureSky sky = sky_of(PictureSky::Kind::uniform);
    sky.diffuse = 0.01;
    const SkyLight light(sky, towards_sun);
    Shape leaf;
    leaf.add_square({-1, 0, 0}, {2, 0, 0}, {0, 2, 0});
    LitPart part = leaf.part({90, 160, 60});
    const ThinOptics optics = thin_optics(linear_of({90, 160, 60}));
    const float cosine = -towards_sun.z;
    for (const bool is_thin : {true, false}) {
        part.is_thin = is_thin;
        const LitScene scene({part}, std::nullopt);
        const PathTracer tracer(scene, light, glm::vec3(0));
        const glm::vec3 seen = mean_seen(tracer, {0, 1, 5}, {0, 0, -1}, 256);
        const glm::vec3 by_sun = light.sun() * optics.transmittance * (cosine / pi);
        if (is_thin) {
            CHECK(seen.y == Approx(by_sun.y).epsilon(0.05));
            CHECK(seen.x / seen.y == Approx(by_sun.x / by_sun.y).epsilon(0.05));
        } else {
            CHECK(seen.y < 0.05 * by_sun.y);
        }
    }
}

TEST_CASE("no surface that is thin gives back more light than it gets", "[light]") {
    for (const int grey : {0, 40, 128, 200, 255}) {
        const auto [reflectance, transmittance] = thin_optics(linear_of({std::uint8_t(grey), 255, 0}));
        for (int k = 0; k < 3; ++k) CHECK(reflectance[k] + transmittance[k] <= 0.9501F);
    }
}

TEST_CASE("what is half transparent lets half of the sun and half of the sight through", "[light]") {
    PictureSky sky = sky_of(PictureSky::Kind::uniform);
    sky.diffuse = 0.5;
    const SkyLight light(sky, high_sun);
    Shape pane;
    pane.add_square({-1, 1, -1}, {0, 0, 2}, {2, 0, 0});
    LitPart part = pane.part({0, 0, 0});
    part.opacities.assign(part.points.size(), 0.5F);
    const LitScene scene({part}, std::nullopt);
    CHECK(scene.clearness({0, 0, 0}, {0, 1, 0}) == Approx(0.5));
    CHECK(scene.clearness({3, 0, 0}, {0, 1, 0}) == 1);
    const PathTracer tracer(scene, light, white);
    CHECK(mean_seen(tracer, {0, 0.1f, 0}, {0.1f, 1, 0}, 256).y == Approx(0.5).epsilon(0.02));
}

TEST_CASE("textures colour what they lie on, between their pixels and beyond their edges, and cut it out", "[light]") {
    auto texture = std::make_shared<LitTexture>();
    texture->width = 2;
    texture->height = 1;
    texture->pixels = {{255, 0, 0, 255}, {0, 255, 0, 0}};
    CHECK(texture->at({0.25F, 0.5F}, true).x == Approx(1));
    CHECK(texture->at({0.5F, 0.5F}, true).x == Approx(0.5));
    CHECK(texture->at({1.25F, 0.5F}, true).x == Approx(1));
    CHECK(texture->at({-0.25F, 0.5F}, true).y == Approx(1));
    const SkyLight light(sky_of(PictureSky::Kind::uniform), high_sun);
    Shape leaf;
    leaf.add_square({-1, 0, 0}, {2, 0, 0}, {0, 2, 0});
    LitPart part = leaf.part({255, 255, 255});
    part.texture = texture;
    const LitScene scene({part}, std::nullopt);
    const PathTracer tracer(scene, light, white);
    const glm::vec3 red = mean_seen(tracer, {-0.5f, 1, 5}, {0, 0, -1}, 64);
    CHECK(red.x == Approx(1).epsilon(1e-3));
    CHECK(red.y == 0);
    CHECK(mean_seen(tracer, {0.5f, 1, 5}, {0, 0.001f, -1}, 64).y == Approx(1).epsilon(1e-3));  // the sky behind
}

TEST_CASE("the error falls with the number of samples, faster than by chance", "[light]") {
    Shape sphere;
    sphere.add_sphere(16);
    LitGround ground;
    ground.is_disc = true;
    ground.radius = 1e6;
    ground.reflectance = glm::vec3(0.4F);
    const LitScene scene({sphere.part({180, 180, 180})}, ground);
    const SkyLight light(sky_of(PictureSky::Kind::overcast), high_sun);
    const PathTracer tracer(scene, light, white);
    const glm::vec3 eye(0, 3, 5), towards = glm::vec3(0.3f, 0.4f, 0.5f) - eye;
    const float truth = mean_seen(tracer, eye, towards, 1 << 16).y;
    const auto error = [&](int samples) {
        double squares = 0;
        for (std::uint64_t pixel = 0; pixel < 64; ++pixel) {
            squares += std::pow(mean_seen(tracer, eye, towards, samples, 100 + pixel).y - truth, 2) / 64;
        }
        return std::sqrt(squares);
    };
    const double few = error(8), many = error(128);
    CHECK(many < few / 4.2);  // chance: a quarter
    CHECK(many < 0.02 * truth);
}

TEST_CASE("a traced picture has the same bytes with one thread and with several, and less noise where asked for",
          "[light]") {
    Shape sphere;
    sphere.add_sphere(12);
    const LitScene scene({sphere.part({90, 140, 60})}, LitGround{});
    const SkyLight light(sky_of(PictureSky::Kind::clear), glm::normalize(glm::vec3(1, 1, 1)));
    const PathTracer tracer(scene, light, open_ground);
    CameraView view;
    view.position = {0, 1, 8};
    const auto draw = [&](const PictureLight& wanted) {
        std::vector<double> told;
        auto picture =
            traced_picture(tracer, light, view, {40, 30}, wanted, [&](double share) { told.push_back(share); });
        CHECK(told.back() == 1);
        CHECK(std::is_sorted(told.begin(), told.end()));
        return picture.pixels;
    };
    PictureLight wanted;
    wanted.samples = 33;
    const auto several = draw(wanted);
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK((draw(wanted) == several));
    }
    wanted.samples = 1024;
    const auto good = draw(wanted);
    const auto difference = [&](const auto& pixels) {
        double sum = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) sum += std::abs(pixels[i][1] - good[i][1]);
        return sum / static_cast<double>(pixels.size());
    };
    wanted.noise = 0.1;
    const double loose = difference(draw(wanted));
    wanted.noise = 0.004;
    CHECK(difference(draw(wanted)) < 0.6 * loose);
}

TEST_CASE("a picture that is told to end ends in its midst", "[light]") {
    const LitScene scene({}, LitGround{});
    const SkyLight light(sky_of(PictureSky::Kind::overcast), high_sun);
    const PathTracer tracer(scene, light, open_ground);
    PictureLight wanted;
    wanted.samples = 1 << 16;
    int calls = 0;
    struct Enough {};
    CHECK_THROWS_AS(traced_picture(tracer, light, {}, {64, 64}, wanted,
                                   [&](double) {
                                       if (++calls == 3) throw Enough();
                                   }),
                    Enough);
    CHECK(calls == 3);
}

TEST_CASE("tones stay in order, keep colours that are not bright, and end below white", "[light]") {
    CHECK(toned({0.5F, 0.3F, 0.1F}) == glm::vec3(0.5F, 0.3F, 0.1F));
    float before = 0;
    for (float light = 0.1F; light < 100; light *= 1.3F) {
        const float now = toned(glm::vec3(light)).x;
        CHECK(now > before);
        CHECK(now < 1);
        before = now;
    }
    CHECK(screen_bytes({0, 0.2158605F, 1}) == Rgb{0, 128, 255});
}
