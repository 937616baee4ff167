#include "picture/light/lit_scene.h"

#include "espalier/base/random.h"

#include "picture/light/colour_space.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::picture {
namespace {

constexpr float furthest = 1e30F;

/// Values of corners between them.
template <class Value>
Value within(const geometry::RayScene::Hit& hit, const Value& a, const Value& b, const Value& c) {
    return (1 - hit.u - hit.v) * a + hit.u * b + hit.v * c;
}

std::array<std::size_t, 3> corners_of(const LitPart& part, std::size_t triangle) {
    const auto corner = [&](std::size_t k) { return static_cast<std::size_t>(part.corners[3 * triangle + k]); };
    return {corner(0), corner(1), corner(2)};
}

int wrapped(int at, int count) {
    const int rest = at % count;
    return rest < 0 ? rest + count : rest;
}

/// The normal of the relief, in the directions in which the texture runs; `normal` where it does not run.
glm::vec3 bent(const LitPart& part, const std::array<std::size_t, 3>& at, const glm::vec2& uv,
               const glm::vec3& normal) {
    const glm::vec3 ab = part.points[at[1]] - part.points[at[0]], ac = part.points[at[2]] - part.points[at[0]];
    const glm::vec2 tb = part.uvs[at[1]] - part.uvs[at[0]], tc = part.uvs[at[2]] - part.uvs[at[0]];
    const float area = tb.x * tc.y - tb.y * tc.x;
    const glm::vec3 tangent = (ab * tc.y - ac * tb.y) * area, bitangent = (ac * tb.x - ab * tc.x) * area;
    const float longest = std::max(glm::dot(tangent, tangent), glm::dot(bitangent, bitangent));
    if (!(longest > 0)) return normal;
    const glm::vec3 relief = 2.0F * glm::vec3(part.relief->at(uv, false)) - 1.0F;
    const glm::vec3 sum = (tangent * relief.x + bitangent * relief.y) / std::sqrt(longest) + normal * relief.z;
    return glm::length(sum) > 0 ? glm::normalize(sum) : normal;
}

/// Where smooth surfaces would be: flat triangles would shade each other's edges. Hanika 2021, Hacking the shadow
/// terminator.
glm::vec3 smooth_point(const LitPart& part, const std::array<std::size_t, 3>& at, const geometry::RayScene::Hit& hit,
                       const glm::vec3& point, float side) {
    const auto lifted = [&](std::size_t corner) {
        const glm::vec3 normal = side * part.normals[corner];
        const float over = std::min(0.0F, glm::dot(point - part.points[corner], normal));
        return point - over * normal;
    };
    return within(hit, lifted(at[0]), lifted(at[1]), lifted(at[2]));
}

/// A number from -1 to 1 for each corner of a square grid, and smoothly in between.
float value_noise(const glm::vec2& place) {
    const glm::vec2 corner = glm::floor(place), share = glm::smoothstep(0.0F, 1.0F, place - corner);
    const auto value = [&](float right, float up) {
        const auto x = static_cast<std::int64_t>(corner.x + right), y = static_cast<std::int64_t>(corner.y + up);
        const std::uint64_t bits = mix(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y));
        return static_cast<float>(bits >> 40) * 0x1p-23F - 1;
    };
    return glm::mix(glm::mix(value(0, 0), value(1, 0), share.x), glm::mix(value(0, 1), value(1, 1), share.x), share.y);
}

/// Open ground is green and dry in patches of many sizes, the largest as wide as what stands on it.
glm::vec3 patchy(const glm::vec3& colour, const glm::vec2& place) {
    float sum = 0, scale = 2, weight = 0.5F;
    for (int octave = 0; octave < 7; ++octave, scale *= 2.3F, weight *= 0.8F)
        sum += weight * value_noise(scale * place);
    const float dry = 0.22F * sum;
    return colour * glm::clamp(glm::vec3(1 + 1.3F * dry, 1 + 0.8F * dry, 1 + dry), 0.4F, 1.6F);
}

}  // namespace

glm::vec4 LitTexture::at(const glm::vec2& uv, bool is_colour) const {
    const float x = (uv.x - std::floor(uv.x)) * static_cast<float>(width) - 0.5F;
    const float y = (uv.y - std::floor(uv.y)) * static_cast<float>(height) - 0.5F;
    const int left = static_cast<int>(std::floor(x)), low = static_cast<int>(std::floor(y));
    const float right = x - std::floor(x), up = y - std::floor(y);
    const auto pixel = [&](int column, int row) {
        const std::size_t place =
            static_cast<std::size_t>(wrapped(low + row, height)) * static_cast<std::size_t>(width) +
            static_cast<std::size_t>(wrapped(left + column, width));
        const auto& [red, green, blue, opacity] = pixels[place];
        const glm::vec3 colour = is_colour ? linear_of({red, green, blue}) : glm::vec3(red, green, blue) / 255.0F;
        return glm::vec4(colour, static_cast<float>(opacity) / 255);
    };
    return glm::mix(glm::mix(pixel(0, 0), pixel(1, 0), right), glm::mix(pixel(0, 1), pixel(1, 1), right), up);
}

// Leaves let through about as much as they reflect (Goudriaan 1977), and light that goes all the way through the blade
// is deeper and yellower than what turns back near its face.
ThinOptics thin_optics(const glm::vec3& colour) {
    constexpr float most = 0.95F;
    const glm::vec3 deep = glm::pow(glm::clamp(colour, 0.0F, 1.0F), glm::vec3(1.05F, 1, 1.35F));
    ThinOptics optics{colour, 0.9F * deep};
    const glm::vec3 sum = optics.reflectance + optics.transmittance;
    const float greatest = std::max({sum.x, sum.y, sum.z});
    if (greatest > most) {
        optics.reflectance *= most / greatest;
        optics.transmittance *= most / greatest;
    }
    return optics;
}

LitScene::LitScene(std::vector<LitPart> parts, const std::optional<LitGround>& ground)
    : parts_(std::move(parts)), ground_(ground) {
    std::vector<glm::vec3> corners;
    for (const LitPart& part : parts_) {
        first_triangles_.push_back(static_cast<std::uint32_t>(corners.size() / 3));
        for (const std::int32_t corner : part.corners) {
            corners.push_back(part.points[static_cast<std::size_t>(corner)]);
            for (int k = 0; k < 3; ++k) {
                if (std::isfinite(corners.back()[k])) size_ = std::max(size_, std::abs(corners.back()[k]));
            }
        }
        is_opaque_ = is_opaque_ && part.opacities.empty() && !part.texture;
    }
    // One part alone: rays need not look for it first.
    const std::array all{geometry::RayScene::Part{corners, {moved_by(glm::vec3(0))}}};
    rays_.set_parts(all);
}

std::optional<geometry::RayScene::Hit> LitScene::first_hit(const glm::vec3& origin, const glm::vec3& direction,
                                                           float from, float to) const {
    auto hit = rays_.first_hit(origin, direction, from, to);
    if (hit) tell_part(*hit);
    return hit;
}

void LitScene::tell_part(geometry::RayScene::Hit& hit) const {
    const auto behind = std::upper_bound(first_triangles_.begin(), first_triangles_.end(), hit.triangle);
    hit.part = static_cast<std::uint32_t>(behind - first_triangles_.begin() - 1);
    hit.triangle -= first_triangles_[hit.part];
}

float LitScene::gap(const glm::vec3& point) const {
    return 2e-6F * std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z), 0.1F * size_});
}

std::optional<LitSurface> LitScene::on_ground(const glm::vec3& origin, const glm::vec3& direction, float from) const {
    if (!ground_ || origin.y <= 0 || direction.y >= 0) return std::nullopt;
    const float distance = -origin.y / direction.y;
    if (!(distance > from && distance < furthest)) return std::nullopt;
    LitSurface surface{};
    surface.point = origin + distance * direction;
    surface.point.y = 0;
    surface.flat = surface.normal = glm::vec3(0, 1, 0);
    surface.reflectance = ground_->reflectance;
    const glm::vec2 off(surface.point.x - ground_->middle.x, surface.point.z - ground_->middle.z);
    if (!ground_->is_disc)
        surface.reflectance = patchy(ground_->reflectance, off / static_cast<float>(ground_->radius));
    surface.opacity = 1;
    surface.distance = distance;
    surface.is_ground = true;
    return surface;
}

LitSurface LitScene::bare_surface(const geometry::RayScene::Hit& hit, const glm::vec3& direction) const {
    const LitPart& part = parts_[hit.part];
    const auto [a, b, c] = corners_of(part, hit.triangle);
    LitSurface surface{};
    surface.part = hit.part;
    surface.triangle = hit.triangle;
    surface.distance = hit.distance;
    surface.point = within(hit, part.points[a], part.points[b], part.points[c]);
    surface.flat = glm::cross(part.points[b] - part.points[a], part.points[c] - part.points[a]);
    const float area = glm::length(surface.flat);
    surface.flat = area > 0 ? surface.flat / area : -direction;
    surface.normal = within(hit, part.normals[a], part.normals[b], part.normals[c]);
    if (!(glm::length(surface.normal) > 0.1F)) surface.normal = surface.flat;
    if (glm::dot(surface.flat, direction) > 0) surface.flat = -surface.flat;
    surface.side = glm::dot(surface.normal, surface.flat) < 0 ? -1.0F : 1.0F;
    surface.normal = glm::normalize(surface.side * surface.normal);
    surface.opacity =
        part.opacities.empty() ? 1.0F : within(hit, part.opacities[a], part.opacities[b], part.opacities[c]);
    return surface;
}

LitSurface LitScene::surface(const geometry::RayScene::Hit& hit, const glm::vec3& direction) const {
    const LitPart& part = parts_[hit.part];
    const std::array<std::size_t, 3> at = corners_of(part, hit.triangle);
    const auto [a, b, c] = at;
    LitSurface surface = bare_surface(hit, direction);
    if (!part.is_thin) surface.point = smooth_point(part, at, hit, surface.point, surface.side);
    glm::vec3 colour = within(hit, linear_of(part.colours[a]), linear_of(part.colours[b]), linear_of(part.colours[c]));
    if (part.texture || part.relief) {
        const glm::vec2 uv = within(hit, part.uvs[a], part.uvs[b], part.uvs[c]);
        if (part.texture) {
            const glm::vec4 texel = part.texture->at(uv, true);
            colour *= glm::vec3(texel);
            surface.opacity *= texel.w;
        }
        if (part.relief) surface.normal = bent(part, at, uv, surface.normal);
    }
    if (!part.emissions.empty()) {
        surface.emission =
            within(hit, linear_of(part.emissions[a]), linear_of(part.emissions[b]), linear_of(part.emissions[c]));
    }
    surface.reflectance = colour;
    if (part.is_thin) {
        const ThinOptics optics = thin_optics(colour);
        surface.reflectance = optics.reflectance;
        surface.transmittance = optics.transmittance;
    }
    return surface;
}

std::optional<LitSurface> LitScene::met(const glm::vec3& origin, const glm::vec3& direction, float from) const {
    const std::optional<LitSurface> ground = on_ground(origin, direction, from);
    const auto hit = first_hit(origin, direction, from, ground ? ground->distance : furthest);
    return hit ? std::optional(uncoloured(*hit, direction)) : ground;
}

LitScene::FourSurfaces LitScene::met(std::span<const glm::vec3, 4> origins,
                                     std::span<const glm::vec3, 4> directions) const {
    auto hits = rays_.first_hits(origins, directions, furthest);
    FourSurfaces surfaces;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        surfaces[i] = on_ground(origins[i], directions[i], 0);
        if (!hits[i] || (surfaces[i] && surfaces[i]->distance < hits[i]->distance)) continue;
        tell_part(*hits[i]);
        surfaces[i] = uncoloured(*hits[i], directions[i]);
    }
    return surfaces;
}

LitSurface LitScene::uncoloured(const geometry::RayScene::Hit& hit, const glm::vec3& direction) const {
    LitSurface surface = bare_surface(hit, direction);
    const LitPart& part = parts_[hit.part];
    if (part.texture) {
        const auto [a, b, c] = corners_of(part, hit.triangle);
        surface.opacity *= part.texture->at(within(hit, part.uvs[a], part.uvs[b], part.uvs[c]), false).w;
    }
    return surface;
}

std::optional<LitSurface> LitScene::seen(const glm::vec3& origin, const glm::vec3& direction, float from) const {
    const std::optional<LitSurface> ground = on_ground(origin, direction, from);
    const auto hit = first_hit(origin, direction, from, ground ? ground->distance : furthest);
    return hit ? std::optional(surface(*hit, direction)) : ground;
}

float LitScene::clearness(const glm::vec3& origin, const glm::vec3& direction) const {
    float from = gap(origin);
    if (is_opaque_) return rays_.is_blocked(origin, direction, from, furthest) ? 0.0F : 1.0F;
    constexpr int most_layers = 64;
    float clear = 1;
    for (int layer = 0; layer < most_layers && clear > 0; ++layer) {
        const auto hit = first_hit(origin, direction, from, furthest);
        if (!hit) return clear;
        clear *= 1 - surface(*hit, direction).opacity;
        from = hit->distance + gap(origin + hit->distance * direction);
    }
    return 0;
}

}  // namespace espalier::picture
