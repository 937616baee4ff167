#include <espalier/simulation/world.h>

#include <cstdio>

class Sizes final : public espalier::Recorder {
public:
    void record(const espalier::Frame& frame) override {
        for (const espalier::PlantFrame& plant : frame.plants) {
            std::printf("%d %s %zu\n", frame.step, plant.name.c_str(), plant.string->size());
        }
    }
    void finish() override { std::puts("done"); }
};

int main() {
    espalier::Scene scene;
    scene.plants.push_back(espalier::plant_of_text("lsystem: 1\nderivation length: 3\naxiom: A\nA --> AB\nendlsystem\n"));
    scene.plants.front().name = "row";
    espalier::World world(scene);
    Sizes sizes;
    world.attach(sizes);
    for (world.start(); !world.at_end();) world.step();
    sizes.finish();
}
