#include "picture/stage/stage_survey.h"

#include <algorithm>
#include <cmath>

namespace espalier::picture {
namespace {

void widen(std::array<double, 2>& range, const std::array<double, 2>& by) {
    range = {std::min(range[0], by[0]), std::max(range[1], by[1])};
}

void add_plants(const RecordedGeometry& geometry, const std::optional<std::uint32_t>& plant, StageSurvey& survey) {
    for (std::size_t i = 0; i < geometry.points.size(); ++i) {
        const Kind kind = geometry.of_points.kinds[i];
        if (plant && geometry.of_points.plants[i] != *plant) continue;
        if (kind == Kind::query || kind == Kind::label) continue;
        const glm::dvec3 point(geometry.points[i]);
        if (!std::isfinite(point.x + point.y + point.z)) continue;
        survey.box.add(point);
        survey.outline.add(point, std::isfinite(geometry.radii[i]) ? geometry.radii[i] : 0);
    }
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
                const RecordedFrame& frame, const RecordedGeometry& geometry, StageSurvey& survey) {
    add_plants(geometry, style.plant, survey);
    if (colouring.is_number()) {
        const auto range = range_of(colouring.values(run, frame, geometry));
        if (range) widen(survey.range ? *survey.range : survey.range.emplace(*range), *range);
    }
    for (const FieldLook& look : style.fields) {
        if (frame.fields.contains(look.name)) add_field(run.field(frame, look.name), survey);
    }
}

}  // namespace espalier::picture
