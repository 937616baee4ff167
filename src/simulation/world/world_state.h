// What a world consists of, for the files that implement it.
#pragma once

#include "espalier/base/read_log.h"
#include "espalier/environment/environment.h"
#include "espalier/simulation/world.h"

#include "base/scratch_file.h"
#include "simulation/plant/growing_plant.h"
#include "simulation/spread/spread.h"
#include "simulation/world/memory_budget.h"
#include "simulation/world/plant_store.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace espalier::simulation {

struct World::State {
    /// What the recorders of a run read.
    struct Recorded {
        bool anything = false, fields = false;
    };

    /// States of plants that other ranks hold.
    struct Gathered {
        struct Place {
            std::uint64_t at = 0;
            std::size_t size = 0;
        };
        ScratchFile states;
        std::vector<Place> of_plants;  ///< by number
    };

    State(const Scene& described, std::size_t bytes, const std::filesystem::path& files,
          std::shared_ptr<Printout> prints, Ranks* ranks);

    void all_do(const std::function<void()>& stage) { together(spread ? &spread->ranks() : nullptr, stage); }
    void begin_step();
    void end_step();
    void agree_on_ends();
    const Recorded& what_is_recorded();
    void restore(std::istream& in);

    void share_out_memory();
    void make_environment();
    void make_plants(const std::filesystem::path& files);
    void warn_of_likely_names(const Model& model, const std::string& plant);
    void set_lengths();
    DerivationSettings derivation_settings(const Plant& plant, const std::filesystem::path& files) const;
    double time() const { return step * scene.dt; }
    using Stage = void (GrowingPlant::*)(ModuleString*);
    void grow(Stage stage);
    void rewrite(std::span<GrowingPlant> some, Stage stage);
    void interpret(std::span<GrowingPlant> some);
    void wake(std::span<GrowingPlant> some);
    void rest(std::span<GrowingPlant> some);
    template <class Action>
    void for_waiting(std::span<GrowingPlant> some, const Action& action);
    bool reads_plants(bool may_end) const;
    void record();
    void record_waiting();
    void record_spread();
    void record_by_first();
    using Piece = std::span<GrowingPlant>;
    std::size_t points_per_file();
    std::vector<Piece> pieces_of_frame();
    Piece plants_between(std::size_t begin, std::size_t end);
    std::size_t parts() const { return static_cast<std::size_t>(spread->ranks().count()); }
    Piece part(std::size_t i) { return plants_between(plants.size() * i / parts(), plants.size() * (i + 1) / parts()); }
    void gather_states(const std::filesystem::path& folder);
    void record_pieces(std::span<const Piece> pieces);
    void give(std::span<const GrowingPlant> some, bool begins, bool ends, std::optional<int> piece = {}) const;
    Frame frame_of(std::span<const GrowingPlant> some) const;
    std::vector<const Model*> models() const;
    bool is_at_end() const { return stopped || step >= last_step(); }
    int last_step() const { return scene.last_frame.value_or(longest); }
    void note_ends();
    void place_births();
    void find_fields_read();
    void warn(Diagnostic warning);
    void warn_of_unasked();
    void warn_of_ignored();
    void warn_of_undrawn();
    void warn_of_never_asked();
    void review_run();
    void take_fields();
    void store_answers();
    void exchange();

    std::shared_ptr<Printout> printout;
    Scene scene;
    std::size_t budget;  ///< bytes for plants and fields
    MemoryBudget memory;
    bool exchanges = false;  ///< a process is there, or a model may ask the turtle
    bool is_seen = true;
    ReadLog* reads = ReadLog::current();  ///< log of the thread that makes the world
    std::vector<GrowingPlant> plants;
    std::unique_ptr<Environment> environment;
    std::unique_ptr<Spread> spread;        ///< null: all plants are here
    std::unique_ptr<PlantStore> store;     ///< null: all plants are in memory
    bool ends_at_will = false;             ///< models may end the run before its time
    bool is_drawn = false;                 ///< what is drawn of plants waits, too: recorders read this step's plants
    std::vector<std::string> fields_read;  ///< by turtles
    FieldValues fields;                    ///< while turtles walk, and after a restart until then
    bool has_restored_fields = false;
    bool is_whole = true;  ///< it has seen all steps of the run
    struct KnownModel {
        const Model* model;
        std::shared_ptr<const SymbolTable> symbols;
        unsigned ignored = 0;  ///< by turtles, and told
    };
    std::vector<KnownModel> known_models;
    std::vector<Recorder*> recorders;
    bool gets_only_pieces = false;                    ///< the recorder, as another rank has the run's
    std::optional<Recorded> recorded;                 ///< by the first rank; asked for once
    std::unique_ptr<Gathered> gathered;               ///< for a checkpoint of the first rank
    std::size_t modules_of_all = 0;                   ///< on all ranks
    bool is_saved = false;                            ///< before the step, for a checkpoint: plants may move
    double busy = 0;                                  ///< seconds of work on the plants since they might have moved
    std::uint64_t sent_messages = 0, sent_bytes = 0;  ///< before the step
    std::uint64_t births = 0;                         ///< modules that were born so far, on all ranks
    int step = 0;
    int longest = 0;  ///< derivation length of the plants
    bool stopped = false;
    StageTimes times;
    std::vector<Diagnostic> warnings;
    std::set<std::string> warned;  ///< what warn() has said
};

}  // namespace espalier::simulation
