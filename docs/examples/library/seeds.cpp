#include <espalier/simulation/world.h>

#include <algorithm>
#include <cstdio>
#include <thread>
#include <vector>

const char* const bush = R"(
#define fork 0.5
lsystem: bush
seed: 1
derivation length: 12
axiom: A
A --> F(1)B : fork
A --> F(1)A : 1 - fork
B --> [+(30)A][-(30)A]
endlsystem
)";

// The internodes of a bush: the same for the same seed, whatever grows beside it.
std::size_t internodes(std::uint64_t seed, double fork) {
    espalier::Scene scene;
    scene.seed = seed;
    scene.plants.push_back(espalier::plant_of_text(bush, "bush", {{"fork", std::to_string(fork)}}));
    espalier::World world(scene);
    for (world.start(); !world.at_end();) world.step();
    return world.interpretation(0).geometry.internodes.size();
}

int main() {
    for (const double fork : {0.25, 0.5, 0.75}) {
        std::vector<std::size_t> counts(8);
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            threads.emplace_back([&counts, fork, i] { counts[i] = internodes(i + 1, fork); });
        }
        for (std::jthread& thread : threads) thread.join();
        std::sort(counts.begin(), counts.end());
        std::printf("fork %.2f: %zu to %zu internodes\n", fork, counts.front(), counts.back());
    }
}
