// The species of a landscape's file, each the last frame of a recorded run.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/base/error.h"
#include "espalier/base/settings.h"

#include "archive/landscape/landscape.h"

#include <optional>
#include <string>
#include <vector>

namespace espalier::study {

/// Where and what is said of it, if something is wrong with what a key names.
template <class Work>
auto blamed_on(const Settings& settings, const char* key, const Work& work) {
    try {
        return work();
    } catch (const UserError& error) {
        if (!error.diagnostics().empty() && error.diagnostics().front().place.known()) throw;
        throw UserError(settings.place(key), error.what());
    }
}

/// The run that a key names, and the last frame of its plants.
struct RunAndFrame {
    RecordedRun run;
    FrameGeometry geometry;
};
RunAndFrame last_frame(const Settings& settings);

struct SpeciesOfFile {
    std::vector<LandscapeSpecies> species;
    std::optional<RecordedRun> first_run;

    /// Reads `run`, `name` and `radius` of a table. Files name meshes and cards after species: a second species of a
    /// name has a number.
    void read(const Settings& entry, int number, const LevelDistances& distances);
};

/// Reads the [[cover]] tables: their species, and their plants into the stand. Their colours are below 0.
void read_covers(const Settings& settings, SpeciesOfFile& of_file, std::vector<StandPlant>& stand,
                 const glm::dvec3& eye, const LevelDistances& distances, std::uint64_t seed);

}  // namespace espalier::study
