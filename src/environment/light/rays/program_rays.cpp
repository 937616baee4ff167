#include "environment/light/rays/program_rays.h"

#include "espalier/base/math.h"

#include "environment/light/rays/light_paths.h"
#include "environment/light/rays/ray_program.h"
#include "geometry/drawn/faces.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

namespace espalier::environment {
namespace {

using std::numbers::pi;
using Corners = LitTriangles::Corners;

/// Makes the side of a direction the front of all triangles, which lie in a plane.
void turn_to(const glm::dvec3& front, std::vector<Corners>& triangles) {
    const auto& [a, b, c] = triangles.front();
    if (glm::dot(glm::cross(b - a, c - a), front) >= 0) return;
    for (Corners& corners : triangles) std::swap(corners[1], corners[2]);
}

/// A shape in the frame of the turtle that asks, its corners in the plane of left and heading.
std::vector<Corners> flat(const Pose& pose, std::initializer_list<std::array<double, 2>> corners) {
    std::vector<glm::dvec3> places;
    for (const auto& [left, ahead] : corners) {
        places.push_back(pose.position + left * pose.left + ahead * pose.heading);
    }
    std::vector<Corners> triangles;
    for (std::size_t i = 1; i + 1 < places.size(); ++i) triangles.push_back({places[0], places[i], places[i + 1]});
    turn_to(pose.up, triangles);
    return triangles;
}

std::vector<Corners> prism(const Pose& pose, double width, double length, int sides) {
    std::vector<Corners> triangles;
    const auto corner = [&](int k, double ahead) {
        const auto [sine, cosine] = math::sine_and_cosine(2 * pi * k / sides);
        return pose.position + ahead * pose.heading + width / 2 * (cosine * pose.left + sine * pose.up);
    };
    for (int k = 0; k < sides; ++k) {
        const glm::dvec3 a = corner(k, 0), b = corner(k + 1, 0), c = corner(k + 1, length), d = corner(k, length);
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
    }
    turn_to(corner(0, 0) + corner(1, 0) - 2.0 * pose.position, triangles);
    return triangles;
}

double area_of(const std::vector<Corners>& triangles) {
    double area = 0;
    for (const auto& [a, b, c] : triangles) area += 0.5 * glm::length(glm::cross(b - a, c - a));
    return area;
}

class ProgramRays final : public EnvironmentProcess {
public:
    ProgramRays(const Settings& settings, const EnvironmentContext& context)
        : program_(settings, context),
          place_(settings.place("parameters")),
          warnings_(context.warnings),
          seed_(context.seed),
          memory_(context.memory),
          paths_(program_.optics(), {}, options()) {}

    void answer(const WorldView& world, Queries queries, std::span<Answer> answers, Fields&) override {
        collect(world, queries);
        require_memory();
        trace(world.step);
        for (const Object& object : objects_) {
            if (!object.answers) continue;
            const Answer answer = answers[object.query];
            for (std::size_t b = 0; b < std::min(answer.size(), program_.bands()); ++b) answer[b] = light_on(object, b);
        }
    }

    std::pair<int, int> query_arity() const override { return {0, 64}; }
    Spreading spreading() const override { return Spreading::plants; }
    void limit_memory(std::size_t bytes) override { memory_ = bytes; }

private:
    struct Object {
        std::size_t query, first;   ///< the slot of its first polygon
        std::vector<double> areas;  ///< of each
        bool answers;
    };

    LightPaths::Options options() const {
        LightPaths::Options options;
        // These programs know no soil. Beneath a stand without an edge light ends, or it would pass ever more periods.
        options.ground = program_.periodic() ? program_.domain()->lower.y : -1e9;
        options.residual = 1e-4;
        options.evenly = program_.evenly();
        options.depth = program_.depth();
        options.only_scattered = program_.only_scattered();
        if (program_.periodic()) options.period = program_.domain();
        return options;
    }

    void warn_once(const std::string& message) {
        if (warned_.insert(message).second && warnings_) {
            warnings_->push_back({Diagnostic::Severity::warning, place_, message});
        }
    }

    void collect(const WorldView& world, Queries queries) {
        objects_.clear();
        corners_.clear();
        owners_.clear();
        slots_ = 0;
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const PlantView* const plant = plant_of(world, queries[i].plant);
            if (!plant || queries[i].following == no_letter) continue;
            add(i, queries[i], *plant);
        }
        faces_of_plant_.clear();
        triangles_.clear();
        triangles_.add(corners_, owners_);
    }

    static const PlantView* plant_of(const WorldView& world, std::uint32_t number) {
        for (const PlantView& plant : world.plants) {
            if (plant.plant == number) return &plant;
        }
        return nullptr;
    }

    void add(std::size_t number, const Query& query, const PlantView& plant) {
        const std::string& symbol = plant.model->alphabet.name(query.following);
        const std::span<const double> given = query.following_parameters;
        const bool answers = !query.parameters.empty() && query.parameters[0] >= 0;
        if (symbol == "Q" || symbol == "J") {
            return warn_once(fmt::format("a module {} behind a query changes neither rays nor sky here", symbol));
        }
        std::size_t materials = 0;  // the parameter of the top's
        std::vector<std::vector<Corners>> polygons;
        if (symbol == "T" && given.size() >= 2) {
            polygons.push_back(flat(query.pose, {{-given[0], 0}, {given[0], 0}, {0, given[1]}}));
            materials = 3;
        } else if (symbol == "P" && given.size() >= 2) {
            const double half = given[1] / 2;
            polygons.push_back(flat(query.pose, {{0, 0}, {given[0], half}, {0, given[1]}, {-given[0], half}}));
            materials = 3;
        } else if (symbol == "U" && given.size() >= 4) {
            polygons.push_back(slanted(query.pose, given));
            materials = 5;
        } else if (symbol == "I" && given.size() >= 2) {
            polygons.push_back(prism(query.pose, given[0], given[1], program_.cylinder_sides()));
        } else {
            polygons = drawn_by(plant, query.module + 1);
            materials = program_.material_parameter();
        }
        add(number, answers, polygons, material_of(given, materials));
    }

    /// U(l1, l2, h, beta): a triangle whose base goes through the turtle at an angle.
    std::vector<Corners> slanted(const Pose& pose, std::span<const double> given) {
        const double one = std::max(given[0], 0.001), other = std::max(given[1], 0.001), ahead = given[2];
        if (ahead <= 1e-4 || given[0] + given[1] <= 1e-4 || std::abs(given[3]) > 90) {
            warn_once(
                "a triangle U(l1, l2, h, beta) needs l1 + l2 and h above 0.0001, and beta from -90 to 90: it is "
                "answered 0");
            return {};
        }
        const auto [sine, cosine] = math::sine_and_cosine(glm::radians(given[3]));
        return flat(pose, {{-one * sine, -one * cosine}, {other * sine, other * cosine}, {0, ahead}});
    }

    /// Sides by the numbers of the parameter file; `at`: which parameter is the top's, from 1.
    std::uint16_t material_of(std::span<const double> given, std::size_t at) const {
        if (at == 0 || given.size() < at) return program_.material(program_.default_top(), program_.default_bottom());
        return program_.material(given[at - 1], given.size() > at ? given[at] : given[at - 1]);
    }

    std::vector<std::vector<Corners>> drawn_by(const PlantView& plant, std::uint32_t module) {
        std::vector<std::vector<Corners>> polygons;
        const auto [at, is_new] = faces_of_plant_.try_emplace(plant.plant);
        auto& [faces, of_module] = at->second;
        if (is_new) {
            faces.add_leaves(plant.plant, plant.drawn());
            for (std::size_t i = 0; i < faces.size(); ++i) of_module[faces[i].owner.module].push_back(i);
        }
        for (const std::size_t i : of_module[module]) {
            std::vector<Corners>& polygon = polygons.emplace_back();
            faces[i].for_triangles([&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
                polygon.push_back({a, b, c});
            });
        }
        return polygons;
    }

    void add(std::size_t query, bool answers, const std::vector<std::vector<Corners>>& polygons,
             std::uint16_t material) {
        Object object{query, slots_, {}, answers};
        for (const std::vector<Corners>& polygon : polygons) {
            if (is_lost(polygon)) continue;
            object.areas.push_back(area_of(polygon));
            for (const Corners& corners : polygon) {
                corners_.push_back(corners);
                owners_.push_back({static_cast<std::uint32_t>(slots_), material, LitKind::leaf});
            }
            ++slots_;
        }
        objects_.push_back(std::move(object));
    }

    /// Outside of the programs' domain.
    bool is_lost(const std::vector<Corners>& polygon) {
        if (!program_.domain() || program_.periodic()) return false;
        const Box& domain = *program_.domain();
        for (const Corners& corners : polygon) {
            for (const glm::dvec3& corner : corners) {
                if (glm::clamp(corner, domain.lower, domain.upper) == corner) return false;
            }
        }
        warn_once("objects outside of 'domain size' and 'position' are lost, as MonteCarlo loses them");
        return true;
    }

    void require_memory() const {
        constexpr double bytes_per_triangle = 400;
        const double bytes = bytes_per_triangle * static_cast<double>(corners_.size());
        if (bytes <= static_cast<double>(memory_)) return;
        throw RunError(fmt::format("{} triangles to light take {:.1g} GB: ask for fewer or give more memory",
                                   corners_.size(), bytes / 1e9));
    }

    void trace(int step) {
        if (triangles_.size() == 0) return;
        const std::vector<double> factors(program_.bands(), 1);
        paths_.set(triangles_, slots_, program_.light(), {}, 0, factors);
        const Box& bounds = triangles_.bounds();
        const double across = bounds.empty() ? 0 : glm::length(bounds.upper - bounds.lower);
        paths_.trace(program_.paths(across * across),
                     static_cast<std::uint32_t>(mix(seed_, static_cast<std::uint64_t>(step))));
    }

    double light_on(const Object& object, std::size_t band) const {
        const double area = std::accumulate(object.areas.begin(), object.areas.end(), 0.0);
        if (!(area > 0)) return 0;
        const char returned = program_.returned(band);
        double sum = 0, by_area = 0;
        for (std::size_t i = 0; i < object.areas.size(); ++i) {
            const std::size_t slot = object.first + i;
            const double met = returned == 'U'   ? paths_.front(slot, band)
                               : returned == 'L' ? paths_.back(slot, band)
                                                 : paths_.absorbed(slot, band);
            sum += met;
            by_area += met * object.areas[i];
        }
        const double unit = paths_.light() * program_.weight(band);
        if (returned == 'F') return unit * by_area / area;  // the mean of its polygons, by their areas
        return std::min(unit * sum / area, program_.weight(band));
    }

    RayProgram program_;
    Place place_;
    std::vector<Diagnostic>* warnings_;
    std::uint64_t seed_;
    std::size_t memory_;
    LightPaths paths_;
    std::set<std::string> warned_;

    std::vector<Object> objects_;  ///< all that follows is of this step
    std::vector<Corners> corners_;
    std::vector<LitTriangles::Owner> owners_;
    std::size_t slots_ = 0;
    LitTriangles triangles_;
    std::map<std::uint32_t, std::pair<DrawnFaces, std::map<std::uint32_t, std::vector<std::size_t>>>> faces_of_plant_;
};

}  // namespace

std::unique_ptr<EnvironmentProcess> make_program_rays(Settings& settings, const EnvironmentContext& context) {
    return std::make_unique<ProgramRays>(settings, context);
}

const std::string& program_rays_help() {
    static const std::string text =
        R"(With `parameters`, ray-light answers as cpfg's programs QuasiMC, MonteCarlo and radiosity do; nothing above is read then:
parameters    none; the program's parameter file
program       "QuasiMC": whose file it is; or "MonteCarlo", "radiosity"

A query asks for the module that follows: T(a, b), a triangle of base 2a across and height b ahead; P(a, b), a rhombus with
the diagonals b ahead and 2a across; U(l1, l2, h, beta), a triangle with a slanted base; I(d, l), an open prism; any other
module is what it draws. Behind the sizes of T, P and U may stand the numbers of the materials of top and bottom. The
answer has a value for each wavelength: light is 1 on a plane across its direction, times the weight of the source
spectrum. If the first parameter of the query is below 0, the object shades and gets no answer.
)";
    return text;
}

}  // namespace espalier::environment
