#include "archive/unfolding.h"

#include <glm/geometric.hpp>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace espalier::archive {
namespace {

/// The n-th thing that a module of a plant draws.
using DrawnPart = std::tuple<std::uint32_t, std::uint64_t, std::uint32_t>;

struct DrawnPartHash {
    std::size_t operator()(const DrawnPart& part) const {
        const auto& [plant, identity, number] = part;
        return static_cast<std::size_t>((identity ^ plant) * 0x9e3779b97f4a7c15u + number);
    }
};

/// Counts what each module draws, so that a part has the same number in both frames.
class PartNumbers {
public:
    DrawnPart next(std::uint32_t plant, std::uint64_t identity) {
        return {plant, identity, count_[{plant, identity}]++};
    }

private:
    std::map<std::pair<std::uint32_t, std::uint64_t>, std::uint32_t> count_;
};

/// From one vector to another: along a great circle, its length changing linearly.
glm::vec3 turned(const glm::vec3& from, const glm::vec3& to, float share) {
    const float before = glm::length(from), after = glm::length(to);
    if (before == 0 || after == 0) return glm::mix(from, to, share);
    const glm::vec3 a = from / before, b = to / after;
    const float angle = std::acos(std::clamp(glm::dot(a, b), -1.0F, 1.0F));
    constexpr float straight = 1e-4F, opposite = 3.14F;  // beyond both no circle is determined
    const glm::vec3 direction =
        angle < straight || angle > opposite
            ? (share < 0.5F && angle > opposite ? a : b)
            : (std::sin((1 - share) * angle) * a + std::sin(share * angle) * b) / std::sin(angle);
    return std::lerp(before, after, share) * direction;
}

/// Finds the tip nearest to a point; none among none.
class NearestTip {
public:
    explicit NearestTip(const std::vector<FrameInternode>& internodes) {
        vtkNew<vtkPoints> tips;
        for (const FrameInternode& internode : internodes) {
            tips->InsertNextPoint(internode.tip.x, internode.tip.y, internode.tip.z);
        }
        data_->SetPoints(tips);
        if (internodes.empty()) return;
        locator_->SetDataSet(data_);
        locator_->BuildLocator();
    }

    InternodeIndex of(const glm::vec3& point) {
        if (data_->GetNumberOfPoints() == 0) return {};
        const double place[3] = {point.x, point.y, point.z};
        return InternodeIndex(locator_->FindClosestPoint(place));
    }

private:
    vtkNew<vtkPolyData> data_;
    vtkNew<vtkStaticPointLocator> locator_;
};

glm::vec3 place(const FrameGeometry& geometry, PointIndex point) {
    return geometry.points[point.row()];
}

/// Points that are no points of axes, module by module.
std::map<std::pair<std::uint32_t, std::uint64_t>, std::vector<PointIndex>> organ_points_of(
    const FrameGeometry& geometry, const std::vector<FrameInternode>& internodes) {
    std::vector<bool> of_axis(geometry.points.size());
    for (const FrameInternode& internode : internodes) {
        of_axis[internode.base_point.row()] = true;
        of_axis[internode.tip_point.row()] = true;
    }
    std::map<std::pair<std::uint32_t, std::uint64_t>, std::vector<PointIndex>> organs;
    for (std::size_t i = 0; i < geometry.points.size(); ++i) {
        if (of_axis[i]) continue;
        organs[{geometry.of_points.plants[i], geometry.of_points.identities[i]}].emplace_back(i);
    }
    return organs;
}

}  // namespace

Unfolding::Unfolding(const FrameGeometry& early, FrameGeometry late) : late_(std::move(late)) {
    const std::vector<FrameInternode> before = internodes_of(early);
    match_internodes(before);
    match_organs(early, before);
}

void Unfolding::match_internodes(const std::vector<FrameInternode>& before) {
    std::unordered_map<DrawnPart, const FrameInternode*, DrawnPartHash> known;
    PartNumbers numbers_before, numbers_after;
    for (const FrameInternode& internode : before) {
        known.emplace(numbers_before.next(internode.plant, internode.identity), &internode);
    }
    for (const FrameInternode& late : internodes_of(late_)) {
        Growing& growing = internodes_.emplace_back(Growing{late});
        const auto found = known.find(numbers_after.next(late.plant, late.identity));
        growing.was_base = late.base;
        if (found == known.end()) continue;
        const FrameInternode& was = *found->second;
        growing.is_new = false;
        growing.was_base = was.base;
        growing.was = was.tip - was.base;
        growing.was_base_radius = was.base_radius;
        growing.was_tip_radius = was.tip_radius;
    }
}

void Unfolding::match_organs(const FrameGeometry& early, const std::vector<FrameInternode>& before) {
    std::vector<FrameInternode> after;
    for (const Growing& growing : internodes_) after.push_back(growing.late);
    const auto were = organ_points_of(early, before);
    NearestTip tips_before(before), tips_after(after);
    for (const auto& [module, points] : organ_points_of(late_, after)) {
        const InternodeIndex bearer = tips_after.of(place(late_, points.front()));
        const glm::vec3 foot = bearer.is_none() ? place(late_, points.front()) : after[bearer.row()].tip;
        const auto found = were.find(module);
        const bool is_known = found != were.end() && found->second.size() == points.size();
        glm::vec3 was_foot = foot;
        if (is_known) {
            const InternodeIndex tip = tips_before.of(place(early, found->second.front()));
            was_foot = tip.is_none() || bearer.is_none() ? foot : before[tip.row()].tip;
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::vec3 from = is_known ? place(early, found->second[i]) - was_foot : glm::vec3(0);
            organ_points_.push_back({points[i], bearer, from, place(late_, points[i]) - foot});
        }
    }
}

FrameGeometry Unfolding::at(double share) const {
    const auto now = static_cast<float>(share);
    FrameGeometry geometry = late_;
    RowsOf<FrameInternode, glm::vec3> tips(internodes_.size()), bases(internodes_.size());
    for (InternodeIndex i(0); i < internodes_.next(); ++i) {
        const Growing& growing = internodes_[i];
        const FrameInternode& late = growing.late;
        if (late.bearer.is_none()) {
            bases[i] = glm::mix(growing.was_base, late.base, now);
        } else {
            bases[i] = late.base == internodes_[late.bearer].late.tip ? tips[late.bearer] : bases[late.bearer];
        }
        const glm::vec3 to = late.tip - late.base;
        tips[i] = bases[i] + (growing.is_new ? now * to : turned(growing.was, to, now));
        const std::size_t base_point = late.base_point.row(), tip_point = late.tip_point.row();
        const bool begins_axis = i == InternodeIndex(0) || internodes_[i.before()].late.axis != late.axis;
        if (begins_axis) {
            geometry.points[base_point] = bases[i];
            geometry.radii[base_point] = std::lerp(growing.was_base_radius, late.base_radius, now);
        }
        geometry.points[tip_point] = tips[i];
        geometry.radii[tip_point] = std::lerp(growing.was_tip_radius, late.tip_radius, now);
    }
    for (const OrganPoint& organ : organ_points_) {
        const glm::vec3 foot = organ.bearer.is_none() ? place(late_, organ.point) - organ.to : tips[organ.bearer];
        geometry.points[organ.point.row()] = foot + glm::mix(organ.from, organ.to, now);
    }
    return geometry;
}

}  // namespace espalier::archive
