// Hydraulic lift: roots carry water from wet soil to dry soil at night.
#include "catch.h"
#include "experiments/roots.h"

using namespace espalier;

namespace {

struct Day {
    double gained_at_night = 0, lost_by_day = 0;  ///< by the dry soil above 10 cm, cm3
};

double dry_water(const World& world) {
    const auto field = world.environment().fields().need("water").grid;
    double sum = 0;
    for (auto voxel = field->grid->cbeginValueOn(); voxel; ++voxel) {
        if (field->grid->indexToWorld(voxel.getCoord()).y() > -0.1) sum += 8.0 * *voxel;  // voxels of 8 cm3
    }
    return sum;
}

/// From 18 to 6 o'clock, and from 6 to 18, of the last three days.
std::vector<Day> days_of(const std::string& scene, std::uint64_t seed) {
    SceneOptions options;
    options.seed = seed;
    const Scene read = read_scene(source_path("environments/" + scene), options);
    World world(read);
    world.start();
    std::vector<double> water{dry_water(world)};  // eight steps a day
    while (!world.at_end()) {
        world.step();
        water.push_back(dry_water(world));
    }
    std::vector<Day> days;
    for (std::size_t day = 7; day < 10; ++day) {
        const double evening = water[8 * day + 6], morning = water[8 * day + 10], next = water[8 * day + 14];
        days.push_back({morning - evening, morning - next});
    }
    return days;
}

}  // namespace

TEST_CASE("hydraulic lift: roots water the dry soil at night; roots that do not conduct leave it to capillarity",
          "[hydraulic-lift]") {
    const std::vector<Day> without = days_of("hydraulic-lift-off.toml", 1);
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        const std::vector<Day> with = days_of("hydraulic-lift.toml", seed);
        for (std::size_t day = 0; day < with.size(); ++day) {
            INFO("seed " << seed << ", night " << day + 7 << ": " << with[day].gained_at_night << " cm3, by day lost "
                         << with[day].lost_by_day << "; control " << without[day].gained_at_night);
            CHECK(with[day].gained_at_night > 1);
            CHECK(std::abs(without[day].gained_at_night) < 0.1 * with[day].gained_at_night);
            CHECK(with[day].lost_by_day > 0);
        }
    }
}
