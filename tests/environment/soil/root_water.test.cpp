// root-water in a soil, as a scene has them.
#include "catch.h"
#include "environment/soil/linear/soil.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <deque>
#include <numbers>

namespace espalier::test {
namespace {

/// A soil with roots that are drawn by hand.
struct RootedSoil {
    RootedSoil(const std::string& soil, const std::string& roots, bool warns = false)
        : water(soil, context_with(warns ? &warnings : nullptr)) {
        context.warnings = warns ? &warnings : nullptr;
        context.name = "roots";
        context.plants = 2;
        Settings settings = Settings::parse_toml(roots, "roots.toml");
        process = registered<ProcessType>().at("root-water")->make(settings, context, water.fields);
        settings.reject_unread();
    }

    /// A straight root from (x, 0, z) downwards, m.
    void add_root(double x, double z, double length, double radius = 0.001, int internodes = 4) {
        PlantGeometry& geometry = interpretations.emplace_back().geometry;
        ModuleString& string = strings.emplace_back();
        for (int i = 0; i < internodes; ++i) {
            const double from = length * i / internodes, to = length * (i + 1) / internodes;
            geometry.internodes.push_back(
                {static_cast<std::uint32_t>(i), 0, 0, 0, 0, {x, -from, z}, {x, -to, z}, radius, radius});
            string.append(model.alphabet.letter("F", 0), {});
        }
        geometry.axes = 1;
        views.clear();
        for (std::size_t i = 0; i < strings.size(); ++i) {
            views.push_back({static_cast<std::uint32_t>(i), &model, &strings[i], &interpretations[i], true});
        }
    }

    void step(double dt = 1) {
        water.world.plants = views;
        water.advance(dt);
        process->advance(water.world, {}, water.fields);
        water.ask({});
        process->answer(water.world, {}, {}, water.fields);
    }

    double quantity(const std::string& name, std::uint32_t plant = 0) const {
        for (const Quantity& quantity : process->statistics(plant)) {
            if (quantity.name == name) return quantity.value;
        }
        throw RunError("no quantity " + name);
    }

    static EnvironmentContext context_with(std::vector<Diagnostic>* warnings) {
        EnvironmentContext context;
        context.warnings = warnings;
        return context;
    }

    std::vector<Diagnostic> warnings;
    Soil water;
    EnvironmentContext context;
    Model model;
    std::deque<ModuleString> strings;
    std::deque<Interpretation> interpretations;
    std::vector<PlantView> views;
    std::unique_ptr<EnvironmentProcess> process;
};

std::string pot(double voxel, const std::string& rest) {
    return fmt::format(
               "model = \"richards\"\ndomain = {{ lower = [-0.04, -0.24, -0.04], upper = [0.04, 0, 0.04] }}\nvoxel = "
               "{}\n",
               voxel) +
           rest;
}

const std::string drinks = "radial = 1.73e-4\naxial = 0.0432\n";
constexpr double area = 8 * 8;  // cm2

}  // namespace

TEST_CASE("in wet soil a plant transpires its demand, and the soil loses as much", "[environment][roots]") {
    RootedSoil pair(pot(0.02, "soil = \"loam\"\ninitial = { head = -100 }\n"),
                    drinks + "collar = { transpiration = 0.5 }\n");
    pair.add_root(0, 0, 0.2);
    for (int day = 0; day < 3; ++day) {
        pair.step();
        CHECK(pair.quantity("transpiration") == Approx(0.5).epsilon(1e-6));
        CHECK(pair.quantity("demand") == Approx(0.5));
    }
    CHECK(pair.quantity("total") == Approx(1.5).epsilon(1e-6));
    CHECK(pair.water.quantity("drunk") == Approx(10 * pair.quantity("total") / area).epsilon(1e-9));
    CHECK(std::abs(pair.water.quantity("balance")) < 1e-9);
    CHECK(pair.quantity("collar") < -100);
    CHECK(pair.quantity("depth") > 2);
    CHECK(pair.quantity("depth") < 15);
}

TEST_CASE("Krs is that of one root in closed form", "[environment][roots]") {
    RootedSoil pair(pot(0.02, "soil = \"loam\"\n"), drinks + "collar = { head = -500 }\n");
    pair.add_root(0.01, 0.01, 0.2);
    pair.step(0.01);
    const double around = 2 * std::numbers::pi * 0.1, tau = std::sqrt(around * 1.73e-4 / 0.0432);
    CHECK(pair.quantity("conductance") == Approx(0.0432 * tau * std::tanh(20 * tau)).epsilon(1e-9));
    CHECK(std::isnan(pair.quantity("demand")));
}

TEST_CASE("as the soil dries the collar falls to its limit, and transpiration below the demand",
          "[environment][roots]") {
    RootedSoil pair(pot(0.02, "soil = \"loam\"\ninitial = { head = -300 }\n"),
                    drinks + "collar = { transpiration = 25, limit = -15000 }\n");
    for (const double z : {-0.03, -0.01, 0.01, 0.03}) pair.add_root(0.01, z, 0.23, 0.002);
    double before = 0;
    bool stressed = false;
    for (int day = 0; day < 12; ++day) {
        pair.step();
        CHECK(pair.quantity("collar") > -15000.01);
        const double now = pair.quantity("transpiration");
        if (stressed) CHECK(now < before + 1e-9);
        stressed = stressed || now < 0.99 * pair.quantity("demand");
        before = now;
    }
    CHECK(stressed);
    CHECK(pair.quantity("collar") == Approx(-15000));
    CHECK(std::abs(pair.water.quantity("balance")) < 1e-9);
}

TEST_CASE("at night roots lift water from wet to dry soil", "[environment][roots]") {
    RootedSoil pair(
        pot(0.02,
            "soil = \"loam\"\ninitial = { head = -3000 }\nlayers = [{ top = -0.12, initial = { head = -50 } }]\n"),
        "radial = 1e-3\naxial = 5\ncollar = { transpiration = 2, by_day = true }\n");
    pair.add_root(0.01, 0.01, 0.22, 0.002);
    pair.step(0.25);  // midnight to sunrise
    const FieldGrid& uptake = *pair.water.fields.need("roots").current();
    CHECK(pair.quantity("transpiration") == Approx(0).margin(1e-9));
    CHECK(uptake.grid->tree().getValue(openvdb::Coord(2, 11, 2)) < 0);  // the top gets water
    CHECK(uptake.grid->tree().getValue(openvdb::Coord(2, 1, 2)) > 0);
    pair.step(0.5);  // the day, in which all of the 2 cm3 go
    CHECK(pair.quantity("transpiration") == Approx(4).epsilon(1e-3));
    CHECK(pair.quantity("demand") == Approx(4).epsilon(1e-6));
    pair.step(0.25);
    CHECK(pair.quantity("total") == Approx(2).epsilon(1e-3));
}

TEST_CASE("three days of a drying root in voxels of 1 cm are those of fine voxels, thanks to the zone",
          "[environment][roots]") {
    const auto taken = [](double voxel, bool zone) {
        RootedSoil pair(
            fmt::format("model = \"richards\"\ndomain = {{ lower = [-0.02, -0.04, -0.02], upper = [0.02, 0, 0.02] }}\n"
                        "voxel = {}\nsoil = {{ theta_r = 0.08, theta_s = 0.43, alpha = 0.04, n = 1.6, ks = 50 }}\n"
                        "initial = {{ head = -1000 }}\n",
                        voxel),
            fmt::format("radial = 1e-3\naxial = 10\ncollar = {{ transpiration = 0.6, by_day = true }}\nzone = {}\n",
                        zone));
        pair.add_root(0.0051, 0.0051, 0.038, 0.0002, 1);
        for (int day = 0; day < 3; ++day) pair.step(1);
        return pair.quantity("total");
    };
    const double fine = taken(0.002, true);
    CHECK(fine < 1.6);  // of 1.8: it is short of water
    CHECK(taken(0.01, true) == Approx(fine).epsilon(0.1));
    CHECK(taken(0.01, false) > 1.02 * fine);
}

TEST_CASE("two plants share the soil; each has its own figures", "[environment][roots]") {
    RootedSoil pair(pot(0.02, "soil = \"loam\"\ninitial = { head = -200 }\n"),
                    drinks + "collar = { transpiration = 1 }\n");
    pair.add_root(-0.03, 0.01, 0.2);
    pair.add_root(0.03, 0.01, 0.1);
    pair.step();
    CHECK(pair.quantity("transpiration", 0) == Approx(1).epsilon(1e-6));
    CHECK(pair.quantity("transpiration", 1) == Approx(1).epsilon(1e-6));
    CHECK(pair.quantity("collar", 1) < pair.quantity("collar", 0));
    CHECK(pair.quantity("depth", 1) < pair.quantity("depth", 0));
}

TEST_CASE("Couvreur's sink is the network where conductances along are large", "[environment][roots]") {
    const std::string soil =
        pot(0.02, "soil = \"loam\"\ninitial = { head = -100 }\nlayers = [{ top = -0.1, initial = { head = -600 } }]\n");
    const std::string roots = "radial = 2e-4\naxial = 500\nzone = false\ncollar = { transpiration = 1 }\n";
    RootedSoil network(soil, roots), couvreur(soil, roots + "model = \"couvreur\"\n");
    network.add_root(0.01, 0.01, 0.2);
    couvreur.add_root(0.01, 0.01, 0.2);
    network.step();
    couvreur.step();
    CHECK(couvreur.quantity("transpiration") == Approx(1).epsilon(1e-6));
    CHECK(couvreur.quantity("collar") == Approx(network.quantity("collar")).epsilon(0.01));
    CHECK(couvreur.quantity("depth") == Approx(network.quantity("depth")).epsilon(0.01));
}

TEST_CASE("Feddes' roots take by length what soil neither too wet nor too dry gives", "[environment][roots]") {
    const auto part = [](double head) {
        RootedSoil pair(pot(0.02, fmt::format("soil = \"loam\"\ninitial = {{ head = {} }}\n", head)),
                        drinks + "model = \"feddes\"\ncollar = { transpiration = 1 }\n");
        pair.add_root(0.01, 0.01, 0.2);
        pair.step(0.001);
        return pair.quantity("transpiration");
    };
    CHECK(part(-100) == Approx(1).epsilon(1e-3));
    CHECK(part(-5) == Approx(0).margin(1e-6));
    CHECK(part(-8400) == Approx(0.5).epsilon(0.01));
    CHECK(part(-17000) == Approx(0).margin(1e-6));
}

TEST_CASE("roots kept in a checkpoint go on the same", "[environment][roots]") {
    const std::string soil = pot(0.02, "soil = \"loam\"\ninitial = { head = -200 }\n");
    const std::string roots = drinks + "collar = { transpiration = 3, by_day = true }\n";
    RootedSoil straight(soil, roots), resumed(soil, roots);
    for (RootedSoil* pair : {&straight, &resumed}) pair->add_root(0.01, 0.01, 0.2);
    straight.step(0.4);
    std::stringstream of_soil, of_roots, first, second;
    straight.water.process->save(of_soil);
    straight.process->save(of_roots);
    resumed.water.process->restore(of_soil);
    resumed.process->restore(of_roots);
    resumed.water.world.step = straight.water.world.step;
    straight.step(0.4);
    resumed.step(0.4);
    for (const RootedSoil* pair : {&straight, &resumed}) {
        std::stringstream& bytes = pair == &straight ? first : second;
        pair->water.process->save(bytes);
        pair->process->save(bytes);
    }
    CHECK(first.str() == second.str());
}

TEST_CASE("a query is told the water of the internode before it", "[environment][roots]") {
    RootedSoil pair(pot(0.02, "soil = \"loam\"\ninitial = { head = -100 }\n"), drinks + "collar = { head = -1000 }\n");
    pair.add_root(0.01, 0.01, 0.2);
    pair.step(0.01);
    std::vector<double> values(4, 0);
    Query query;
    query.module = 3;  // the lowest internode
    query.parameters = values;
    query.pose.position = {0.01, -0.2, 0.01};
    std::vector<Query> queries{query};
    std::vector<Answer> answers{Answer(values)};
    pair.process->answer(pair.water.world, queries, answers, pair.water.fields);
    CHECK(values[0] < -100);  // the potential in it
    CHECK(values[0] > -1000);
    CHECK(values[1] > 0);
    CHECK(values[2] < -99);
    CHECK(values[3] > 0.01);
    CHECK(values[3] < 0.25);  // less than its share of the length
}

TEST_CASE("organs know their water without a query, as a query is told it", "[environment][roots]") {
    RootedSoil plant(pot(0.02, "soil = \"loam\"\ninitial = { head = -100 }\n"), drinks + "collar = { head = -1000 }\n");
    plant.add_root(0.01, 0.01, 0.2);
    // A stem above the soil.
    plant.strings[0].append(plant.model.alphabet.letter("F", 0), {});
    plant.interpretations[0].geometry.internodes.push_back(
        {4, 1, 0, 0, 0, {0.01, 0, 0.01}, {0.01, 0.3, 0.01}, 0.001, 0.001});
    plant.step(0.01);
    const auto values = [&](const std::string& name) { return *plant.process->organ_values(name, 0); };
    double uptake = 0, fractions = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        std::vector<double> told(4, 0);
        Query query;
        query.module = static_cast<std::uint32_t>(i);
        query.parameters = told;
        query.pose.position = {0.01, -0.05 * double(i + 1), 0.01};
        std::vector<Query> queries{query};
        std::vector<Answer> answers{Answer(told)};
        plant.process->answer(plant.water.world, queries, answers, plant.water.fields);
        const char* const names[] = {"head", "uptake", "soil", "fraction"};
        for (std::size_t n = 0; n < 4; ++n) CHECK(values(names[n])[i] == static_cast<float>(told[n]));
        CHECK(values("radial")[i] == Approx(1.73e-4));
        CHECK(values("axial")[i] == Approx(0.0432));
        uptake += told[1];
        fractions += told[3];
    }
    CHECK(uptake == Approx(plant.quantity("transpiration")).epsilon(1e-3));  // of the last substep
    CHECK(fractions == Approx(1).epsilon(1e-9));
    for (const OrganQuantity& quantity : plant.process->organ_quantities()) {
        REQUIRE(values(quantity.name).size() == 5);
        CHECK(std::isnan(values(quantity.name)[4]));
    }
    CHECK(plant.process->organ_values("head", 7) == nullptr);
}

TEST_CASE("a model says the conductances of its roots", "[environment][roots]") {
    const std::string soil = pot(0.02, "soil = \"loam\"\n"), held = "collar = { head = -500 }\n";
    RootedSoil pair(soil, "radial = 1e-9\naxial = 1e-3\n" + held);
    pair.model.processes = {"water", "roots"};
    pair.add_root(0.01, 0.01, 0.2);  // four internodes, a query behind each
    ModuleString& string = pair.strings[0];
    string = {};
    const LetterId internode = pair.model.alphabet.letter("F", 0), asks = pair.model.alphabet.letter("?roots", 6);
    std::deque<std::vector<double>> parameters;
    for (std::uint32_t i = 0; i < 4; ++i) {
        string.append(internode, {});
        parameters.push_back({0, 0, 0, 0, 1.73e-4, 0.0432});
        string.append(asks, parameters.back());
        pair.interpretations[0].geometry.internodes[i].module = 2 * i;
        Query query;
        query.process = 1;
        query.module = 2 * i + 1;
        query.parameters = parameters.back();
        pair.interpretations[0].queries.push_back(query);
    }
    pair.step(0.01);
    const double around = 2 * std::numbers::pi * 0.1, tau = std::sqrt(around * 1.73e-4 / 0.0432);
    CHECK(pair.quantity("conductance") == Approx(0.0432 * tau * std::tanh(20 * tau)).epsilon(1e-9));
    // The uptake at a depth z is proportional to cosh((20 - z) tau).
    CHECK(pair.quantity("suf_depth") == Approx(std::tanh(10 * tau) / tau).epsilon(2e-3));
    parameters[2][5] = 0;
    CHECK_THROWS_WITH(pair.step(0.01), Catch::Contains("axial conductance 0 cm3/d"));
}

TEST_CASE("mistakes of roots are clear lines", "[environment][roots]") {
    const std::string soil = pot(0.02, "soil = \"loam\"\n");
    const auto mistake = [&](const std::string& in, const std::string& roots) {
        return user_error([&] { RootedSoil pair(in, roots); });
    };
    CHECK(mistake(soil, drinks).find("'collar' needs one of 'head'") != std::string::npos);
    CHECK(mistake(soil, "collar = { head = -5 }\n").find("radial") != std::string::npos);
    CHECK(mistake(soil, "radial = { at = [0, 1], values = [1] }\naxial = 1\ncollar = { head = -5 }\n")
              .find("as many numbers") != std::string::npos);
    CHECK(mistake(soil, "radial = 1\naxial = 0\ncollar = { head = -5 }\n").find("'axial' must be more than 0") !=
          std::string::npos);
    CHECK(mistake(soil, drinks + "collar = { head = -5 }\nmodel = \"feddes\"\n").find("give a 'transpiration'") !=
          std::string::npos);
    CHECK(mistake("domain = { lower = [0, -1, 0], upper = [1, 0, 0] }\nvoxel = 0.1\n",
                  drinks + "collar = { head = -5 }\n")
              .find("is not a soil-water with model = \"richards\"") != std::string::npos);
    CHECK(mistake(soil, drinks + "collar = { head = 20 }\n").find("'head'") != std::string::npos);
    CHECK(mistake(soil, drinks + "collar = { transpiration = 1, limit = \"-1.6 Mpa\" }\n").find("'MPa'") !=
          std::string::npos);
}

TEST_CASE("rates of a plant are those of a day, whatever the length of a step", "[environment][roots]") {
    const auto rates = [](double dt, int steps, const std::string& days) {
        RootedSoil pair(pot(0.02, "soil = \"loam\"\ninitial = { head = -100 }\n" + days),
                        drinks + "collar = { transpiration = 0.5 }\n");
        pair.add_root(0, 0, 0.2);
        for (int step = 0; step < steps; ++step) pair.step(dt);
        return std::array{pair.quantity("transpiration"), pair.quantity("demand"), pair.quantity("total")};
    };
    for (const double dt : {2.0, 0.5, 0.125}) {
        const auto [transpiration, demand, total] = rates(dt, static_cast<int>(2 / dt), "");
        CHECK(transpiration == Approx(0.5).epsilon(1e-6));
        CHECK(demand == Approx(0.5).epsilon(1e-9));
        CHECK(total == Approx(1).epsilon(1e-6));
    }
    CHECK(rates(24, 2, "days = 0.041666666666666664\n")[0] == Approx(0.5).epsilon(1e-6));  // dt in hours
    RootedSoil first(pot(0.02, "soil = \"loam\"\n"), drinks + "collar = { transpiration = 0.5 }\n");
    first.add_root(0, 0, 0.2);
    first.water.world.step = 0;  // no time has passed: what flows at that moment
    first.step();
    CHECK(first.quantity("transpiration") == Approx(0.5).epsilon(1e-6));
    CHECK(first.quantity("demand") == 0.5);
    CHECK(first.quantity("total") == 0);
}

namespace {

/// A root of 0.4 m, of which the soil has the upper 0.24.
struct TooLong : RootedSoil {
    explicit TooLong(const std::string& outside, double length = 0.4, int internodes = 10)
        : RootedSoil(pot(0.02, "soil = \"loam\"\ninitial = { table = -2 }\n" + outside),
                     drinks + "zone = false\ncollar = { head = -1000 }\n", true) {
        add_root(0.01, 0.01, length, 0.001, internodes);
        step(0.001);
    }
};

/// Of a root with a closed tip. One that goes on where it takes nothing up is the same.
double conductance_of(double in_soil) {
    const double tau = std::sqrt(2 * std::numbers::pi * 0.1 * 1.73e-4 / 0.0432);
    return 0.0432 * tau * std::tanh(in_soil * tau);
}

}  // namespace

TEST_CASE("a root that leaves the soil ends there, goes on, or ends the run", "[environment][roots]") {
    const TooLong ends(""), ignored("outside = \"ignore\"\n");
    for (const TooLong* const root : {&ends, &ignored}) {
        CHECK(root->quantity("conductance") == Approx(conductance_of(24)).epsilon(1e-9));
        REQUIRE(root->warnings.size() == 1);
        CHECK(root->warnings[0].message.find("leaves the soil of 'water' at (0.01, -0.25") != std::string::npos);
    }
    CHECK(ends.warnings[0].message.find("takes no part") != std::string::npos);
    CHECK(ignored.warnings[0].message.find("takes nothing up") != std::string::npos);
    CHECK(std::isnan(ends.process->organ_values("head", 0)->back()));
    CHECK(ignored.process->organ_values("uptake", 0)->back() == 0);
    CHECK_THROWS_WITH(TooLong("outside = \"error\"\n"),
                      Catch::Contains("a root of plant 0 leaves the soil at (0.01, -0.25"));
}

TEST_CASE("a root that leaves the soil and comes back takes part again only where it is ignored outside",
          "[environment][roots]") {
    const auto depth = [](const std::string& outside) {
        RootedSoil pair(pot(0.02, "soil = \"loam\"\ninitial = { head = -100 }\n" + outside),
                        drinks + "collar = { head = -1000 }\n", true);
        pair.add_root(0.01, 0.01, 0.2);
        // Out through a side, and back in lower down.
        auto& internodes = pair.interpretations[0].geometry.internodes;
        internodes[1].tip = internodes[2].base = {0.07, -0.1, 0.01};
        internodes[2].tip = internodes[3].base = {0.01, -0.15, 0.01};
        pair.step(0.01);
        return pair.quantity("suf_depth");
    };
    CHECK(depth("outside = \"ignore\"\n") > 7);
    CHECK(depth("outside = \"stop growing\"\n") < 6);
}

TEST_CASE("a tip is told how far the nearest wall is", "[environment][roots]") {
    Soil soil(
        pot(0.02, "soil = \"loam\"\nobstacles = [{ shape = \"sphere\", center = [0, -0.12, 0], radius = 0.01 }]\n"));
    const auto room = [](Soil& in, const glm::dvec3& at) {
        std::vector<double> parameters(14, 0);
        parameters[3] = 0.01;
        return in.ask({{at, parameters}})[0][13];
    };
    CHECK(room(soil, {0.03, -0.05, 0}) == Approx(0.01));    // a side
    CHECK(room(soil, {0, -0.22, -0.001}) == Approx(0.02));  // the floor
    CHECK(room(soil, {0, -0.12, 0.025}) == Approx(0.015));  // side and stone
    CHECK(room(soil, {0, -0.105, 0}) == Approx(0.005));     // the stone
    CHECK(room(soil, {0.05, -0.05, 0}) == Approx(-0.01));   // beyond
    CHECK(room(soil, {0, -0.001, 0}) == Approx(0.04));      // the surface is no wall
    Soil periodic(pot(0.02, "soil = \"loam\"\nboundaries = { sides = \"periodic\" }\n"));
    CHECK(room(periodic, {0.039, -0.05, 0}) == Approx(0.19));
}

namespace {

/// What a root conducts whose internodes have these ages: the soil sees ever less of it from the tip up.
double conductance_with_ages(const std::vector<double>& said, const std::string& along = "") {
    RootedSoil pair(pot(0.02, "soil = \"loam\"\n"),
                    "radial = { at = [0, 10], values = [2e-4, 0] }\naxial = 1e6\ncollar = { head = -500 }\n" + along,
                    true);
    pair.model.processes = {"roots"};
    pair.add_root(0.01, 0.01, 0.2);
    ModuleString& string = pair.strings[0];
    string = {};
    const LetterId internode = pair.model.alphabet.letter("F", 0), asks = pair.model.alphabet.letter("?roots", 5);
    std::deque<std::vector<double>> parameters;
    for (std::uint32_t i = 0; i < 4; ++i) {
        string.append(internode, {});
        pair.interpretations[0].geometry.internodes[i].module = static_cast<std::uint32_t>(string.size() - 1);
        if (said.empty()) continue;
        parameters.push_back({0, 0, 0, 0, said[i]});
        string.append(asks, parameters.back());
        Query query;
        query.process = 0;
        query.module = static_cast<std::uint32_t>(string.size() - 1);
        query.parameters = parameters.back();
        pair.interpretations[0].queries.push_back(query);
    }
    pair.step(0.01);
    if (!along.empty()) CHECK(pair.warnings.size() == 1);
    return pair.quantity("conductance");
}

}  // namespace

TEST_CASE("a model says the ages of its roots within a step", "[environment][roots]") {
    const double surface = 2 * std::numbers::pi * 0.1 * 5, young = 2e-4 * surface;  // of an internode
    CHECK(conductance_with_ages({}) == Approx(4 * young).epsilon(1e-4));
    CHECK(conductance_with_ages({9, 6.5, 2.25, 0}) == Approx((0.1 + 0.35 + 0.775 + 1) * young).epsilon(1e-4));
    CHECK(conductance_with_ages({40, 40, 40, 5}) == Approx(0.5 * young).epsilon(1e-4));
    CHECK_THROWS_WITH(conductance_with_ages({1, 1, 1, -0.5}), Catch::Contains("a root -0.5 days old"));
    CHECK(conductance_with_ages({1, 1, 1, 1}, "along = \"distance from tip\"\n") > 0);
}

TEST_CASE("in soil that stands still a root takes every day what the closed form has", "[environment][roots]") {
    RootedSoil pair(pot(0.02, "soil = \"loam\"\ninitial = { table = -2 }\n").replace(9, 8, "still"),
                    drinks + "zone = false\ncollar = { head = -1000 }\n");
    pair.add_root(0.01, 0.01, 0.2);
    const double tau = std::sqrt(2 * std::numbers::pi * 0.1 * 1.73e-4 / 0.0432);
    const double exact = 0.0432 * tau * std::tanh(20 * tau) * (1000 - 200);  // total heads, of which gravity is a part
    for (int day = 0; day < 4; ++day) {
        pair.step();
        CHECK(pair.quantity("transpiration") == Approx(exact).epsilon(1e-9));
    }
    CHECK(pair.water.quantity("drunk") == Approx(10 * 4 * exact / area).epsilon(1e-9));
    CHECK(pair.water.quantity("added") == Approx(pair.water.quantity("drunk")).epsilon(1e-12));
    CHECK(std::abs(pair.water.quantity("balance")) < 1e-12);
    CHECK(pair.water.process->statistics(0).size() > 5);
}

}  // namespace espalier::test
