// How the plants of a step become a frame of the recorders: at once, or in parts where some are elsewhere.
#include "geometry/drawn/mesh_size.h"
#include "simulation/world/world_state.h"
#include "timeline/frames/frame_cut.h"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <utility>

namespace espalier::simulation {
namespace {

// A file names the textures and the symbols of all plants that were shown before. Who sees only some of the pieces
// knows them where there are no textures and the models stay. Backgrounds are read from all plants at once.
bool needs_one_writer(const GrowingPlant& plant) {
    if (!plant.is_here) return false;
    const Plant& described = *plant.description;
    const Shapes* const shapes = plant.drawn().geometry.shapes.get();
    const bool has_textures = shapes && !shapes->textures.empty();
    const bool has_background = described.view && described.view->background;
    return has_textures || has_background || described.in_time || described.drawing_in_time;
}

}  // namespace

bool World::State::reads_plants(bool may_end) const {
    return !gets_only_pieces && std::any_of(recorders.begin(), recorders.end(), [&](const Recorder* recorder) {
        return recorder->reads_plants_at(step, may_end);
    });
}

// The first rank has the recorders.
const World::State::Recorded& World::State::what_is_recorded() {
    if (recorded) return *recorded;
    Ranks* const ranks = &spread->ranks();
    const auto any_recorder = [&](const auto& is_one) {
        return any(ranks, std::any_of(recorders.begin(), recorders.end(), is_one));
    };
    Recorded found;
    found.anything = any_recorder([](const Recorder*) { return true; });
    found.fields = any_recorder([](const Recorder* recorder) { return !recorder->fields().empty(); });
    return recorded.emplace(found);
}

void World::State::record() {
    if (spread && any(&spread->ranks(), reads_plants(is_at_end()))) return record_spread();
    all_do([&] {
        if (store && is_drawn) return record_waiting();
        give(plants, /*begins=*/true, /*ends=*/true);
    });
}

void World::State::record_spread() {
    const std::vector<Piece> pieces = pieces_of_frame();
    pieces.size() > 1 ? record_pieces(pieces) : record_by_first();
}

// What every rank can write; 0: one must read all plants.
std::size_t World::State::points_per_file() {
    const bool is_possible = recorders.size() == 1 && std::none_of(plants.begin(), plants.end(), needs_one_writer);
    std::size_t points = is_possible ? recorders.front()->points_per_file() : 0;
    for (const std::string& told : from_all(&spread->ranks(), std::to_string(points))) {
        points = std::min<std::size_t>(points, std::stoull(told));
    }
    return points;
}

// What each file of the frame shows, if all ranks can write them; else nothing.
std::vector<World::State::Piece> World::State::pieces_of_frame() {
    const std::size_t most_points = points_per_file();
    if (most_points == 0) return {};
    const std::vector<double> points = spread->of_each(
        plants, [](const GrowingPlant& plant) { return static_cast<double>(points_foreseen(plant.drawn().geometry)); });
    std::vector<Piece> pieces;
    std::size_t begin = 0;
    FrameCut cut(most_points);
    for (std::size_t plant = 0; plant < plants.size(); ++plant) {
        if (!cut.is_before(static_cast<std::size_t>(points[plant]))) continue;
        pieces.push_back(plants_between(std::exchange(begin, plant), plant));
    }
    pieces.push_back(plants_between(begin, plants.size()));
    return pieces;
}

World::State::Piece World::State::plants_between(std::size_t begin, std::size_t end) {
    return std::span(plants).subspan(begin, end - begin);
}

// The first rank gets the plants of the others part by part, so that it holds no more of them than of its own.
void World::State::record_by_first() {
    for (std::size_t i = 0; i < parts(); ++i) {
        const Piece some = part(i);
        spread->deal(std::span(&some, 1), *environment, step);
        all_do([&] {
            memory.check_received(some, step);
            give(some, i == 0, i + 1 == parts());
        });
        spread->forget(some);
    }
}

// Each rank gets the plants of one piece at a time and writes it. When all are written, the first one names them.
void World::State::record_pieces(std::span<const Piece> pieces) {
    const auto ranks = static_cast<std::size_t>(spread->ranks().count());
    const auto rank = static_cast<std::size_t>(spread->ranks().rank());
    for (std::size_t first = 0; first < pieces.size(); first += ranks) {
        const std::span<const Piece> dealt = pieces.subspan(first, std::min(ranks, pieces.size() - first));
        const Piece own = rank < dealt.size() ? dealt[rank] : Piece();
        spread->deal(dealt, *environment, step);
        all_do([&] {
            memory.check_received(own, step);
            if (!own.empty()) give(own, first == 0, /*ends=*/false, static_cast<int>(first + rank));
        });
        spread->forget(own);
    }
    all_do([&] {
        if (spread->is_first()) give({}, /*begins=*/false, /*ends=*/true, static_cast<int>(pieces.size()));
    });
}

void World::State::give(std::span<const GrowingPlant> some, bool begins, bool ends, std::optional<int> piece) const {
    if (recorders.empty() || (gets_only_pieces && !piece)) return;
    Frame frame = frame_of(some);
    frame.begins = begins;
    frame.ends = ends;
    frame.piece = piece;
    if (begins) frame.models = models();
    for (Recorder* recorder : recorders) recorder->record(frame);
}

Frame World::frame() const {
    Frame frame = state_->frame_of(state_->plants);
    frame.models = state_->models();
    return frame;
}

Frame World::frame_of_plants() const {
    Frame frame{state_->step, state_->time(), {}, nullptr, state_->is_at_end(), nullptr};
    for (const GrowingPlant& plant : state_->plants) frame.plants.push_back(plant.frame({}));
    frame.models = state_->models();
    return frame;
}

Frame World::State::frame_of(std::span<const GrowingPlant> some) const {
    Frame frame{step, time(), {}, &environment->fields(), is_at_end(), environment.get()};
    frame.dt = scene.dt;
    frame.time_unit = scene.time_unit;
    frame.plants.reserve(some.size());
    for (const GrowingPlant& plant : some) {
        frame.plants.push_back(
            plant.frame(spread ? spread->statistics(*environment, plant) : environment->statistics(plant.number)));
    }
    return frame;
}

// Neighbours mostly share theirs; but each plant may have its own.
std::vector<const Model*> World::State::models() const {
    std::vector<const Model*> models;
    std::unordered_set<const Model*> seen;
    for (const GrowingPlant& plant : plants) {
        const Model* const model = &plant.model();
        if (!models.empty() && models.back() == model) continue;
        if (seen.insert(model).second) models.push_back(model);
    }
    return models;
}

}  // namespace espalier::simulation
