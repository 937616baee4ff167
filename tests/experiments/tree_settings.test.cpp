// The settings of the tree of `espalier tree`: each of them matters, and no values of theirs break it.
#include "espalier/language/model_settings.h"
#include "espalier/simulation/simulation.h"

#include "archive/meshes/surface_mesh.h"
#include "base/text.h"
#include "catch.h"
#include "experiments/growth.h"
#include "temporary_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

using namespace espalier;
using Catch::Contains;

namespace {

using Values = std::map<std::string, double>;

const std::vector<ModelSetting>& settings() {
    static const std::vector<ModelSetting> list = ModelSettings::read(source_path("models/colonization/tree.l")).list();
    return list;
}

/// The last frame of a tree, read back.
FrameGeometry grown(const Values& values, std::uint64_t seed = 1, std::size_t memory = 0) {
    SceneOptions options;
    options.seed = seed;
    for (const auto& [name, value] : values) {
        options.overrides.emplace_back("plant.0.define." + name, format_exact(value));
    }
    options.overrides.emplace_back("timeline.every", "1000000000");
    const TemporaryFolder folder;
    run(read_scene(source_path("environments/tree.toml"), options),
        {.output = folder.path() / "run", .memory = memory});
    const RecordedRun recorded(folder.path() / "run");
    return recorded.geometry(recorded.frames().back());
}

/// A small tree that has something of everything.
const Values small{{"AGE", 8},        {"LIFE", 8},        {"NODE_DISTANCE", 0.3}, {"DROOP", 0.5},
                   {"DROOP_FROM", 1}, {"FLOWERS", 20},    {"FRUITS", 20},         {"TRUNK_IN_CROWN", 0.3},
                   {"SMOOTHNESS", 2}, {"CUT_ABOVE", 0.1}, {"LEAF_TWIGS", 0.04}};

/// Values unlike the one at hand that the setting allows, those first whose effect is largest.
std::vector<double> other_values(const ModelSetting& setting, double value) {
    const double middle = std::isfinite(setting.highest) ? (setting.lowest + setting.highest) / 2 : value;
    std::vector<double> others{value + 1, value - 1, 1.6 * value, 0.4 * value, value + 0.3, setting.lowest, middle};
    std::erase_if(others, [&](double other) { return other == value || !setting.allows(other); });
    return others;
}

bool same(const FrameGeometry& a, const FrameGeometry& b) {
    const MeshOptions options{.sides = 3};
    const FrameMesh first = mesh_of(a, options), second = mesh_of(b, options);
    return first.points == second.points && first.triangles == second.triangles && first.rgb == second.rgb;
}

std::set<std::array<float, 3>> nodes(const FrameGeometry& geometry) {
    std::set<std::array<float, 3>> found;
    for (const FrameInternode& internode : internodes_of(geometry)) {
        found.insert({internode.tip.x, internode.tip.y, internode.tip.z});
    }
    return found;
}

bool is_finite(const FrameMesh& mesh) {
    const auto finite = [](const auto& point) { return std::isfinite(point.x + point.y + point.z); };
    return std::all_of(mesh.points.begin(), mesh.points.end(), finite) &&
           std::all_of(mesh.normals.begin(), mesh.normals.end(), finite);
}

/// Values over the whole range of every setting, and sometimes beyond.
class RandomValues {
public:
    explicit RandomValues(unsigned seed) : random_(seed) {}

    Values operator()() {
        Values values;
        for (const ModelSetting& setting : settings()) {
            if (chance(0.5)) values[setting.name] = value(setting);
        }
        // Many steps take long and find nothing that few do not.
        values["AGE"] = std::floor(uniform(1, 7));
        if (chance(0.1)) {
            const ModelSetting& setting =
                settings()[static_cast<std::size_t>(uniform(0, 1) * 0.999 * static_cast<double>(settings().size()))];
            values[setting.name] = chance(0.5) ? setting.highest * 1.5 + 1 : setting.lowest * 0.5 - 1;
        }
        return values;
    }

private:
    double uniform(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
    bool chance(double probability) { return uniform(0, 1) < probability; }

    /// Ends of ranges often; wide ranges by order of magnitude.
    double value(const ModelSetting& setting) {
        if (chance(0.1)) return setting.lowest;
        const bool wide = setting.highest > 50 * std::max(setting.lowest, 0.1);
        if (!wide && chance(0.1)) return setting.highest;
        const double low = std::max(setting.lowest, wide ? setting.highest * 1e-6 : setting.lowest);
        const double number =
            wide ? std::exp(uniform(std::log(low), std::log(setting.highest))) : uniform(low, setting.highest);
        return setting.whole ? std::clamp(std::round(number), setting.lowest, setting.highest) : number;
    }

    std::mt19937 random_;
};

/// Whether a message says which setting is to be changed, or that the memory does not suffice.
bool is_helpful(const std::string& message) {
    return message.find("memory") != std::string::npos ||
           std::any_of(settings().begin(), settings().end(),
                       [&](const ModelSetting& setting) { return message.find(setting.name) != std::string::npos; });
}

void grow_at_random(int trees) {
    RandomValues random(20190401);
    int grown_trees = 0;
    for (int i = 0; i < trees; ++i) {
        const Values values = random();
        INFO("tree " << i);
        for (const auto& [name, value] : values) UNSCOPED_INFO(name << " = " << value);
        try {
            const FrameGeometry geometry = grown(values, static_cast<std::uint64_t>(i), std::size_t{16} << 20);
            const FrameMesh mesh = mesh_of(geometry, {.sides = 3});
            REQUIRE(is_finite(mesh));
            ++grown_trees;
        } catch (const std::exception& error) {
            INFO(error.what());
            const bool is_expected = dynamic_cast<const UserError*>(&error) || dynamic_cast<const RunError*>(&error);
            REQUIRE(is_expected);
            REQUIRE(is_helpful(error.what()));
        }
    }
    CHECK(grown_trees > trees / 3);
}

}  // namespace

TEST_CASE("the tree has 39 settings, and each changes what is drawn", "[tree]") {
    CHECK(settings().size() == 39);
    const FrameGeometry before = grown(small);
    for (const ModelSetting& setting : settings()) {
        INFO(setting.name);
        const auto chosen = small.find(setting.name);
        const double value = chosen == small.end() ? setting.value : chosen->second;
        const std::vector<double> others = other_values(setting, value);
        CHECK(std::any_of(others.begin(), others.end(), [&](double other) {
            Values changed = small;
            changed[setting.name] = other;
            return !same(before, grown(changed));
        }));
    }
}

TEST_CASE("the tree of one age is a part of the tree that is older", "[tree]") {
    // The roots of a foot grow thicker with the stem, so their nodes move.
    const Values young{{"AGE", 14}, {"SMOOTHNESS", 1}, {"ROOTS", 0}}, old{{"AGE", 15}, {"SMOOTHNESS", 1}, {"ROOTS", 0}};
    const auto before = nodes(grown(young)), after = nodes(grown(old));
    CHECK(before.size() > 50);
    CHECK(after.size() > before.size());
    CHECK(std::includes(after.begin(), after.end(), before.begin(), before.end()));
    CHECK(nodes(grown(young, 2)) != before);
}

TEST_CASE("settings at random grow a mesh of finite numbers, or name the setting to be changed", "[tree]") {
    grow_at_random(300);
}

TEST_CASE("ten thousand settings at random grow a mesh of finite numbers, or name the setting to be changed",
          "[.][random-trees]") {
    grow_at_random(10000);
}
