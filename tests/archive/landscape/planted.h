// A small tree of a recorded run as a species, and stands of it.
#pragma once

#include "archive/landscape/landscape.h"
#include "archive/recorded_folder.h"
#include "formats/small_tree.h"

namespace espalier {

inline FrameGeometry recorded(const HandmadePlant& plant) {
    RunFolder folder;
    Timeline timeline(folder.path, timeline_table(), 0);
    record(timeline, 0, {&plant});
    timeline.finish();
    timeline.write_run(run_json);
    const RecordedRun run(folder.path);
    return run.geometry(run.frame(0));
}

inline const LevelDistances few_levels{{0, 20, 60}, 200};

inline LandscapeSpecies small_species(int colour = 1) {
    return species_of(recorded(SmallTree().plant), "tree", colour, std::nullopt, few_levels);
}

inline Terrain flat_terrain(double half = 500) {
    return Terrain({-half, -half}, {half, half}, {9, 9}, [](double, double) { return 0; });
}

}  // namespace espalier
