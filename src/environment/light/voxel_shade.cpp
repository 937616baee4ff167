// voxel-shade: organs cast pyramids of shadow; a query answers the light the shadows of all others leave.
// Palubicki, Horel, Longay, Runions, Lane, Mech & Prusinkiewicz 2009, Self-organizing tree models, section 3.
#include "espalier/environment/environment_process.h"

#include "base/parallel.h"
#include "environment/exchange/answer_statistics.h"
#include "environment/exchange/changing_settings.h"
#include "environment/exchange/covering.h"
#include "environment/light/shade/grids.h"
#include "environment/light/shade/light.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::environment {
namespace {

// 2^35 voxels, half a terabyte when all of them are shaded.
constexpr double most_domain_voxels = 34359738368.0;

// Questions ahead of the one that is answered: as many as the memory can look up at the same time.
constexpr std::size_t fetched_ahead = 8;

ShadeRule read_rule(const Settings& settings) {
    ShadeRule rule;
    rule.attenuate = settings.choice_or("mode", "add", {"add", "attenuate"}) == "attenuate";
    rule.strength = settings.number_or("strength", rule.strength, Range::between(0, 1e6));
    rule.dissipation = settings.number_or("dissipation", rule.dissipation, Range::between(1, 1e12));
    rule.depth = static_cast<int>(settings.integer_or("depth", rule.depth, Range::between(0, 1000)));
    rule.spread = settings.number_or("spread", rule.spread, Range::between(0, 100));
    rule.full_light = settings.number_or("full_light", rule.full_light, Range::between(0, 1e12));
    rule.flat = settings.integer_or("dimensions", 3, Range::between(2, 3)) == 2;
    return rule;
}

std::optional<Box> read_domain(const Settings& settings, const std::optional<Box>& of_scene) {
    if (!settings.has("domain")) return of_scene;
    const Settings table = settings.table("domain");
    const Box domain{table.vector("lower"), table.vector("upper")};
    for (int axis = 0; axis < 3; ++axis) {
        if (domain.lower[axis] < domain.upper[axis]) continue;
        throw UserError(table.place("upper"), "the domain's upper corner must lie above its lower corner");
    }
    return domain;
}

/// Lays the voxels so that whole ones cover the domain. Voxel (0, 0, 0) stays the one at the origin.
void cover(const Box& domain, ShadeLattice& lattice) {
    const glm::dvec3 first = lower_corner_over(domain, lattice.voxel) / lattice.voxel + 0.5;
    const glm::dvec3 whole = glm::floor(first + 0.5 + 1e-9);
    for (int axis = 0; axis < (lattice.flat ? 2 : 3); ++axis) {
        const double beside = first[axis] - whole[axis];
        lattice.centre[axis] = std::abs(beside) < 1e-9 ? 0 : lattice.voxel * beside;
    }
    lattice.domain = {glm::ivec3(whole), glm::ivec3(whole + voxels_over(domain, lattice.voxel) - 1.0)};
    if (lattice.flat) lattice.domain.lower.z = lattice.domain.upper.z = 0;
}

void require_size(const Box& domain, double voxel, bool flat, std::size_t memory, const Place& place) {
    glm::dvec3 size = (domain.upper - domain.lower) / voxel;
    if (flat) size.z = 1;
    const glm::dvec3 end = glm::max(glm::abs(domain.lower), glm::abs(domain.upper)) / voxel;
    const double voxels = std::max(size.x, 1.0) * std::max(size.y, 1.0) * std::max(size.z, 1.0);
    const double bytes = voxels * (sizeof(Shade) + 2 * sizeof(float));
    const bool numbered = std::max({end.x, end.y, flat ? 0 : end.z}) < 1 << 29;
    if (numbered && voxels <= most_domain_voxels && bytes <= static_cast<double>(memory)) return;
    throw UserError(place,
                    fmt::format("a domain of {:g} x {:g} x {:g} m in voxels of {:g} m has {:.3g} voxels and needs "
                                "up to {:.3g} GiB of memory; take larger voxels or a smaller domain",
                                domain.upper.x - domain.lower.x, domain.upper.y - domain.lower.y,
                                domain.upper.z - domain.lower.z, voxel, voxels, bytes / 1073741824.0));
}

void require_period(const Box& domain, const ShadeLattice& lattice, const ShadeRule& rule, const Place& place) {
    for (const int axis : {0, 2}) {
        if (axis == 2 && rule.flat) continue;
        const double voxels = (domain.upper[axis] - domain.lower[axis]) / lattice.voxel;
        if (std::abs(voxels - std::round(voxels)) > 1e-6 || voxels < 0.5) {
            throw UserError(place, fmt::format("a periodic domain must be a whole number of voxels wide, not {:g} of "
                                               "{:g} m along {}",
                                               voxels, lattice.voxel, axis == 0 ? "x" : "z"));
        }
        if (half_width(rule, rule.depth) > 8 * voxels) {
            throw UserError(place, "the pyramids are more than 8 times as wide as the periodic domain on either side");
        }
    }
}

ShadeLattice read_lattice(const Settings& settings, const EnvironmentContext& context, const ShadeRule& rule) {
    ShadeLattice lattice;
    lattice.voxel = read_voxel(settings, lattice.voxel);
    lattice.flat = rule.flat;
    lattice.trilinear = settings.choice_or("sampling", "trilinear", {"trilinear", "nearest"}) == "trilinear";
    lattice.periodic = settings.flag_or("periodic", false);
    lattice.fixed = settings.flag_or("fixed", lattice.periodic || settings.has("domain"));
    const std::optional<Box> domain = read_domain(settings, context.domain);
    if (domain) {
        require_size(*domain, lattice.voxel, rule.flat, context.memory, settings.place("voxel"));
        cover(*domain, lattice);
    }
    if (!lattice.fixed && !lattice.periodic) return lattice;
    if (!domain) {
        throw UserError(settings.place(lattice.periodic ? "periodic" : "fixed"),
                        fmt::format("'{}' needs a domain = {{ lower = [x, y, z], upper = [x, y, z] }}, its own or the "
                                    "scene's, to be {}",
                                    context.name, lattice.periodic ? "periodic" : "fixed"));
    }
    if (lattice.periodic) require_period(*domain, lattice, rule, settings.place("voxel"));
    return lattice;
}

/// The voxels that can be shaded. A periodic domain that is not fixed has no top and no bottom.
VoxelBox clip_of(const ShadeLattice& lattice) {
    const int far = 1 << 30;
    VoxelBox clip{glm::ivec3(-far), glm::ivec3(far)};
    if (lattice.fixed) return lattice.domain;
    if (lattice.periodic) {
        clip = lattice.domain;
        clip.lower.y = -far;
        clip.upper.y = far;
    }
    return clip;
}

class VoxelShade final : public EnvironmentProcess, private TakesParts {
public:
    VoxelShade(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : rule_(read_rule(settings)),
          lattice_(read_lattice(settings, context, rule_)),
          gradient_radius_(settings.number_or("gradient_radius", lattice_.voxel, Range::positive())),
          casts_(rule_, clip_of(lattice_)),
          field_(context.memory),
          grids_(context.name, rule_, lattice_),
          statistics_(context.plants),
          cast_by_(context.plants) {
        grids_.provide(field_.bricks(), shown(), fields);
    }

    void advance(const WorldView&, Queries queries, Fields&) override {
        begin();
        take(queries);
        settle();
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        answer_part(queries, answers);
    }

    TakesParts* in_parts() override { return this; }

    void begin() override {
        casts_.begin_step();
        grids_.begin_step(field_.bricks());
        casts_begin_.clear();
    }

    void take(Queries part) override {
        for (const Query& query : part) {
            casts_begin_.push_back(casts_.casts().size());
            if (query.parameters[0] > 0) {
                cast(lattice_.voxel_of(query.pose.position), query.parameters[0] * strength_now_);
            }
        }
    }

    void settle() override {
        casts_begin_.push_back(casts_.casts().size());
        field_.show(casts_, [this] { return grids_.light_to_write(field_.bricks(), shown()); });
        answered_ = 0;
        statistics_.clear();
        std::fill(cast_by_.begin(), cast_by_.end(), 0);
    }

    void answer_part(Queries part, std::span<Answer> answers) override {
        const ShadeLight light(lattice_, casts_, field_);
        const auto answer_some = [&](const tbb::blocked_range<std::size_t>& some) {
            for (std::size_t i = some.begin(); i < some.end(); ++i) {
                if (i + fetched_ahead < some.end()) light.fetch(part[i + fetched_ahead].pose.position);
                answer_one(light, part[i], own(answered_ + i), answers[i]);
            }
        };
        for_in_parallel(tbb::blocked_range<std::size_t>(0, part.size(), 256), answer_some);
        answered_ += part.size();
        count(part, answers);
    }

    std::vector<ChangingSetting> changing_settings() override {
        std::vector<ChangingSetting> settings{changing("gradient_radius", Range::positive(), gradient_radius_)};
        if (rule_.strength > 0) {
            settings.push_back({"strength", Range::between(0, 1e6),
                                [this](double strength) { strength_now_ = strength / rule_.strength; }});
        }
        return settings;
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        std::vector<Quantity> all = statistics_.quantities(plant);
        all.push_back({"casts", plant < cast_by_.size() ? cast_by_[plant] : 0});
        return all;
    }

    std::pair<int, int> query_arity() const override { return {1, 20}; }

    // A period stores its images: every query may reach everywhere.
    Spreading spreading() const override { return lattice_.periodic ? Spreading::queries : Spreading::reach; }
    Box reach(const Query& query) const override {
        if (!(query.parameters[0] > 0)) return {};
        // Answers look half a voxel aside, gradients further, and the apex is where its voxel is.
        const double aside = gradient_radius_ + 2 * lattice_.voxel;
        const double wide = casts_.half_width(rule_.depth) * lattice_.voxel + aside;
        const double deep = rule_.depth * lattice_.voxel + aside;
        const double thick = lattice_.flat ? std::numeric_limits<double>::infinity() : wide;
        const glm::dvec3& at = query.pose.position;
        return {at - glm::dvec3(wide, deep, thick), at + glm::dvec3(wide, aside, thick)};
    }

    ProcessMemory memory() const override { return {field_.bricks().bytes(), true}; }
    void limit_memory(std::size_t bytes) override { field_.bricks().limit_memory(bytes); }

private:
    const VoxelBox& shown() const { return lattice_.fixed ? lattice_.domain : field_.box(); }

    // In a periodic domain, with every image whose pyramid reaches into the stored period.
    void cast(const glm::ivec3& voxel, double s) {
        const glm::ivec3 apex = lattice_.wrapped(voxel);
        if (!lattice_.periodic) return casts_.add(apex, s);
        const glm::ivec3 period = lattice_.domain.upper - lattice_.domain.lower + 1;
        const int width = casts_.half_width(casts_.rule().depth);
        const int images_x = width / period.x + 1;
        const int images_z = lattice_.flat ? 0 : width / period.z + 1;
        for (int x = -images_x; x <= images_x; ++x) {
            for (int z = -images_z; z <= images_z; ++z) casts_.add(apex + glm::ivec3(x * period.x, 0, z * period.z), s);
        }
    }

    std::span<const ShadeCast> own(std::size_t query) const {
        return casts_.casts().subspan(casts_begin_[query], casts_begin_[query + 1] - casts_begin_[query]);
    }

    void answer_one(const ShadeLight& light, const Query& query, std::span<const ShadeCast> own, Answer answer) const {
        const glm::dvec3& point = query.pose.position;
        answer[0] = light.at(point, own);
        if (answer.size() < 4) return;
        const glm::dvec3 gradient = light.gradient(point, gradient_radius_, own);
        for (int axis = 0; axis < 3; ++axis) answer[static_cast<std::size_t>(axis) + 1] = gradient[axis];
    }

    void count(Queries part, std::span<const Answer> answers) {
        statistics_.add(part, answers);
        for (const Query& query : part) {
            if (query.plant >= cast_by_.size()) cast_by_.resize(query.plant + 1);
            cast_by_[query.plant] += query.parameters[0] > 0;
        }
    }

    ShadeRule rule_;
    ShadeLattice lattice_;
    double gradient_radius_;
    double strength_now_ = 1;  ///< by that of the rule
    ShadeCasts casts_;
    ShadeField field_;
    ShadeGrids grids_;
    std::vector<std::size_t> casts_begin_;  ///< where the casts of each query begin, and where the last one's end
    std::size_t answered_ = 0;              ///< queries of this step
    AnswerStatistics statistics_;
    std::vector<double> cast_by_;  ///< pyramids of each plant
};

const Registered<ProcessType> entry{
    {"voxel-shade", "light under the shadow pyramids of all organs (Palubicki et al. 2009)",
     R"(Every query with s > 0 casts a pyramid: it shades its own voxel (layer q = 0) and, q = 1 ... depth layers below, a
square of half-width floor(spread q) voxels, by  s strength dissipation^-q.  A query never shades itself.

?name(s)          -> light Q at the position; s is the strength of the shadow, s <= 0 only asks
?name(s, x, y, z) -> light, and its gradient per metre: the brightest direction, not normalised
Further parameters (at most 20 in all) keep their values.

voxel           0.5 m, >= 1.5e-5; edge of a voxel. Whole voxels cover the domain about its middle; without a domain, the centre
                of one voxel is at the origin
mode            "add", or "attenuate"; add: Q = max(full_light - sum of shadows, 0);
                attenuate: Q = full_light times the product of 1 - min(1, shadow)
strength        0.2, 0 to 1e6; a: shadow of a query of strength 1 in its own voxel
dissipation     2, 1 to 1e12; b: the shadow is b times weaker in each layer below
depth           6, 0 to 1000; q_max: number of layers below
spread          1, 0 to 100; increase of the half-width per layer, in voxels
full_light      1, 0 to 1e12; C: light without shade
sampling        "trilinear", or "nearest"; trilinear: between the eight voxels around the query; nearest: the voxel that
                contains it
gradient_radius  one voxel, m, > 0; distance of the central differences
dimensions      3, 2 to 3; 2: one voxel thick, z is ignored
domain          the domain of the scene, m; { lower = [x, y, z], upper = [x, y, z] }
fixed           false; false: shade grows with the plants. There is full light outside a fixed domain; in it, light
                reaches its sides as it is in the outermost voxels. It is true if `domain` is given here or `periodic`
                is true
periodic        false; true: the domain repeats along x and z without end

Fields: name (light), name.shade (the sum, or the optical depth).
Statistics of a plant: mean, min, max of its answers, queries, casts.
)",
     construct<VoxelShade>}};

}  // namespace
}  // namespace espalier::environment
