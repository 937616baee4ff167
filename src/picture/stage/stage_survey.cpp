#include "picture/stage/stage_survey.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace espalier::picture {
namespace {

void widen(std::array<double, 2>& range, const std::array<double, 2>& by) {
    range = {std::min(range[0], by[0]), std::max(range[1], by[1])};
}

void add_plants(const FrameGeometry& geometry, const std::optional<std::uint32_t>& plant, StageSurvey& survey) {
    survey.has_faces = survey.has_faces || geometry.polygons.size() > 0;
    StageSurvey::Stance* stance = nullptr;  // points of a plant follow each other
    std::uint32_t standing = 0;
    for (std::size_t i = 0; i < geometry.points.size(); ++i) {
        const Kind kind = geometry.of_points.kinds[i];
        if (plant && geometry.of_points.plants[i] != *plant) continue;
        survey.has_labels = survey.has_labels || kind == Kind::label;
        if (kind == Kind::query || kind == Kind::label) continue;
        const glm::dvec3 point(geometry.points[i]);
        if (!std::isfinite(point.x + point.y + point.z)) continue;
        survey.box.add(point);
        if (!stance || standing != geometry.of_points.plants[i]) {
            standing = geometry.of_points.plants[i];
            const auto [found, is_new] = survey.stances.try_emplace(standing);
            stance = &found->second;
            if (is_new) stance->origin = point;
        }
        stance->box.add(point);
        survey.outline.add(point, std::isfinite(geometry.radii[i]) ? geometry.radii[i] : 0);
    }
}

/// Where edges of these cells pass through the height 0, or end there and go down.
void add_feet(const FrameGeometry& geometry, const FrameCells& cells, const std::optional<std::uint32_t>& plant,
              StageSurvey& survey) {
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        const std::uint32_t owner = geometry.of_cells.plants[cells.first + cell];
        if (plant && owner != *plant) continue;
        const auto corners = cells[cell];
        for (std::size_t i = 1; i < corners.size(); ++i) {
            glm::dvec3 low(geometry.points[static_cast<std::size_t>(corners[i - 1])]),
                high(geometry.points[static_cast<std::size_t>(corners[i])]);
            if (low.y > high.y) std::swap(low, high);
            if (!(low.y < 0 && high.y >= 0)) continue;
            survey.stances[owner].feet.add(low + -low.y / (high.y - low.y) * (high - low));
        }
    }
}

/// Relative luminance (WCAG 2.1).
double luminance(const Rgb& rgb) {
    constexpr std::array weights{0.2126, 0.7152, 0.0722};
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double share = rgb[k] / 255.0;
        sum += weights[k] * (share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4));
    }
    return sum;
}

// Yellow has a contrast of 1.07 to white, light green of 1.4.
bool is_pale(const Rgb& rgb) {
    constexpr double least_contrast = 1.3;
    return 1.05 / (luminance(rgb) + 0.05) < least_contrast;
}

void add_colours(const FrameGeometry& geometry, const std::optional<std::uint32_t>& plant, StageSurvey& survey) {
    const auto add = [&](const FrameAttributes& of, std::size_t row) {
        if (plant && of.plants[row] != *plant) return;
        ++survey.drawn;
        survey.pale += is_pale(of.rgb[row]);
    };
    if (geometry.of_points.rgb.empty() || geometry.of_cells.rgb.empty()) return;
    for (std::size_t i = 0; i < geometry.of_points.size(); ++i) {
        if (geometry.of_points.kinds[i] == Kind::axis) add(geometry.of_points, i);
    }
    for (std::size_t i = 0; i < geometry.polygons.size(); ++i) add(geometry.of_cells, geometry.polygons.first + i);
}

void add_field(const RecordedField& field, StageSurvey& survey) {
    if (const auto range = range_of({field.values.begin(), field.values.end()})) {
        widen(survey.field_ranges.try_emplace(field.name, *range).first->second, *range);
    }
    const glm::dvec3 lower = field.origin - 0.5 * field.voxel, size = field.voxel * glm::dvec3(field.size);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 share(corner & 1, corner >> 1 & 1, corner >> 2);
        survey.outline.add(lower + share * size, 0);
    }
}

}  // namespace

void add_survey(const RecordedRun& run, const PictureStyle& style, const Colouring& colouring,
                const RecordedFrame& frame, const FrameGeometry& geometry, StageSurvey& survey) {
    add_plants(geometry, style.plant, survey);
    add_feet(geometry, geometry.lines, style.plant, survey);
    add_feet(geometry, geometry.polygons, style.plant, survey);
    if (colouring.is_natural()) add_colours(geometry, style.plant, survey);
    if (colouring.is_number()) {
        const auto range = range_of(colouring.values(run, frame, geometry));
        if (range) widen(survey.range ? *survey.range : survey.range.emplace(*range), *range);
    }
    for (const FieldLook& look : style.fields) {
        if (frame.fields.contains(look.name)) add_field(run.field(frame, look.name), survey);
    }
}

bool StageSurvey::grows_beneath() const {
    return !box.empty() && box.lower.y < -0.02 * (box.upper.y - box.lower.y);
}

bool StageSurvey::has_roots_to_see() const {
    return !box.empty() && box.lower.y < -0.1 * (box.upper.y - box.lower.y);
}

bool StageSurvey::is_rooted() const {
    constexpr double narrow = 0.3;  // by the extent of a plant
    return std::all_of(stances.begin(), stances.end(), [](const auto& entry) {
        const auto& [all, feet, origin] = entry.second;
        if (all.empty() || feet.empty()) return true;  // the plane cuts nothing
        Box around = feet;
        around.add({origin.x, 0, origin.z});
        const glm::dvec3 stand = around.upper - around.lower, extent = all.upper - all.lower;
        return std::max(stand.x, stand.z) <= narrow * std::max({extent.x, extent.y, extent.z});
    });
}

PictureBackground chosen_background(const RecordedRun& run, const StageSurvey& survey,
                                    const PictureBackground& otherwise) {
    if (run.view() && run.view()->background) return {*run.view()->background, otherwise.transparent};
    return survey.wants_dark() ? dark_background : otherwise;
}

double diagonal(const Box& box) {
    return box.empty() ? 1 : std::max(glm::length(box.upper - box.lower), 1e-9);
}

bool is_flat_box(const Box& box) {
    if (box.empty()) return false;
    const glm::dvec3 size = box.upper - box.lower;
    return size.z <= 0.02 * std::max(size.x, size.y);
}

}  // namespace espalier::picture
