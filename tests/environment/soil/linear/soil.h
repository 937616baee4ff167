// A soil to test with: the process made from a scene's text, asked by hand.
#pragma once

#include "espalier/environment/environment_process.h"
#include "espalier/geometry/openvdb_grid.h"

#include "environment/soil/grid/direction.h"
#include "environment/soil/grid/solids.h"
#include "environment/soil/grid/uptake.h"
#include "environment/soil/linear/stock.h"

#include <sstream>
#include <string>
#include <vector>

namespace espalier::test {

using namespace espalier::environment;

struct Tip {
    glm::dvec3 position{0};
    std::vector<double> parameters;
    glm::dvec3 heading{0, -1, 0};
    std::uint32_t plant = 0;
};

struct Soil {
    explicit Soil(const std::string& text, EnvironmentContext given = {}) : context(std::move(given)) {
        if (context.name.empty()) context.name = "water";
        if (context.plants == 0) context.plants = 1;
        Settings settings = Settings::parse_toml(text, "soil.toml");
        process = registered<ProcessType>().at("soil-water")->make(settings, context, fields);
        settings.reject_unread();
    }

    void advance(double dt = 1) {
        world.dt = dt;
        process->advance(world, {}, fields);
        ++world.step;
    }

    /// The answers, in the order of the tips.
    std::vector<std::vector<double>> ask(const std::vector<Tip>& tips) {
        std::vector<std::vector<double>> values;
        std::vector<Query> queries;
        for (const Tip& tip : tips) {
            Query query;
            query.parameters = tip.parameters;
            query.pose.position = tip.position;
            query.pose.heading = tip.heading;
            query.pose.left = {-tip.heading.y, tip.heading.x, 0};
            query.pose.up = {0, 0, 1};
            query.plant = tip.plant;
            queries.push_back(query);
            values.push_back(tip.parameters);
        }
        std::vector<Answer> answers(values.begin(), values.end());
        process->answer(world, queries, answers, fields);
        return values;
    }

    double obtain(const Tip& tip) { return ask({tip})[0][0]; }

    /// Advance and answer, as a step does.
    std::vector<std::vector<double>> step(const std::vector<Tip>& tips = {}, double dt = 1) {
        advance(dt);
        return ask(tips);
    }

    double quantity(const std::string& name, std::uint32_t plant = 0) const {
        for (const Quantity& quantity : process->statistics(plant)) {
            if (quantity.name == name) return quantity.value;
        }
        throw RunError("no quantity " + name);
    }

    const openvdb::FloatGrid& grid() const { return *fields.need(context.name).grid->grid; }

    std::string saved() const {
        std::ostringstream out;
        process->save(out);
        return out.str();
    }

    EnvironmentContext context;
    Fields fields;
    WorldView world{1, 0, 1, {}};  ///< behind the initial state: the first advance is of one dt
    std::unique_ptr<EnvironmentProcess> process;
};

/// The stock behind the process, to look at in double precision.
struct Stock {
    explicit Stock(const std::string& text)
        : settings(Settings::parse_toml(text, "soil.toml")),
          parameters(read_water_parameters(settings, EnvironmentContext{})),
          grid(parameters.space.grid()),
          solids(parameters.space),
          diffusion(grid, parameters),
          stock(grid, parameters, solids.free_voxels(grid)) {}

    void advance(double dt = 1) { stock.diffuse(diffusion, dt); }
    double at(int x, int y = 0, int z = 0) const { return stock.contents()[grid.cell({x, y, z})]; }
    bool free(int x, int y = 0, int z = 0) const { return stock.faces().free(grid.cell({x, y, z})); }

    Settings settings;
    WaterParameters parameters;
    WaterGrid grid;
    WaterSolids solids;
    WaterDiffusion diffusion;
    WaterStock stock;
};

/// The message of the UserError that `action` throws, or "".
template <class Action>
std::string user_error(Action action) {
    try {
        action();
    } catch (const UserError& error) {
        return error.what();
    }
    return "";
}

}  // namespace espalier::test
