// Grows models and scenes, and prints digests of all that they are after some steps: compiled for this machine and for
// pages, its lines are compared by `./dev web --check`.
//
//     same_bytes STEPS FILE...     a line a file: its strings, what is drawn, its fields and measures, or why it does
//     not grow
#include "espalier/base/read_log.h"
#include "espalier/base/stop.h"
#include "espalier/simulation/world.h"

#include "app/look/studio_documents.h"
#include "base/reason.h"
#include "geometry/grid_operations.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <span>

namespace espalier {
namespace {

/// Bits of numbers, one after the other.
class Digest {
public:
    template <class Value>
    void add(const Value& value) {
        add_all(std::span(&value, 1));
    }
    template <class Values>
    void add_all(const Values& values) {
        const auto* bytes = reinterpret_cast<const char*>(std::data(values));
        sum_ = digest(std::string_view(bytes, std::size(values) * sizeof *std::data(values)), sum_);
    }
    std::uint64_t sum() const { return sum_; }

private:
    std::uint64_t sum_ = digest("");
};

std::uint64_t strings_of(const World& world) {
    Digest all;
    for (std::size_t plant = 0; plant < world.size(); ++plant) {
        const ModuleString& string = world.string(plant);
        all.add_all(string.letters);
        all.add_all(string.parameters);
        for (std::size_t i = 0; string.has_lineage() && i < string.size(); ++i) all.add(string.identity(i));
    }
    return all.sum();
}

void add(const glm::dvec3& place, Digest& all) {
    for (int axis = 0; axis < 3; ++axis) all.add(place[axis]);
}

std::uint64_t drawn_of(const World& world) {
    Digest all;
    for (std::size_t plant = 0; plant < world.size(); ++plant) {
        const PlantGeometry& drawn = world.interpretation(plant).geometry;
        for (const Internode& one : drawn.internodes) {
            add(one.base, all);
            add(one.tip, all);
            all.add(one.base_radius);
            all.add(one.tip_radius);
            all.add(one.colour);
        }
        for (const glm::dvec3& vertex : drawn.vertices) add(vertex, all);
        for (const Organ& organ : drawn.organs) {
            add(organ.pose.position, all);
            add(organ.pose.heading, all);
            add(organ.pose.left, all);
            add(organ.size, all);
        }
    }
    return all.sum();
}

std::uint64_t fields_of(const World& world) {
    Digest all;
    for (const auto& [name, field] : world.environment().fields().all()) {
        Field now = field;
        if (now.current) now.grid = now.current();
        if (!now.grid) continue;
        const geometry::DenseField dense = geometry::grid_operations().dense(now);
        all.add_all(name);
        for (int axis = 0; axis < 3; ++axis) all.add(dense.size[axis]);
        add(dense.origin, all);
        all.add_all(dense.values);
    }
    return all.sum();
}

std::uint64_t measures_of(const World& world) {
    Digest all;
    for (const PlantFrame& plant : world.frame().plants) {
        for (const Quantity& quantity : plant.quantities) {
            all.add_all(quantity.name);
            if (!std::isnan(quantity.value)) all.add(quantity.value);  // whose bits are the processor's
        }
    }
    return all.sum();
}

std::string grown(const std::string& file, int steps) {
    const Scene scene = app::read_opened({std::filesystem::absolute(file).lexically_normal(), {}, {}});
    app::require_no_programs(scene);
    WorldOptions options;
    options.printout = std::make_shared<Printout>([](const std::string&) {});
    World world(scene, options);
    world.start();
    while (world.steps_done() < steps && !world.at_end()) world.step();
    return fmt::format("step {} modules {} strings {:016x} drawn {:016x} fields {:016x} measures {:016x}",
                       world.steps_done(), world.modules(), strings_of(world), drawn_of(world), fields_of(world),
                       measures_of(world));
}

void print_line(const std::string& file, int steps) {
    std::string line;
    try {
        line = grown(file, steps);
    } catch (const std::exception& error) {
        const std::string why = reason_of(error);
        line = "refused " + why.substr(0, why.find('\n'));
    }
    fmt::print("{} {}\n", file, line);
    std::fflush(stdout);
}

}  // namespace
}  // namespace espalier

int main(int count, char** words) {
    const std::span arguments(words, static_cast<std::size_t>(count));
    if (count < 3) return 1;
    for (const char* file : arguments.subspan(2)) espalier::print_line(file, std::atoi(arguments[1]));
}
