// A solute in soil: transport against closed forms, uptake against plain references, and the account.
#include "catch.h"
#include "environment/soil/linear/soil.h"

#include <fmt/format.h>

#include <cmath>
#include <deque>
#include <functional>
#include <numbers>

namespace espalier::test {
namespace {

/// A solute, in a soil if there is a text for one, with roots that are drawn by hand.
struct Solute {
    explicit Solute(const std::string& solute, const std::string& soil = "") {
        if (!soil.empty()) water = std::make_unique<Soil>(soil);
        context.name = "nitrate";
        context.plants = 2;
        Settings settings = Settings::parse_toml(solute, "solute.toml");
        process = registered<ProcessType>().at("nutrient")->make(settings, context, fields());
        settings.reject_unread();
    }

    Fields& fields() { return water ? water->fields : own_fields; }
    WorldView& world() { return water ? water->world : own_world; }

    /// From (x, from, z) straight down to y = to, m.
    void add_root(double x, double from, double to, double radius = 0.0002, double z = 0) {
        Interpretation& drawn = interpretations.emplace_back();
        drawn.geometry.internodes.push_back({0, 0, 0, 0, 0, {x, from, z}, {x, to, z}, radius, radius});
        drawn.geometry.axes = 1;
        strings.emplace_back().append(model.alphabet.letter("F", 0), {});
        views.clear();
        for (std::size_t i = 0; i < strings.size(); ++i) {
            views.push_back({static_cast<std::uint32_t>(i), &model, &strings[i], &interpretations[i], true});
        }
    }

    void step(double dt = 1) {
        world().plants = views;
        world().dt = dt;
        if (water) {
            water->process->advance(world(), {}, fields());
            water->ask({});
        }
        process->advance(world(), {}, fields());
        ++world().step;
        process->answer(world(), {}, {}, fields());
    }

    std::vector<double> ask(glm::dvec3 position, std::vector<double> parameters = {0}) {
        std::vector<Query> queries(1);
        queries[0].parameters = parameters;
        queries[0].pose.position = position;
        std::vector<Answer> answers{Answer(parameters)};
        process->answer(world(), queries, answers, fields());
        return parameters;
    }

    /// At a depth in cm.
    double at(double depth) { return ask({0, -0.01 * depth, 0})[0]; }

    double quantity(const std::string& name, std::uint32_t plant = 0) const {
        for (const Quantity& quantity : process->statistics(plant)) {
            if (quantity.name == name) return quantity.value;
        }
        throw RunError("no quantity " + name);
    }

    std::unique_ptr<Soil> water;
    Fields own_fields;
    WorldView own_world{1, 0, 1, {}};
    EnvironmentContext context;
    Model model;
    std::deque<ModuleString> strings;
    std::deque<Interpretation> interpretations;
    std::vector<PlantView> views;
    std::unique_ptr<EnvironmentProcess> process;
};

/// One voxel wide, `depth` cm deep, voxels of `edge` cm.
std::string column(double depth, double edge, const std::string& rest) {
    return fmt::format("domain = {{ lower = [{0}, {1}, {0}], upper = [{2}, 0, {2}] }}\nvoxel = {3}\n", -0.005 * edge,
                       -0.01 * depth, 0.005 * edge, 0.01 * edge) +
           rest;
}

const std::string full = "content = 0.4\nporosity = 0.4\n";
const double tortuosity = std::cbrt(0.4);  // 0.4^(7/3) / 0.4^2

/// Ogata & Banks (1961), of concentration 1 held at the inlet.
double ogata_banks(double x, double t, double v, double d) {
    const double spread = 2 * std::sqrt(d * t);
    return 0.5 * (std::erfc((x - v * t) / spread) + std::exp(v * x / d) * std::erfc((x + v * t) / spread));
}

/// Largest error of a column after five days at the centres of its voxels, down to 12 cm.
double column_error(Solute& solute, double edge, const std::function<double(double)>& expected) {
    double error = 0;
    for (double x = 0.5 * edge; x < 12; x += edge) error = std::max(error, std::abs(solute.at(x) - expected(x)));
    return error;
}

}  // namespace

TEST_CASE("a solute enters a column as Ogata and Banks have it, and the error falls with the second power",
          "[environment][nutrient]") {
    CHECK(ogata_banks(5, 5, 1, 0.5) == Approx(0.5853).margin(5e-5));
    double before = 0;
    for (const double edge : {1.0, 0.5, 0.25, 0.125}) {
        Solute solute(column(30, edge,
                             full + fmt::format("flow = 0.4\ndiffusion = {}\nmax_substep = 1\nboundaries = {{ "
                                                "top = {{ held = 1 }} }}\n",
                                                0.5 / tortuosity)));
        solute.step(5);
        const double error = column_error(solute, edge, [](double x) { return ogata_banks(x, 5, 1, 0.5); });
        INFO(edge << " cm: " << error);
        if (before > 0) CHECK(std::log2(before / error) > 1.4);
        before = error;
        CHECK(std::abs(solute.quantity("balance")) < 1e-12);
    }
    CHECK(before < 0.0006);
}

TEST_CASE("dispersion spreads as the dispersivity times the flux", "[environment][nutrient]") {
    // theta D = 0.5 cm times 0.4 cm/d, and v = 1: as before.
    Solute solute(column(30, 0.25,
                         full + "flow = 0.4\ndiffusion = 0\ndispersivity = 0.5\nmax_substep = 1\nboundaries = "
                                "{ top = { held = 1 } }\n"));
    solute.step(5);
    CHECK(column_error(solute, 0.25, [](double x) { return ogata_banks(x, 5, 1, 0.5); }) < 0.002);
}

TEST_CASE("linear sorption holds a front back by its retardation factor", "[environment][nutrient]") {
    // R = 1 + 1.4 * 0.2857 / 0.4 = 2
    Solute solute(column(30, 0.25,
                         full + fmt::format("flow = 0.4\ndiffusion = {}\nmax_substep = 1\nsorption = {{ "
                                            "coefficient = {} }}\nboundaries = {{ top = {{ held = 1 }} }}\n",
                                            0.5 / tortuosity, 0.4 / 1.4)));
    solute.step(10);
    CHECK(column_error(solute, 0.25, [](double x) { return ogata_banks(x, 5, 1, 0.5); }) < 0.002);
}

TEST_CASE("Freundlich's front travels at the speed of its concentration's retardation", "[environment][nutrient]") {
    // R(1) = 1 + 1.4 * 0.5 / 0.4 = 2.75 for c = 1, so 27.5 cm of water bring the front to 10 cm.
    Solute solute(column(20, 0.25,
                         full + "flow = 0.4\ndiffusion = 0.1\nmax_substep = 1\nsorption = { coefficient = 0.5, "
                                "exponent = 0.6 }\nboundaries = { top = { entering = 1 } }\n"));
    solute.step(27.5);
    double front = 0;
    while (solute.at(front + 0.01) > 0.5) front += 0.01;
    CHECK(front == Approx(10).margin(0.15));
    CHECK(solute.at(5) == Approx(1).margin(1e-6));
    CHECK(std::abs(solute.quantity("balance")) < 1e-10);
    CHECK(solute.quantity("minimum") >= 0);
}

TEST_CASE("without water that moves a solute spreads by diffusion in the tortuous water", "[environment][nutrient]") {
    // Drier soil: tau = 0.2^(7/3) / 0.4^2.
    const double d = 1.6 * std::pow(0.2, 7.0 / 3) / 0.16;
    Solute solute(column(30, 0.25, "content = 0.2\nporosity = 0.4\nboundaries = { top = { held = 2 } }\n"));
    solute.step(5);
    const double error =
        column_error(solute, 0.25, [&](double x) { return 2 * std::erfc(x / (2 * std::sqrt(5 * d))); });
    CHECK(error < 0.004);
}

TEST_CASE("a sharp front neither overshoots nor smears over more than a few voxels", "[environment][nutrient]") {
    Solute solute(column(60, 1, full + "flow = 0.4\ndiffusion = 0\nboundaries = { top = { entering = 1 } }\n"));
    solute.step(40);
    double before = 1 + 1e-12;
    int between = 0;
    for (double x = 0.5; x < 60; ++x) {
        const double c = solute.at(x);
        CHECK(c <= before);
        CHECK(c >= 0);
        between += c > 0.1 && c < 0.9;
        before = c + 1e-12;
    }
    CHECK(between <= 6);  // upstream concentrations alone: 12
    CHECK(solute.at(40) == Approx(0.5).margin(0.2));
    CHECK(solute.quantity("inflow") == Approx(0.4 * 40).epsilon(1e-12));
}

TEST_CASE("what has decayed, was brought or was washed out is in the account", "[environment][nutrient]") {
    Solute still(column(10, 1, full + "decay = 0.1\ninitial = 3\n"));
    still.step(7);
    CHECK(still.at(5) == Approx(3 * std::exp(-0.7)).epsilon(1e-12));
    CHECK(still.quantity("decayed") == Approx(0.4 * 10 * 3 * (1 - std::exp(-0.7))).epsilon(1e-12));

    Solute washed(column(10, 1,
                         full + "flow = 1\ninitial = 1\nevents = [{ day = 3.3, amount = 5, bottom = -0.02 }]\n"
                                "sources = [{ rate = 0.01, bottom = -0.05 }]\n"));
    washed.step(3);
    CHECK(washed.quantity("fertilised") == 0);
    for (int day = 0; day < 27; ++day) washed.step();
    CHECK(washed.quantity("fertilised") == 5);
    CHECK(washed.quantity("produced") == Approx(0.01 * 5 * 30));
    CHECK(washed.quantity("leached") == Approx(4 + 5 + 1.5 - washed.quantity("stored")).epsilon(1e-10));
    // In the steady state the water that leaves carries what is produced.
    CHECK(washed.at(9.5) == Approx(0.05).epsilon(0.01));
    CHECK(std::abs(washed.quantity("balance")) < 1e-12);
}

TEST_CASE("roots take up as Michaelis and Menten have it, against a plain solution of the equation",
          "[environment][nutrient]") {
    Solute solute(
        column(1, 1, full + "initial = 0.5\nzone = false\nuptake = { vmax = 0.3, km = 0.05, cmin = 0.02 }\n"));
    solute.add_root(0, 0, -0.01);
    const double surface = 2 * std::numbers::pi * 0.02;  // cm2 in 1 cm3
    double c = 0.5;
    for (int step = 0; step < 6; ++step) {
        solute.step(1);
        for (int i = 0; i < 1000; ++i) {  // Runge & Kutta
            const auto rate = [&](double x) { return -surface * 0.3 * (x - 0.02) / (0.05 + x - 0.02) / 0.4; };
            const double h = 1e-3, a = rate(c), b = rate(c + h / 2 * a), d = rate(c + h / 2 * b), e = rate(c + h * d);
            c += h / 6 * (a + 2 * b + 2 * d + e);
        }
        CHECK(solute.at(0.5) == Approx(c).epsilon(2e-4));
    }
    CHECK(solute.quantity("total") == Approx(0.4 * (0.5 - c)).epsilon(1e-3));
    for (int step = 0; step < 100; ++step) solute.step(1);
    CHECK(solute.at(0.5) >= 0.02 - 1e-12);
    CHECK(solute.at(0.5) == Approx(0.02).epsilon(1e-6));
}

TEST_CASE("the zone around a root takes as much as a fine cylinder of soil gives", "[environment][nutrient]") {
    // Voxels of 1 cm, one root each: a cylinder of 0.564 cm. Slow diffusion, so that the root drains its surroundings.
    const double content = 0.2, d0 = 0.3, vmax = 0.2, km = 0.02;
    const double spread = content * std::pow(content, 7.0 / 3) / 0.16 * d0;
    constexpr int cells = 100;
    const double inner = 0.02, width = (std::sqrt(1 / std::numbers::pi) - inner) / cells;
    std::vector<double> c(cells, 1.0);
    double taken = 0, checked = 0;
    const std::string text =
        "content = 0.2\nporosity = 0.4\ninitial = 1\ndiffusion = 0.3\nuptake = { vmax = 0.2, km = "
        "0.02 }\n";
    Solute solute(column(1, 1, text)), blunt(column(1, 1, text + "zone = false\n"));
    solute.add_root(0, 0, -0.01);
    blunt.add_root(0, 0, -0.01);
    for (int day = 1; day <= 8; ++day) {
        const double h = 0.4 * content * width * width / spread;
        const int steps = static_cast<int>(std::ceil(1 / h));
        for (int i = 0; i < steps; ++i) {
            // At the root's surface: what enters is what half a cell conducts.
            double low = 0, high = c[0];
            for (int k = 0; k < 40; ++k) {
                const double s = 0.5 * (low + high);
                (vmax * s / (km + s) > spread * (c[0] - s) / (0.5 * width) ? high : low) = s;
            }
            double from = 2 * std::numbers::pi * inner * vmax * low / (km + low);
            taken += from / steps;
            for (int k = 0; k < cells; ++k) {
                const double r = inner + (k + 1) * width;
                const double to = k + 1 < cells ? 2 * std::numbers::pi * r * spread * (c[k + 1] - c[k]) / width : 0;
                const double ring = std::numbers::pi * (r * r - (r - width) * (r - width));
                c[k] += (to - from) / (steps * content * ring);
                from = to;
            }
        }
        solute.step();
        blunt.step();
        if (day < 2) continue;
        INFO(day << " d: " << solute.quantity("total") << ", reference " << taken);
        CHECK(solute.quantity("total") == Approx(taken).epsilon(0.05));
        checked = std::max(checked, blunt.quantity("total") / taken);
    }
    CHECK(checked > 1.15);  // without zones
}

TEST_CASE("water that goes to the roots brings them solute, and leaves what they refuse", "[environment][nutrient]") {
    const std::string soil =
        "model = \"richards\"\nsoil = \"loam\"\ninitial = { head = -100 }\nvoxel = 0.02\ndomain = { "
        "lower = [-0.01, -0.02, -0.01], upper = [0.01, 0, 0.01] }\n";
    const auto grow = [&](const std::string& uptake, double& uptaken, double& drunk) {
        Solute solute("soil = \"water\"\ninitial = 2\nuptake = " + uptake, soil);
        Settings roots = Settings::parse_toml("radial = 1e-4\naxial = 1\ncollar = { transpiration = 0.1 }\n", "r.toml");
        EnvironmentContext context;
        context.name = "roots";
        context.plants = 2;
        const auto drinking = registered<ProcessType>().at("root-water")->make(roots, context, solute.fields());
        solute.add_root(0, 0, -0.02);
        for (int day = 0; day < 4; ++day) solute.step();
        uptaken = solute.quantity("total");
        drunk = 0.1 * 4;
        CHECK(std::abs(solute.quantity("balance")) < 1e-9);
        return solute.at(1);
    };
    double taken, drunk;
    // All that is in the water enters with it: the concentration stays.
    CHECK(grow("{ passive = 1 }\nzone = false\n", taken, drunk) == Approx(2).epsilon(1e-6));
    CHECK(taken == Approx(2 * drunk).epsilon(1e-5));
    CHECK(grow("{ passive = 1 }\n", taken, drunk) == Approx(2).epsilon(1e-6));
    // None: it rises, because the water is less.
    CHECK(grow("{ passive = 0 }\n", taken, drunk) > 2.1);
    CHECK(taken == 0);
}

TEST_CASE("rain of the soil's concentration leaves it as it is, whatever the water does", "[environment][nutrient]") {
    const std::string soil =
        "model = \"richards\"\nsoil = \"loam\"\ninitial = { head = -300 }\nvoxel = 0.05\ndomain = { lower = [-0.2, "
        "-0.4, "
        "0], upper = [0.2, 0, 0] }\nlayers = [{ top = -0.2, soil = \"sand\" }]\nregions = [{ shape = \"sphere\", "
        "center = "
        "[0.1, -0.1, 0], radius = 0.08, soil = \"clay\" }]\nboundaries = { top = { rain = 60 }, bottom = "
        "\"free-drainage\", sides = \"periodic\" }\n";
    Solute solute("soil = \"water\"\ninitial = 1.5\ndispersivity = 1\nboundaries = { top = { entering = 1.5 } }\n",
                  soil);
    for (int day = 0; day < 8; ++day) solute.step();
    CHECK(solute.quantity("minimum") == Approx(1.5).epsilon(1e-9));
    CHECK(solute.quantity("maximum") == Approx(1.5).epsilon(1e-9));
    // Over a surface of 40 by 5 cm.
    CHECK(solute.quantity("inflow") == Approx(1.5 * 0.1 * solute.water->quantity("rain") * 200).epsilon(0.1));
    CHECK(solute.quantity("leached") == Approx(1.5 * 0.1 * solute.water->quantity("drainage") * 200).epsilon(1e-9));
    CHECK(std::abs(solute.quantity("balance")) < 1e-9);
}

TEST_CASE("evaporation leaves the solute at the surface, and nothing falls below 0", "[environment][nutrient]") {
    const std::string soil =
        "model = \"richards\"\nsoil = \"loam\"\ninitial = { head = -100 }\nvoxel = 0.01\ndomain = { "
        "lower = [0, -0.2, 0], upper = [0.01, 0, 0.01] }\nboundaries = { top = { evaporation = 3 } "
        "}\n";
    Solute solute("soil = \"water\"\nlayers = [{ top = -0.03, bottom = -0.1, initial = 1 }]\n", soil);
    const double start = solute.quantity("stored");
    for (int day = 0; day < 10; ++day) solute.step();
    CHECK(solute.ask({0.005, -0.005, 0.005})[0] > 0.5);
    CHECK(solute.quantity("stored") == Approx(start).epsilon(1e-10));
    CHECK(solute.quantity("minimum") >= 0);
}

TEST_CASE("a query is answered concentration, gradient and uptake", "[environment][nutrient]") {
    Solute solute(column(10, 1, full + "diffusion = 0\nlayers = [{ top = -0.05, initial = 1 }]\n"));
    solute.step();
    const std::vector<double> answer = solute.ask({0, -0.05, 0}, {9, 9, 9, 9, 9});
    CHECK(answer[0] == Approx(0.5));
    CHECK(answer[2] == Approx(-0.5));  // upwards, per cm: the mean of central differences
    CHECK(answer[1] == 0);
    CHECK(answer[4] == 0);
}

TEST_CASE("a solute goes on from a checkpoint to the same bytes", "[environment][nutrient]") {
    const std::string text = column(10, 1,
                                    full +
                                        "flow = 0.3\ninitial = 1\nuptake = { vmax = 0.1, km = 0.1 }\nevents = "
                                        "[{ day = 1.5, amount = 2 }]\n");
    Solute first(text), second(text);
    for (Solute* solute : {&first, &second}) solute->add_root(0, 0, -0.1);
    first.step(2);
    std::stringstream bytes;
    first.process->save(bytes);
    second.process->restore(bytes);
    second.world().step = first.world().step;
    first.step(2);
    second.step(2);
    std::ostringstream a, b;
    first.process->save(a);
    second.process->save(b);
    CHECK(a.str() == b.str());
}

TEST_CASE("soil and solute go on from a checkpoint to the same figures, substeps among them",
          "[environment][nutrient]") {
    const std::string soil =
        "model = \"richards\"\nsoil = \"loam\"\ninitial = { head = -300 }\nvoxel = 0.05\ndomain = { "
        "lower = [0, -0.4, 0], upper = [0.05, 0, 0.05] }\nboundaries = { top = { rain = 20 }, bottom "
        "= \"free-drainage\" }\n";
    Solute first("soil = \"water\"\ninitial = 1\n", soil), second("soil = \"water\"\ninitial = 1\n", soil);
    first.step(2);
    std::stringstream water, solute;
    first.water->process->save(water);
    first.process->save(solute);
    second.water->process->restore(water);
    second.process->restore(solute);
    second.world().step = first.world().step;
    first.step(2);
    second.step(2);
    CHECK(first.water->quantity("substeps") == second.water->quantity("substeps"));
    CHECK(first.quantity("stored") == second.quantity("stored"));
    CHECK(first.quantity("leached") == second.quantity("leached"));
}

TEST_CASE("a solute works beside a linear soil", "[environment][nutrient]") {
    const std::string space = "domain = { lower = [0, -0.04, 0], upper = [0.04, 0, 0.04] }\nvoxel = 0.01\n";
    Solute solute(space + "soil = \"water\"\ninitial = 1\n", space + "initial = 0.25\ndiffusion = 1e-5\n");
    CHECK(solute.quantity("stored") == Approx(0.25 * 64).epsilon(1e-6));
    solute.step();
    CHECK(std::abs(solute.quantity("balance")) < 1e-9);
}

TEST_CASE("what cannot be is refused with its place", "[environment][nutrient]") {
    const auto error = [](const std::string& text) { return user_error([&] { Solute solute(text); }); };
    using Catch::Contains;
    CHECK_THAT(error(column(4, 1, "uptake = { vmax = 1 }\n")), Contains("km"));
    CHECK_THAT(error(column(4, 1, "initial = -1\n")), Contains("solute.toml:3"));
    CHECK_THAT(error(column(4, 1, "soil = \"clay\"\n")), Contains("clay"));
    CHECK_THAT(error(column(4, 1, "events = [{ day = 1, amount = 2, bottom = 1, top = 2 }]\n")), Contains("voxel"));
    CHECK_THAT(error(column(4, 1, "sorption = { coefficient = 1, exponent = 3 }\n")), Contains("exponent"));
    CHECK_THAT(error(column(4, 1, "voxels = 3\n")), Contains("voxels"));
}

TEST_CASE("the uptake of a plant is that of a day, whatever the length of a step", "[environment][nutrient]") {
    for (const double dt : {1.0, 0.25}) {
        Solute solute(column(10, 1, full + "initial = 5\nzone = false\nuptake = { vmax = 0.01, km = 1e-9 }\n"));
        solute.add_root(0, -0.02, -0.06);
        for (int step = 0; step < 1 / dt; ++step) solute.step(dt);
        // vmax times the surface: a radius of 0.02 cm, 4 cm long.
        CHECK(solute.quantity("uptake") == Approx(0.01 * 2 * std::numbers::pi * 0.02 * 4).epsilon(1e-6));
        CHECK(solute.quantity("total") == Approx(solute.quantity("uptake")).epsilon(1e-6));
    }
}

TEST_CASE("a tip is told how far the nearest wall of its soil is, and a root that leaves it ends",
          "[environment][nutrient]") {
    const std::string uptake = "uptake = { vmax = 0.01, km = 1e-9 }\nzone = false\n";
    const std::vector<double> parameters(6, 0);
    Solute alone(column(10, 1, full + "initial = 5\n" + uptake));
    CHECK(alone.ask({0.001, -0.05, 0}, parameters)[5] == Approx(0.004));
    CHECK(alone.ask({0, -0.098, 0}, parameters)[5] == Approx(0.002));
    Solute in_soil("soil = \"water\"\ninitial = 5\n" + uptake,
                   column(10, 1, "model = \"richards\"\nsoil = \"loam\"\nboundaries = { sides = \"periodic\" }\n"));
    CHECK(in_soil.ask({0.001, -0.05, 0}, parameters)[5] == Approx(0.004));  // one voxel is not joined to itself
    CHECK(in_soil.ask({0, -0.098, 0}, parameters)[5] == Approx(0.002));
    for (Solute* const solute : {&alone, &in_soil}) {
        solute->add_root(0, -0.06, -0.14);  // half of it is below the floor
        solute->step();
        CHECK(solute->quantity("uptake") == Approx(0.01 * 2 * std::numbers::pi * 0.02 * 4).epsilon(1e-6));
    }
}

TEST_CASE("water that enters at a side brings its solute, and what leaves takes it along", "[environment][nutrient]") {
    const std::string soil =
        "model = \"richards\"\ndomain = { lower = [0, -0.02, 0], upper = [0.2, 0, 0] }\nvoxel = 0.02\n"
        "soil = \"sandy loam\"\ninitial = { head = -40 }\nboundaries = { left = { head = -20 }, right = { head = -60 } "
        "}\n";
    Solute solute("soil = \"water\"\ninitial = 2\nboundaries = { sides = { entering = 2 } }\n", soil);
    for (int day = 0; day < 20; ++day) solute.step();
    for (double x = 0.01; x < 0.2; x += 0.02) CHECK(solute.ask({x, -0.01, 0})[0] == Approx(2).epsilon(1e-6));
    CHECK(std::abs(solute.quantity("balance")) < 1e-9);
    Solute rinsed("soil = \"water\"\ninitial = 2\n", soil);
    for (int day = 0; day < 200; ++day) rinsed.step();
    CHECK(rinsed.quantity("sides") < 0);
    CHECK(rinsed.quantity("stored") < 0.05 * -rinsed.quantity("sides"));
    CHECK(std::abs(rinsed.quantity("balance")) < 1e-9);
}

}  // namespace espalier::test
