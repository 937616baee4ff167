// A small run on disk: two plants, two frames, a field.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/geometry/openvdb_grid.h"

#include "timeline/frames.h"

#include <algorithm>
#include <optional>
#include <string>

namespace espalier {

using namespace espalier::archive;

inline constexpr const char* run_json =
    R"({"exit": "done", "scene": {"name": "handmade"}, "time_unit": "day", "dt": 0.5,
  "plants": [{"name": "left", "model": "a.l"}, {"name": "right", "model": "b.l"}]})";

inline Field light_field(float value) {
    initialize_openvdb();
    auto grid = openvdb::FloatGrid::create(0.25f);
    grid->setTransform(cell_centred_transform(0.5, {1, 2, 3}));
    grid->tree().setValue({0, 0, 0}, value);
    grid->tree().setValue({1, 2, 0}, 2 * value);
    return {"light", "1", "share of light", std::make_shared<FieldGrid>(FieldGrid{grid, {{0, 0, 0}, {1, 2, 0}}})};
}

/// The first internode of branched_plant().
inline HandmadePlant seedling() {
    HandmadePlant plant;
    plant.add_internode(1, 0, 0, 0, 0, {0, 0, 0}, {0, 1, 0}, 0.5);
    plant.add_query(4, {0, 1, 0}, 0.125);
    return plant;
}

/// Shapes whose surface 'l' is one flat patch, and whose texture 1 is a file.
inline std::shared_ptr<Shapes> square_leaf(const std::filesystem::path& texture) {
    auto shapes = std::make_shared<Shapes>();
    BicubicPatch patch;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) patch.points[i][j] = {double(j), double(i), 0};
    }
    shapes->surfaces['l'].patches.push_back(patch);
    shapes->textures = {{texture}};
    return shapes;
}

/// A run that is going: its first frame is there.
struct GoingRun {
    RunFolder folder;
    HandmadePlant plant = seedling();
    std::optional<Timeline> timeline;

    explicit GoingRun(const std::string& exit = "done") {
        timeline.emplace(folder.path, timeline_table(), 4);
        grow(0);
        std::string json = run_json;
        timeline->write_run(json.replace(json.find("done"), 4, exit));
    }
    void grow(int step) { record(*timeline, step, {&plant}); }
};

/// A branched plant that is a seedling at step 0, and one with a triangle 5 m beside it, with a field.
struct RecordedFolder {
    RunFolder folder;

    explicit RecordedFolder(const std::string& settings = "") {
        Timeline timeline(folder.path,
                          timeline_table("parameters = { vigour = \"F.2\", light = \"?E.1\" }\n"
                                         "fields = [\"light\"]\n" +
                                         settings),
                          4);
        const HandmadePlant young = seedling(), left = branched_plant();
        HandmadePlant right = branched_plant();
        right.number = 1;
        for (Internode& internode : right.interpretation.geometry.internodes) {
            internode.base.x += 5;
            internode.tip.x += 5;
        }
        right.add_triangle(50);
        for (std::size_t i = 0; i < right.string.size(); ++i) {  // it was there at step 0
            test::set_lineage(right.string, i, right.string.identity(i), right.string.parent(i), 0);
        }
        for (const int step : {0, 4}) {
            Fields fields;
            fields.provide(light_field(0.5f + static_cast<float>(step)));
            record(timeline, step, {step == 0 ? &young : &left, &right}, fields);
        }
        timeline.finish();
        timeline.write_run(run_json);
    }
};

}  // namespace espalier
