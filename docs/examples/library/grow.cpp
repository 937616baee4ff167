#include <espalier/simulation/world.h>

#include <cstdio>

const char* const tree = R"(
environment light;
lsystem: tree
derivation length: 8
axiom: ?light(1)A
?light(q) < A : q > 0.5 --> F(1)[+(40)?light(1)A][-(40)?light(1)A]/(90)?light(1)A
?light(q) --> ?light(1)
endlsystem
)";

int main() {
    espalier::Scene scene;
    for (const double x : {-0.5, 0.5}) {
        espalier::Plant plant = espalier::plant_of_text(tree);
        plant.turtle.pose.position = {x, 0, 0};
        scene.plants.push_back(plant);
    }
    scene.environment.add("light", "voxel-shade", {{"voxel", 0.5}, {"strength", 0.1}});

    espalier::World world(scene);
    for (world.start(); !world.at_end(); world.step()) {
        std::printf("step %d: %zu modules\n", world.steps_done(), world.modules());
    }
    double height = 0;
    for (const espalier::Internode& internode : world.interpretation(0).geometry.internodes) {
        height = std::max(height, internode.tip.y);
    }
    std::printf("step %d: %zu modules, the first tree is %.2f m high\n", world.steps_done(), world.modules(), height);
}
