// Shared by the tests of models and experiments: grow a model alone, count its modules, run a scene.
#pragma once

#include "espalier/language/reader.h"
#include "espalier/lsystem/derivation.h"
#include "espalier/simulation/world.h"
#include "espalier/turtle/interpretation.h"
#include "espalier/turtle/view_file.h"

#include <map>
#include <memory>
#include <string>

namespace espalier {

inline std::filesystem::path source_path(const std::string& relative) {
    return std::filesystem::path(ESPALIER_SOURCE_DIR) / relative;
}

/// A plant without surroundings: only the turtle answers its queries.
struct LonePlant {
    std::shared_ptr<const Model> model;
    Derivation derivation;
    TurtleSettings turtle;
    ModuleString string;
    Interpretation interpretation;

    explicit LonePlant(const std::string& file, Defines defines = {}, std::uint64_t seed = 0)
        : LonePlant(View{}, file, std::move(defines), seed) {}

    /// With the functions, curves and turtle of a view.
    LonePlant(const View& view, const std::string& file, Defines defines = {}, std::uint64_t seed = 0)
        : model(read_model(
              source_path(file),
              {.defines = std::move(defines), .predefined = view.function_names, .resources = view.resources})),
          derivation(compile(model), settings_of(source_path(file), seed)),
          turtle(view.turtle) {
        derivation.start(string);
        look();
    }

    void grow(int steps) {
        for (int i = 0; i < steps; ++i) {
            ModuleString next;
            derivation.step(string, next);
            string = std::move(next);
            look();
        }
    }

    /// Modules of each symbol.
    std::map<std::string, int> counts() const {
        std::map<std::string, int> counts;
        for (LetterId letter : string.letters) ++counts[model->alphabet.name(letter)];
        return counts;
    }

    std::string text() const { return to_text(string, model->alphabet); }

private:
    static DerivationSettings settings_of(const std::filesystem::path& file, std::uint64_t seed) {
        DerivationSettings settings;
        settings.seed = seed;
        settings.input_folder = file.parent_path();
        settings.lineage = true;
        return settings;
    }

    void look() {
        interpretation = interpret(*model, string, turtle, &derivation);
        write_turtle_answers(interpretation, string);
    }
};

/// A scene grown to its end (or for `steps`), without a timeline.
inline std::unique_ptr<World> grown(const std::string& file, const SceneOptions& options = {}) {
    const Scene scene = read_scene(source_path(file), options);
    auto world = std::make_unique<World>(scene);
    world->start();
    while (!world->at_end()) world->step();
    return world;
}

}  // namespace espalier
