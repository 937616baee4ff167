// The shade followed from step to step is the shade summed anew, to the last bit: of sums, answers and grids.
#include "environment/light/shade/field.h"

#include "espalier/base/error.h"
#include "espalier/geometry/openvdb_grid.h"

#include "catch.h"
#include "environment/exchange/exchange_plants.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>

using namespace espalier;
using namespace espalier::environment;

namespace {

/// A crown that changes from step to step: organs move, die, are born, change their strength.
class ChangingCrown {
public:
    ChangingCrown(std::uint64_t seed, int count, double width)
        : samples_({seed, 1, Stream::process}, 3, 4), width_(width) {
        for (int i = 0; i < count; ++i) organs_.push_back(organ());
    }

    const std::vector<Asked>& organs() const { return organs_; }

    void change(double part) {
        std::vector<Asked> next;
        for (const Asked& old : organs_) {
            const double fate = samples_.uniform();
            if (fate < 0.25 * part) continue;                                       // dies
            if (fate > 1 - 0.25 * part) next.push_back(organ());                    // something is born beside it
            next.push_back(fate > 0.5 * (1 - part) && fate < 0.5 ? organ() : old);  // moves
        }
        organs_ = next;
    }
    void lose(std::size_t from, std::size_t count) {
        const auto begin = organs_.begin() + static_cast<std::ptrdiff_t>(from);
        organs_.erase(begin, begin + static_cast<std::ptrdiff_t>(std::min(count, organs_.size() - from)));
    }
    void leave(const glm::dvec3& by) {
        for (Asked& asked : organs_) asked.position += by;
    }

private:
    Asked organ() {
        const glm::dvec3 place(samples_.uniform(), samples_.uniform(), samples_.uniform());
        const double strength = samples_.uniform() < 0.2 ? 0 : samples_.uniform() < 0.7 ? 1 : samples_.uniform();
        return {(place - 0.5) * width_, {strength, 0, 0, 0}};
    }

    RandomSamples samples_;
    double width_;
    std::vector<Asked> organs_;
};

std::vector<double> asked(Environment& environment, const std::vector<Asked>& questions) {
    AskingPlants plants;
    plants.add(questions).exchange(environment);
    return plants.parameters();
}

bool same_bytes(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// "" if files would hold the same: values, active voxels, nodes, and the box that a viewer is shown.
std::string difference(const FieldGrid& a, const FieldGrid& b) {
    const openvdb::FloatTree &one = a.grid->tree(), &other = b.grid->tree();
    if (a.box != b.box) return "box";
    if (one.background() != other.background()) return "background";
    if (a.grid->transform().mapType() != b.grid->transform().mapType()) return "transform";
    if (one.nodeCount() != other.nodeCount()) return "nodes";
    if (!one.hasSameTopology(other)) return "topology";
    for (auto leaf = one.cbeginLeaf(); leaf; ++leaf) {
        const auto* same = other.probeConstLeaf(leaf->origin());
        if (same == nullptr || leaf->valueMask() != same->valueMask()) return "active voxels";
        const float *values = leaf->buffer().data(), *others = same->buffer().data();
        if (std::memcmp(values, others, leaf->SIZE * sizeof(float)) != 0) return "values";
    }
    return "";
}

std::string difference(const Environment& a, const Environment& b) {
    for (const char* name : {"light", "light.shade"}) {
        const std::string found = difference(*a.fields().need(name).grid, *b.fields().need(name).grid);
        if (!found.empty()) return std::string(name) + ": " + found;
    }
    return "";
}

const std::string plain =
    "[light]\nprocess = \"voxel-shade\"\nvoxel = 1\nstrength = 0.25\ndissipation = 1.7\ndepth = 5\n";
const std::vector<std::string> scenes{
    plain,
    plain + "mode = \"attenuate\"\nsampling = \"nearest\"\n",
    plain + "spread = 0.4\n",
    plain + "dimensions = 2\n",
    "[light]\nprocess = \"voxel-shade\"\nvoxel = 1\nstrength = 40000\ndepth = 5\nfull_light = 2e5\n",  // 2^52 steps
    plain + "domain = { lower = [-13, -9, -11], upper = [10, 12, 14] }\n",
    plain + "periodic = true\ndomain = { lower = [-6.5, -9, -5], upper = [6.5, 12, 5] }\n",
    plain + "periodic = true\ndimensions = 2\ndomain = { lower = [-2.5, -9, -5], upper = [2.5, 12, 5] }\n",
};

}  // namespace

TEST_CASE("a pyramid's sum in every voxel is what its pyramids add there one by one", "[environment]") {
    for (const bool flat : {false, true}) {
        for (const double spread : {0.0, 0.5, 1.0, 1.7}) {
            ShadeRule rule;
            rule.flat = flat;
            rule.spread = spread;
            const VoxelBox clip{{-9, -20, -40}, {21, 6, 12}};
            ShadeCasts casts(rule, clip);
            ShadeField field(std::size_t(1) << 30);
            RandomSamples samples({7, 0, Stream::process}, 1, 1);
            casts.begin_step();
            for (int i = 0; i < 300; ++i) {
                const glm::dvec3 at(samples.uniform() * 50 - 20, samples.uniform() * 30 - 20,
                                    samples.uniform() * 70 - 45);
                casts.add(flat ? glm::ivec3(at.x, at.y, 0) : glm::ivec3(at), i % 3 == 0 ? 1 : samples.uniform());
            }
            REQUIRE(field.show(casts));
            int wrong = 0, shaded = 0;
            for (int x = -20; x <= 30; ++x) {
                for (int y = -30; y <= 12; ++y) {
                    for (int z = -50; z <= 30; ++z) {
                        Shade sum = 0;
                        for (const ShadeCast& cast : casts.casts()) sum += casts.at(cast, {x, y, z});
                        if (!clip.has({x, y, z})) sum = 0;
                        wrong += field.at({x, y, z}) != sum;
                        shaded += sum != 0;
                    }
                }
            }
            CHECK(wrong == 0);
            CHECK(shaded > 100);
        }
    }
}

TEST_CASE("shade followed through births, deaths and moves is the shade summed anew", "[environment]") {
    for (const std::string& scene : scenes) {
        for (const std::uint64_t seed : {1, 2, 3}) {
            ChangingCrown crown(seed, 400, 20);
            Environment followed = environment_of(scene);
            int wrong = 0;
            for (int step = 0; step < 24; ++step) {
                if (step % 8 == 5) crown.lose(50, 30 + 10 * std::size_t(step));
                if (step == 11 || step == 20) crown.leave({step, 2, -3});
                if (step % 3 != 1) crown.change(step % 7 == 0 ? 0.8 : 0.01);
                Environment anew = environment_of(scene);
                wrong += !same_bytes(asked(followed, crown.organs()), asked(anew, crown.organs()));
                if (step % 4 != 0) CHECK(difference(followed, anew) == "");
            }
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("a few changes are followed without a rebuild", "[environment]") {
    ShadeCasts casts((ShadeRule()), {glm::ivec3(-1000), glm::ivec3(1000)});
    ShadeField field(std::size_t(1) << 30);
    RandomSamples samples({3, 0, Stream::process}, 1, 1);
    std::vector<glm::ivec3> apices;
    for (int i = 0; i < 2000; ++i)
        apices.emplace_back(samples.uniform() * 60, samples.uniform() * 60, samples.uniform() * 60);
    const auto show = [&] {
        casts.begin_step();
        for (const glm::ivec3& apex : apices) casts.add(apex, 1);
        return field.show(casts);
    };
    CHECK(show());
    field.bricks().forget_changes();
    CHECK(!show());
    CHECK(field.bricks().changed().empty());
    apices[1000] += glm::ivec3(1, 0, 0);
    apices.insert(apices.begin() + 7, glm::ivec3(30, 30, 30));
    apices.erase(apices.begin() + 1500);
    CHECK(show());
    CHECK(field.bricks().changed().size() > 2);
    CHECK(field.bricks().changed().size() < 4 * 18);  // at most 18 bricks around a pyramid, of some 700
}

TEST_CASE("whoever keeps a grid of shade keeps its values", "[environment]") {
    ChangingCrown crown(5, 200, 15);
    Environment environment = environment_of(plain), first = environment_of(plain);
    asked(environment, crown.organs());
    asked(first, crown.organs());
    const std::shared_ptr<const FieldGrid> kept = environment.fields().need("light").grid;
    const FieldGrid* shade = environment.fields().need("light.shade").grid.get();
    crown.change(0.5);
    asked(environment, crown.organs());
    CHECK(environment.fields().need("light").grid != kept);
    CHECK(environment.fields().need("light.shade").grid.get() == shade);  // nobody kept that one
    CHECK(difference(*kept, *first.fields().need("light").grid) == "");
    Environment second = environment_of(plain);
    asked(second, crown.organs());
    CHECK(difference(environment, second) == "");
}

TEST_CASE("grids that nobody asked for in many steps take no memory, and are whole when they are asked for",
          "[environment]") {
    ChangingCrown crown(11, 300, 20);
    Environment environment = environment_of(plain);
    asked(environment, crown.organs());
    const FieldGrid* light = environment.fields().need("light").grid.get();
    const openvdb::FloatTree& tree = light->grid->tree();
    for (int step = 0; step < 8; ++step) {
        CHECK(tree.leafCount() > 0);
        crown.change(step % 2 == 0 ? 0.02 : 0.5);  // brick by brick, and all again
        asked(environment, crown.organs());
    }
    CHECK(tree.leafCount() == 0);
    for (int step = 0; step < 3; ++step) {
        Environment fresh = environment_of(plain);
        asked(fresh, crown.organs());
        CHECK(difference(environment, fresh) == "");
        CHECK(environment.fields().need("light").grid.get() == light);
        crown.change(0.02);
        asked(environment, crown.organs());
    }
}

TEST_CASE("fields of shade are the same with 1, 2 and 8 threads", "[environment]") {
    const auto run = [](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        auto environment = std::make_unique<Environment>(environment_of(plain));
        ChangingCrown crown(9, 3000, 60);
        for (int step = 0; step < 4; ++step) {
            crown.change(step == 2 ? 0.9 : 0.01);
            asked(*environment, crown.organs());
        }
        environment->fields().all();
        return environment;
    };
    const auto one = run(1);
    CHECK(difference(*one, *run(2)) == "");
    CHECK(difference(*one, *run(8)) == "");
}

TEST_CASE("pyramids count for the memory that the shade may take, not only their bricks", "[environment]") {
    std::vector<Asked> questions(200'000, Asked{glm::dvec3(0), {1}});
    EnvironmentContext context;
    context.memory = std::size_t(4) << 20;  // 18 bricks fit easily
    Environment small = environment_of(plain, context);
    const std::string message = message_of([&] { asked(small, questions); });
    CHECK(lacks(message, {"the shade of this step needs", "MiB"}) == "");
    questions.resize(100);
    Environment enough = environment_of(plain, context);
    CHECK(message_of([&] { asked(enough, questions); }) == "");
}

TEST_CASE("heights between pyramids count for the memory, too", "[environment]") {
    const std::vector<Asked> questions{Asked{glm::dvec3(0), {1}}, Asked{glm::dvec3(0, 1e6, 0), {1}}};
    const auto grown_within = [&](std::size_t mebibytes) {
        EnvironmentContext context;
        context.memory = mebibytes << 20;
        Environment environment = environment_of(plain, context);
        return message_of([&] { asked(environment, questions); });
    };
    CHECK(lacks(grown_within(14), {"the shade of this step needs", "MiB"}) == "");
    CHECK(grown_within(64) == "");
}

TEST_CASE("two plants far apart take the memory of two plants", "[environment]") {
    EnvironmentContext context;
    context.memory = std::size_t(24) << 20;  // a box around both would take 5 GiB
    Environment environment = environment_of(plain, context);
    ChangingCrown here(1, 100, 10), there(2, 100, 10);
    there.leave({900, 0, 900});
    for (int step = 0; step < 3; ++step) {
        std::vector<Asked> both = here.organs();
        both.insert(both.end(), there.organs().begin(), there.organs().end());
        Environment anew = environment_of(plain, context);
        CHECK(same_bytes(asked(environment, both), asked(anew, both)));
        CHECK(difference(environment, anew) == "");
        here.change(0.05);
        there.leave({-300, 5, 100});
    }
}
