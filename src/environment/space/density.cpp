// density: density in the plane, and the direction in which it decreases.
// Cohen 1967, Computer simulation of biological pattern generation processes.
#include "espalier/base/math.h"
#include "espalier/environment/environment_process.h"

#include "base/parallel.h"
#include "environment/exchange/answer_statistics.h"
#include "environment/exchange/parameter_file.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <numbers>
#include <tuple>

namespace espalier::environment {
namespace {

/// Something that makes its surroundings dense.
struct Occupant {
    glm::dvec2 place;
    bool is_source;
    double strength;
};

class Density final : public EnvironmentProcess {
public:
    Density(Settings& settings, const EnvironmentContext& context, Fields&) : statistics_(context.plants) {
        ParameterFile file(settings, context,
                           {"range", "position", "output image", "frame intervals", "quantization step", "gamma",
                            "one point value", "return vector"});
        as_cpfg_ = file.has_numbers_of_cpfg();
        at_the_point_ = file.flag("one point value", false);
        const bool vector = file.flag("return vector", false, {"yes", "on"}, {"no", "off"});
        as_vector_ = vector && !as_cpfg_;
        // These describe the picture that cpfg's program writes, and we record in other ways.
        for (const char* key : {"range", "position"}) file.numbers(key, {0, 0});
        for (const char* key : {"quantization step", "gamma"}) file.number(key, 1);
        for (const char* key : {"output image", "frame intervals"}) file.file(key);
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        occupants_.clear();
        for (const Query& query : queries) {
            const bool is_source = query.parameters.size() == 1;
            occupants_.push_back({place(query), is_source, is_source ? query.parameters[0] : 1});
        }
        // Sums in an order of their own do not depend on the order of the queries.
        std::sort(occupants_.begin(), occupants_.end(), [](const Occupant& a, const Occupant& b) {
            return std::tie(a.place.x, a.place.y, a.is_source, a.strength) <
                   std::tie(b.place.x, b.place.y, b.is_source, b.strength);
        });
        for_in_parallel(std::size_t{0}, queries.size(), [&](std::size_t i) {
            if (queries[i].parameters.size() == 3) answer_one(place(queries[i]), answers[i]);
        });
        statistics_.clear();
        for (std::size_t i = 0; i < queries.size(); ++i) {
            if (answers[i].size() == 3) statistics_.add(queries[i].plant, answers[i][0]);
        }
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override { return statistics_.quantities(plant); }

    std::pair<int, int> query_arity() const override { return {1, 20}; }
    Spreading spreading() const override { return Spreading::queries; }

private:
    static glm::dvec2 place(const Query& query) { return glm::dvec2(query.pose.position.x, query.pose.position.y); }

    double density(const glm::dvec2& at) const { return density(at, occupants_.size()); }

    // In cpfg the asker itself adds nothing.
    double density_for(const glm::dvec2& asker, const glm::dvec2& at) const {
        if (!as_cpfg_) return density(at);
        const auto itself = std::find_if(occupants_.begin(), occupants_.end(), [&](const Occupant& other) {
            return !other.is_source && other.place == asker;
        });
        return density(at, static_cast<std::size_t>(itself - occupants_.begin()));
    }

    double density(const glm::dvec2& at, std::size_t left_out) const {
        double sum = 0;
        for (std::size_t i = 0; i < occupants_.size(); ++i) {
            if (i == left_out) continue;
            const Occupant& other = occupants_[i];
            const double apart = glm::distance(other.place, at);
            sum += other.is_source ? other.strength / (1 + apart) : 1 / (1 + apart * apart);
        }
        return sum;
    }

    // 6 x 6 places in the unit square around it.
    double least_around(const glm::dvec2& at) const {
        double least = density_for(at, at + glm::dvec2(-0.5));
        for (int i = 0; i < 36; ++i) {
            least = std::min(least, density_for(at, at + glm::dvec2(-0.5 + 0.2 * (i % 6), -0.5 + 0.2 * (i / 6))));
        }
        return least;
    }

    /// How much it falls over a unit to the right and above. cpfg's program takes a sixth of what it falls between the
    /// middle ones of its 6 x 6 places.
    glm::dvec2 downhill_at(const glm::dvec2& at) const {
        if (as_cpfg_ && !at_the_point_) {
            const double corner = density_for(at, at + glm::dvec2(0.1));
            return glm::dvec2(density_for(at, at + glm::dvec2(-0.1, 0.1)) - corner,
                              density_for(at, at + glm::dvec2(0.1, -0.1)) - corner) /
                   6.0;
        }
        const glm::dvec2 right(0.5, 0), above(0, 0.5);
        return {density_for(at, at - right) - density_for(at, at + right),
                density_for(at, at - above) - density_for(at, at + above)};
    }

    void answer_one(const glm::dvec2& at, Answer answer) const {
        const glm::dvec2 downhill = downhill_at(at);
        answer[0] = at_the_point_ ? density_for(at, at) : least_around(at);
        answer[1] = as_vector_ ? downhill.x : angle(downhill);
        answer[2] = as_vector_ ? downhill.y : glm::length(downhill);
    }

    double angle(const glm::dvec2& direction) const {
        if (as_cpfg_ && direction == glm::dvec2(0)) return 90;
        const double degrees = math::atan2(direction.y, direction.x) * 180 / std::numbers::pi;
        return as_cpfg_ && degrees < 0 ? degrees + 360 : degrees;
    }

    bool as_cpfg_, at_the_point_, as_vector_;
    std::vector<Occupant> occupants_;
    AnswerStatistics statistics_;
};

const Registered<ProcessType> entry{
    {"density", "density in the plane, and the direction in which it decreases (Cohen 1967)",
     R"(The density at a place is the sum of 1 / (1 + d^2) over all queries but sources and of v / (1 + d) over the sources,
d being their distance in x and y.

?name(v)          a source of strength v, which may be negative; keeps its value
?name(r, a, m) -> r: the density; a, m: direction of steepest decrease, in degrees from +x towards +y, and how
                  much it decreases over one unit, by differences over half a unit on either side
Queries with other numbers of parameters only count as neighbours.

one_point_value  false; r is the least of 6 x 6 places in the unit square around the query; true: at the query itself
return_vector    false; a and m are angle and size of the fall; true: its x and y
range, position, output_image, frame_intervals, quantization_step, gamma, verbose  accepted and ignored: the picture
                 and the messages of cpfg's program
parameters       none; a file with these keys in words, as cpfg's program density reads it
numbers          "exact", or "cpfg"; exact: a is from -180 to 180; cpfg (the default with `parameters` and in .e
                 files): a is from 0 to 360, or 90 where nothing falls; the query itself adds nothing; m is a sixth of
                 the fall between the middle ones of the 36 places, 0.2 apart, unless one_point_value is true;
                 return_vector does nothing. That a turns towards +y is assumed: of cpfg's program only answers along x
                 are known

Time grows with the square of the number of queries. Statistics of a plant: mean, min, max of r, queries.
)",
     construct<Density>, true}};

}  // namespace
}  // namespace espalier::environment
