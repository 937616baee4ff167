// takenaka: leaf clusters between sources of light; a branch learns what its leaves produce.
// Takenaka 1994, A simulation model of tree architecture development based on growth response to local light
// environment.
#include "espalier/base/math.h"
#include "espalier/environment/environment_process.h"

#include "base/parallel.h"
#include "environment/exchange/answer_statistics.h"
#include "environment/exchange/changing_settings.h"
#include "environment/exchange/parameter_file.h"
#include "environment/light/shade/sphere_tree.h"

#include <cmath>
#include <numbers>

namespace espalier::environment {
namespace {

/// Photons in the open, mol cm^-2 in a year: 1000 umol m^-2 s^-1 for 12 h on 200 days.
constexpr double full_light = 8.64;

constexpr int points_of_disk = 100;

struct Source {
    glm::dvec3 place;
    double intensity;
};

/// A level disc as sources spread evenly over it (sunflower pattern; Vogel 1979).
std::vector<Source> disk(const std::vector<double>& numbers) {
    std::vector<Source> sources;
    for (int i = 0; i < points_of_disk; ++i) {
        const double from_middle = numbers[0] * std::sqrt((i + 0.5) / points_of_disk);
        const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
        const glm::dvec3 place(numbers[1] + from_middle * math::cos(angle), numbers[2],
                               numbers[3] + from_middle * math::sin(angle));
        sources.push_back({place, 1.0 / points_of_disk});
    }
    return sources;
}

std::vector<Source> read_sources(ParameterFile& file) {
    std::vector<Source> sources;
    for (const std::vector<double>& source : file.repeated("source", 3, 4)) {
        const double intensity = source.size() > 3 ? source[3] : 1;
        if (intensity < 0) throw UserError(file.place("source"), "a source's intensity must not be negative");
        sources.push_back({{source[0], source[1], source[2]}, intensity});
    }
    for (const std::vector<double>& numbers : file.repeated("disk source", 4, 4)) {
        for (const Source& source : disk(numbers)) sources.push_back(source);
    }
    if (sources.empty()) sources.push_back({{0, 1e6, 0}, 1});
    double sum = 0;
    for (const Source& source : sources) sum += source.intensity;
    for (Source& source : sources) source.intensity *= sum > 0 ? full_light / sum : 0;
    return sources;
}

class Takenaka final : public EnvironmentProcess {
public:
    Takenaka(Settings& settings, const EnvironmentContext& context, Fields&) : statistics_(context.plants) {
        ParameterFile file(
            settings, context,
            {"grid size", "parameter s", "transmittance", "efficiency", "source", "disk source", "beam radius"});
        file.numbers("grid size", {1, 1, 1}, Range::between(1, 1e9));  // rays are exact without one
        around_counts_ = file.has_numbers_of_cpfg();
        s_ = file.number("parameter s", 1.5, Range::between(1, 1e6));
        transmittance_ = file.number("transmittance", 0.1, Range::between(0, 1));
        efficiency_ = file.number("efficiency", 0.015, Range::between(0, 1e9));
        beam_ = file.number("beam radius", 0, Range::between(0, 1e6));
        sources_ = read_sources(file);
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        std::vector<SphereTree::Sphere> clusters;
        for (std::uint32_t i = 0; i < queries.size(); ++i) {
            const double area = std::max(queries[i].parameters[0], 0.0);
            clusters.push_back({queries[i].pose.position, s_ / 2 * std::sqrt(area / std::numbers::pi), i});
        }
        const SphereTree tree(clusters);
        for_in_parallel(std::size_t{0}, clusters.size(), [&](std::size_t i) {
            if (answers[i].size() > 1) answers[i][1] = product(tree, clusters[i], queries[i].parameters);
        });
        statistics_.sum_up(queries, answers, 1);
    }

    std::vector<ChangingSetting> changing_settings() override {
        return {changing("parameter_s", Range::between(1, 1e6), s_),
                changing("transmittance", Range::between(0, 1), transmittance_),
                changing("efficiency", Range::between(0, 1e9), efficiency_),
                changing("beam_radius", Range::between(0, 1e6), beam_)};
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override { return statistics_.quantities(plant); }

    std::pair<int, int> query_arity() const override { return {1, 20}; }
    Spreading spreading() const override { return Spreading::queries; }

private:
    /// What passes straight down through a cluster spread over s^2 times its leaves' shadow.
    double passed() const { return 1 - (1 - transmittance_) / (s_ * s_); }

    // e S (A s^2 / 4) a - w with a = 1 - passed^2 (Takenaka 1994).
    double product(const SphereTree& tree, const SphereTree::Sphere& own, std::span<const double> asked) const {
        double light = 0;
        for (const Source& source : sources_)
            light += source.intensity * math::pow(passed(), 2 * hits(tree, own, source));
        const double absorbed = 1 - passed() * passed();
        return efficiency_ * light * (std::max(asked[0], 0.0) * s_ * s_ / 4) * absorbed - asked[1];
    }

    int hits(const SphereTree& tree, const SphereTree::Sphere& own, const Source& source) const {
        const double length = glm::distance(source.place, own.centre);
        if (!(length > 0)) return 0;
        const double beam = beam_ * own.radius;
        const Ray ray{own.centre, (source.place - own.centre) / length, length, beam};
        int count = 0;
        tree.visit_along(ray, [&](const auto& other) {
            const glm::dvec3 between = other.centre - own.centre;
            const double ahead = glm::dot(between, ray.direction);
            const double reach = other.radius + beam;
            const double apart2 = glm::dot(between, between), aside2 = apart2 - ahead * ahead;
            const bool in_front = ahead > 0 || (around_counts_ && apart2 < reach * reach);
            if (other.number != own.number && in_front && ahead < length && aside2 < reach * reach) ++count;
        });
        return count;
    }

    bool around_counts_;  ///< a ball around the asking centre shades it from all sides
    double s_, transmittance_, efficiency_, beam_;
    std::vector<Source> sources_;
    AnswerStatistics statistics_;
};

const Registered<ProcessType> entry{{"takenaka", "production of leaf clusters that shade each other (Takenaka 1994)",
                                     R"(Every query is a ball of leaves that shades the others.

?name(A, w) -> w = e S (A s^2 / 4) a - w: production of leaves of area A (cm2), less the upkeep w. S is the light in a
               year at the cluster; each ball in front of a source transmits the fraction tau^2,
               tau = 1 - (1 - t) / s^2 and a = 1 - tau^2. A ball's radius is (s / 2) sqrt(A / pi)
?name(A)    -> A: shades others, and gets no answer
Further parameters (at most 20 in all) keep their values.

parameter_s    1.5, 1 to 1e6; s: how widely leaves are spread
transmittance  0.1, 0 to 1; t: fraction of light that passes through a leaf
efficiency     0.015, 0 to 1e9; e: production per absorbed light
source         none; ["x y z intensity", ...]: places of lights, of intensity 1 if it is left out; without any there is
               one straight above, 1e6 up
disk_source    none; ["radius x y z", ...]: horizontal discs of light, each as 100 points of total intensity 1
beam_radius    0, 0 to 1e6; balls are larger by this many radii of the querying ball
grid_size      [1, 1, 1]; accepted and ignored: all clusters are tested
verbose        accepted and ignored: the messages of cpfg's program
parameters     none; a file with these keys in words, as cpfg's program takenaka reads it
numbers        "exact", or "cpfg"; exact: a ball counts if its centre is in front of the query's centre; cpfg (the
               default with `parameters` and in .e files): a ball around the query's centre counts too

All sources together give 8.64 mol cm-2 per year without shade (1000 umol m-2 s-1 for 12 h on 200 days).
Statistics of a plant: mean, min, max of the answers, queries.
)",
                                     construct<Takenaka>, true}};

}  // namespace
}  // namespace espalier::environment
