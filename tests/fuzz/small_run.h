// A small scene with everything that runs record, for fuzz targets.
#pragma once

#include "espalier/simulation/scene.h"
#include "espalier/simulation/simulation.h"

#include "../temporary_folder.h"

#include <filesystem>
#include <string>

namespace fuzz {

/// Plants that ask for light and water, and write a file.
class SmallScene {
public:
    SmallScene() {
        folder_.write("plant.l", R"(environment light, water;
lsystem: 1
define: { array count[2]; }
Start: { log = fopen("log.txt", "w"); }
EndEach: { total = total + count[0]; fprintf(log, "%g\n", total); }
seed: 5
derivation length: 4
axiom: ;(1)A(1)?light(1)[&(180)R?water(0.001,0,0,0)]
A(x) : x > 0.2 --> F(x)[+A(x*0.7)?light(0.5)]A(x*0.9) : 2
A(x) : x > 0.2 --> F(x)[-A(x*0.8)]A(x*0.85)?light(0) : 1
R --> F(0.05)[+(20)R]R
endlsystem
)");
        scene_ = espalier::read_scene_text(text(), "scene.toml", folder_.path());
    }

    const espalier::Scene& scene() const { return scene_; }
    const std::filesystem::path& folder() const { return folder_.path(); }
    std::filesystem::path run_folder() const { return folder_.path() / "run"; }

    /// Records it below the folder.
    void record() const {
        espalier::RunOptions options;
        options.output = run_folder();
        options.arguments = {"scene.toml"};
        espalier::run(scene_, options);
    }

private:
    static std::string text() {
        return R"([simulation]
seed = 5
[[plant]]
model = "plant.l"
positions = [[0, 0, 0], [0.5, 0, 0]]
[environment.light]
process = "voxel-shade"
voxel = 0.5
[environment.water]
process = "soil-water"
voxel = 0.5
domain = { lower = [-1, -1, -1], upper = [1, 0, 1] }
diffusion = 0.01
initial = 0.3
[timeline]
fields = ["light"]
field_files = ["vti", "vdb"]
)";
    }

    TemporaryFolder folder_;
    espalier::Scene scene_;
};

}  // namespace fuzz
