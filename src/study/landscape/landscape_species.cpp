#include "study/landscape/landscape_species.h"

#include "archive/landscape/cover.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace espalier::study {
namespace {

namespace fs = std::filesystem;

/// Textures by paths that hold wherever one stands.
void find_textures(LandscapeSpecies& species, const fs::path& run) {
    std::error_code ignored;
    for (FrameMesh& mesh : species.levels) {
        for (MeshMaterial& material : mesh.materials) {
            const fs::path beside = run / material.texture;
            if (!material.texture.empty() && fs::is_regular_file(beside, ignored)) material.texture = beside.string();
        }
    }
}

std::string free_name(const std::string& wanted, const std::vector<LandscapeSpecies>& species) {
    const auto is_taken = [&](const std::string& name) {
        return std::any_of(species.begin(), species.end(), [&](const auto& other) { return other.name == name; });
    };
    std::string name = wanted;
    for (int number = 2; is_taken(name); ++number) name = fmt::format("{}-{}", wanted, number);
    return name;
}

}  // namespace

RunAndFrame last_frame(const Settings& settings) {
    return blamed_on(settings, "run", [&]() -> RunAndFrame {
        RecordedRun run(settings.path("run"));
        const auto& frames = run.frames();
        const auto drawn = std::find_if(frames.rbegin(), frames.rend(),
                                        [](const RecordedFrame& frame) { return !frame.plants.empty(); });
        if (drawn == frames.rend()) throw UserError(fmt::format("{}: no plants were recorded", run.folder().string()));
        FrameGeometry geometry = run.geometry(*drawn);
        return {std::move(run), std::move(geometry)};
    });
}

void SpeciesOfFile::read(const Settings& entry, int number, const LevelDistances& distances) {
    RunAndFrame plant = last_frame(entry);
    const std::string name = free_name(entry.text_or("name", plant.run.folder().filename().string()), species);
    const double radius = entry.number_or("radius", 0, Range::not_negative());
    species.push_back(blamed_on(entry, "run", [&] {
        return species_of(plant.geometry, name, number, radius > 0 ? std::optional(radius) : std::nullopt, distances);
    }));
    find_textures(species.back(), plant.run.folder());
    if (!first_run) first_run = std::move(plant.run);
}

void read_covers(const Settings& settings, SpeciesOfFile& of_file, std::vector<StandPlant>& stand,
                 const glm::dvec3& eye, const LevelDistances& distances, std::uint64_t seed) {
    int number = -1;  // colours of a stand are not below 0
    for (const Settings& entry : settings.tables("cover")) {
        const double density = entry.number("density", Range::positive());
        const double distance = entry.number_or("distance", 60, Range::positive());
        const double size = entry.number_or("size", 1, Range::positive());
        const double cards = entry.number_or("cards", 12, Range::not_negative());
        of_file.read(entry, number, distances);
        of_file.species.back().cards = cards;
        const Cover cover{number, density, distance, size * of_file.species.back().radius};
        const auto plants = blamed_on(entry, "density", [&] { return plants_of(cover, eye, seed); });
        stand.insert(stand.end(), plants.begin(), plants.end());
        --number;
    }
}

}  // namespace espalier::study
