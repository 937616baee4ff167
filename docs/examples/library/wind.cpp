#include <espalier/environment/environment_process.h>
#include <espalier/simulation/world.h>

#include <cmath>
#include <cstdio>

using namespace espalier;

class Wind final : public EnvironmentProcess {
public:
    Wind(Settings& settings, const EnvironmentContext&, Fields&) : speed_(settings.number_or("speed", 1)) {}

    // One answer per query; the answers replace the query's parameters.
    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            answers[i][0] = speed_ * std::log1p(queries[i].pose.position.y);
        }
    }
    std::pair<int, int> query_arity() const override { return {1, 1}; }

private:
    double speed_;  // m/s
};

const Registered<ProcessType> entry{
    {"wind", "wind speed at a height", "speed (m/s, 1): 1.7 m above the ground", construct<Wind>}};

int main() {
    Scene scene;
    scene.steps = 30;
    scene.plants.push_back(plant_of_text(R"(
environment wind;
lsystem: reed
axiom: ?wind(0)A
?wind(v) < A : v < 2 --> F(0.5)?wind(0)A
?wind(v) --> *
endlsystem
)"));
    scene.environment.add("wind", "wind", {{"speed", 1.5}});
    World world(scene);
    for (world.start(); !world.at_end();) world.step();
    std::printf("%zu internodes\n", world.interpretation(0).geometry.internodes.size());
}
