// How the plants of a step become a frame of the recorders: at once, or in parts where some are elsewhere.
#include "simulation/world/world_state.h"
#include "timeline/frames/frame_cut.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace espalier::simulation {
namespace {

// A file names the textures and the symbols of all plants that were shown before. Who sees only some of the pieces
// knows them where there are no textures and the models stay. Backgrounds are read from all plants at once.
bool needs_one_writer(const GrowingPlant& plant) {
    if (!plant.is_local) return false;
    const Plant& described = *plant.description;
    const Shapes* const shapes = plant.drawn().geometry.shapes.get();
    const bool has_textures = shapes && !shapes->textures.empty();
    const bool has_background = described.view && described.view->background;
    return has_textures || has_background || described.in_time || described.drawing_in_time;
}

}  // namespace

void World::State::record_frame() {
    if (!recording.reads_plants_at(step, is_at_end())) {
        return all_do([&] { record_plants(plants->all(), /*begins=*/true, /*ends=*/true); });
    }
    const std::vector<Part> pieces = pieces_of_frame();
    pieces.size() > 1 ? record_pieces(pieces) : record_parts();
}

// What each file of the frame shows, if several ranks can write them; else nothing.
std::vector<World::State::Part> World::State::pieces_of_frame() {
    if (plants->writers() == 1) return {};
    const std::span<GrowingPlant> all = plants->all();
    const std::size_t most_points = recording.points_per_file(std::none_of(all.begin(), all.end(), needs_one_writer));
    if (most_points == 0) return {};
    const std::vector<std::size_t> points = plants->points();
    std::vector<Part> pieces;
    std::size_t begin = 0;
    FrameCut cut(most_points);
    for (std::size_t plant = 0; plant < all.size(); ++plant) {
        if (!cut.is_before(points[plant])) continue;
        pieces.push_back(all.subspan(begin, plant - begin));
        begin = plant;
    }
    pieces.push_back(all.subspan(begin));
    return pieces;
}

// The first rank sees all plants, part by part, so that it holds no more of them at once than growth does.
void World::State::record_parts() {
    const std::vector<Part> parts = plants->frame_parts();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        plants->show(std::span(&parts[i], 1), *environment, step);
        all_do([&] { record_plants(parts[i], i == 0, i + 1 == parts.size()); });
        plants->hide();
    }
}

// Each rank sees the plants of one piece at a time and writes it. When all are written, the first one names them.
void World::State::record_pieces(std::span<const Part> pieces) {
    const std::size_t writers = plants->writers();
    const auto rank = static_cast<std::size_t>(ranks->rank());
    for (std::size_t first = 0; first < pieces.size(); first += writers) {
        const std::span<const Part> shown = pieces.subspan(first, std::min(writers, pieces.size() - first));
        const Part own = rank < shown.size() ? shown[rank] : Part();
        plants->show(shown, *environment, step);
        all_do([&] {
            if (!own.empty()) record_plants(own, first == 0, /*ends=*/false, static_cast<int>(first + rank));
        });
        plants->hide();
    }
    all_do([&] {
        if (is_first(ranks)) record_plants({}, /*begins=*/false, /*ends=*/true, static_cast<int>(pieces.size()));
    });
}

void World::State::record_plants(std::span<const GrowingPlant> some, bool begins, bool ends_there,
                                 std::optional<int> piece) {
    if (!recording.takes(piece)) return;
    Frame frame = frame_of(some);
    frame.begins = begins;
    frame.ends = ends_there;
    frame.piece = piece;
    if (begins) frame.models = models();
    recording.record(frame);
}

Frame World::State::frame_of(std::span<const GrowingPlant> some) {
    Frame frame{step, time(), {}, &environment->fields(), is_at_end(), environment.get()};
    frame.dt = scene.dt;
    frame.time_unit = scene.time_unit;
    frame.plants.reserve(some.size());
    for (const GrowingPlant& plant : some) frame.plants.push_back(plant.frame(plants->statistics(*environment, plant)));
    return frame;
}

// Neighbours mostly share theirs; but each plant may have its own.
std::vector<const Model*> World::State::models() const {
    std::vector<const Model*> models;
    std::unordered_set<const Model*> seen;
    for (const GrowingPlant& plant : plants->all()) {
        const Model* const model = &plant.model();
        if (!models.empty() && models.back() == model) continue;
        if (seen.insert(model).second) models.push_back(model);
    }
    return models;
}

}  // namespace espalier::simulation
