// A world and another that goes on from its checkpoint.
#pragma once

#include "espalier/simulation/world_checkpoint.h"

#include <sstream>

namespace simulation_test {

struct ResumedWorld {
    /// Both are at the step.
    ResumedWorld(const espalier::Scene& scene, int step) : through(scene), resumed(scene) {
        through.start();
        for (int done = 0; done < step; ++done) through.step();
        std::stringstream saved;
        espalier::WorldCheckpoint(through).save(saved);
        espalier::WorldCheckpoint(resumed).restore(saved);
    }
    void step() {
        through.step();
        resumed.step();
    }

    espalier::World through, resumed;
};

}  // namespace simulation_test
