// chiba: leaf clusters as balls that let part of the light through; a branch learns its light and the brightest
// direction. Chiba, Ohkawa, Muraoka & Miura 1994, Visual simulation of botanical trees based on virtual heliotropism
// and dormancy break.
#include "espalier/base/math.h"
#include "espalier/environment/environment_process.h"

#include "base/parallel.h"
#include "environment/exchange/answer_statistics.h"
#include "environment/exchange/changing_settings.h"
#include "environment/exchange/parameter_file.h"
#include "environment/light/shade/ball_shadows.h"
#include "environment/light/shade/balls_along.h"
#include "environment/light/shade/sky_directions.h"

#include <glm/geometric.hpp>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace espalier::environment {
namespace {

constexpr std::int64_t most_samples = 8 << 14;

std::vector<SkyDirection> read_sky(ParameterFile& file) {
    const std::int64_t samples =
        file.whole("number of samples", 128, Range::between(1, static_cast<double>(most_samples)));
    const double ratio = file.number("lower to upper ratio", 0.7, Range::between(0, 1e6));
    const bool overcast = file.flag("use CIE formula", false, {"yes", "on"}, {"no", "off"});
    std::vector<SkyDirection> sources;
    for (const std::vector<double>& source : file.repeated("source direction", 3, 4)) {
        const glm::dvec3 towards(source[0], source[1], source[2]);
        const double intensity = source.size() > 3 ? source[3] : 1;
        if (!(glm::length(towards) > 1e-100) || intensity < 0 || glm::length(towards) > 1e100) {
            throw UserError(file.place("source direction"),
                            "a source needs a direction that is not 0 and an intensity that is not negative");
        }
        sources.push_back({towards, intensity});
    }
    if (!sources.empty()) return normalised_sky(std::move(sources));
    return overcast ? chiba_overcast_sky(samples, ratio) : uniform_sky(samples, ratio);
}

class Chiba final : public EnvironmentProcess {
public:
    Chiba(Settings& settings, const EnvironmentContext& context, Fields&) : statistics_(context.plants) {
        ParameterFile file(
            settings, context,
            {"grid size", "number of samples", "lower to upper ratio", "use CIE formula", "source direction",
             "transmittance", "radius", "beam radius", "estimate intersection area"});
        file.numbers("grid size", {1, 1, 1}, Range::between(1, 1e9));  // rays are exact without one
        sky_ = read_sky(file);
        std::erase_if(sky_, [](const SkyDirection& direction) { return direction.weight == 0; });
        transmittance_ = file.number("transmittance", 0.6, Range::between(0, 1));
        radius_ = file.number("radius", 25, Range::positive());
        beam_ = file.number("beam radius", 0, Range::between(0, 1e6));
        by_area_ = file.flag("estimate intersection area", false);
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        std::vector<std::uint32_t> asking;
        std::vector<Ball> clusters;
        for (std::uint32_t i = 0; i < queries.size(); ++i) {
            if (!asks(queries[i])) continue;
            asking.push_back(i);
            clusters.push_back({queries[i].pose.position, radius_of(queries[i])});
        }
        // Many models let signals pass for several steps before the next leaf unfolds.
        const Optics optics{transmittance_, beam_};
        if (optics != optics_ || clusters != clusters_) {
            lights_ = lights_of(clusters);
            clusters_ = std::move(clusters);
            optics_ = optics;
        }
        statistics_.clear();
        for (std::size_t i = 0; i < asking.size(); ++i) {
            write(lights_[i], answers[asking[i]]);
            statistics_.add(queries[asking[i]].plant, answers[asking[i]][0]);
        }
    }

    std::vector<ChangingSetting> changing_settings() override {
        return {changing("transmittance", Range::between(0, 1), transmittance_),
                changing("radius", Range::positive(), radius_), changing("beam_radius", Range::between(0, 1e6), beam_)};
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override { return statistics_.quantities(plant); }

    std::pair<int, int> query_arity() const override { return {1, 20}; }
    Spreading spreading() const override { return Spreading::queries; }

private:
    static bool asks(const Query& query) { return query.parameters.size() == 1 || query.parameters.size() >= 4; }

    double radius_of(const Query& query) const { return query.parameters[0] > 0 ? query.parameters[0] : radius_; }

    struct Light {
        double sum = 0;
        glm::dvec3 brightest{0};
    };
    /// What keyframes may change and balls do not have.
    struct Optics {
        double transmittance = 0, beam = 0;
        bool operator==(const Optics&) const = default;
    };

    /// Products in an order of their own do not depend on the order of the queries.
    std::vector<Light> lights_of(std::span<const Ball> asked) const {
        std::vector<std::uint32_t> order(asked.size());
        std::iota(order.begin(), order.end(), 0u);
        const auto rank = [&](std::uint32_t i) {
            const glm::dvec3& place = asked[i].centre;
            return std::tuple(place.x, place.y, place.z, asked[i].radius);
        };
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
        std::vector<Ball> clusters;
        clusters.reserve(asked.size());
        for (const std::uint32_t i : order) clusters.push_back(asked[i]);

        std::vector<Light> lights(clusters.size());
        BallsAlong balls(clusters);
        tbb::enumerable_thread_specific<BallsMet> met_by_thread;
        const math::PowersOf powers(transmittance_);
        for (const SkyDirection& direction : sky_) {
            balls.turn_to(direction.towards);
            for_in_parallel(tbb::blocked_range<std::size_t>(0, clusters.size(), 64), [&](const auto& some) {
                BallsMet& met = met_by_thread.local();
                for (std::size_t i = some.begin(); i < some.end(); ++i) {
                    const double margin = (by_area_ ? 1 : beam_) * clusters[i].radius;
                    balls.meet(i, margin, met);
                    const double share = direction.weight * passed(met, clusters[i].radius, margin, powers);
                    lights[order[i]].sum += share;
                    lights[order[i]].brightest += share * direction.towards;
                }
            });
        }
        return lights;
    }

    /// The part of the light from a direction that the balls in its way leave; `powers` are those of the transmittance.
    double passed(BallsMet& met, double radius, double margin, const math::PowersOf& powers) const {
        if (by_area_) return passed_by_areas(met, radius, transmittance_);
        return powers(sum_of_chords(met, margin));
    }

    static void write(const Light& light, Answer answer) {
        answer[0] = light.sum;
        if (answer.size() < 4) return;
        const double length = glm::length(light.brightest);
        const glm::dvec3 brightest = length > 0 ? light.brightest / length : light.brightest;
        for (int axis = 0; axis < 3; ++axis) answer[static_cast<std::size_t>(axis) + 1] = brightest[axis];
    }

    std::vector<SkyDirection> sky_;
    double transmittance_, radius_, beam_;
    bool by_area_;
    AnswerStatistics statistics_;
    // Balls that asked last, and their light.
    std::vector<Ball> clusters_;
    Optics optics_;
    std::vector<Light> lights_;
};

const Registered<ProcessType> entry{
    {"chiba", "light among leaf clusters, and the brightest direction (Chiba, Ohkawa, Muraoka & Miura 1994)",
     R"(Every query is a ball of leaves that reduces the light of all others.

?name(r)          -> light, 0 to 1; r is the radius of the ball, 0: the default
?name(r, x, y, z) -> light, and the brightest direction, of length 1: the mean of the directions, weighted by their light
Further parameters (at most 20 in all) keep their values. Queries with two or three parameters are not clusters.

transmittance          0.6, 0 to 1; t: fraction of light that passes through a whole cluster
radius                 25 m, > 0; radius of clusters whose query says 0
estimate_intersection_area  false; a ball of radius R is passed with t^(chord / 2R)
                       true: 1 - (1 - t) A / (pi r^2), A what its disc covers of the asking cluster's, of radius r
beam_radius            0, 0 to 1e6; balls are larger by this many radii of the cluster that asks (by chords only)
number_of_samples      128, >= 1; directions, taken as the next 8 * 4^k, evenly about an octahedron
lower_to_upper_ratio   0.7, 0 to 1e6; light from below divided by light from above
use_cie_formula        false; light comes evenly from above; true: more light from above, by
                       (1 + c)/3 (8.6 c + 0.123)/0.203, c = y/sqrt(x^2 + y^2), as cpfg's chiba weights it: c leaves
                       out z, so that this sky is not round
source_direction       none; ["x y z intensity", ...]: directions towards lights in place of the samples; the
                       intensity is 1 if it is left out
grid_size              [1, 1, 1]; accepted and ignored: all clusters are tested
verbose                accepted and ignored: the messages of cpfg's program
parameters             none; a file with these keys in words, as cpfg's program chiba reads it

By chords, of a ball around the query's centre only the part in front counts. By areas, only clusters whose centres are in front reduce the light. Answers do not depend on the order of the queries.
Statistics of a plant: mean, min, max of the light, queries.
)",
     construct<Chiba>}};

}  // namespace
}  // namespace espalier::environment
