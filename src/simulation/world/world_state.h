// What a world consists of, for the files that implement it.
#pragma once

#include "espalier/base/read_log.h"
#include "espalier/environment/environment.h"
#include "espalier/simulation/world.h"

#include "simulation/plant/memory_budget.h"
#include "simulation/spread/plant_set.h"
#include "simulation/world/recording.h"
#include "simulation/world/review.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::simulation {

/// Adds the seconds of its life.
class Stopwatch {
public:
    explicit Stopwatch(double& seconds) : seconds_(seconds), begin_(std::chrono::steady_clock::now()) {}
    ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

private:
    double& seconds_;
    std::chrono::steady_clock::time_point begin_;
};

/// Where plants end, as derivation leaves it: of all ranks.
struct Ends {
    int longest = 0;  ///< derivation length of the plants
    bool stopped = false;
    std::size_t modules = 0;
};

/// Fields as turtles read them: what processes left after the step before.
struct FieldsForTurtles {
    std::vector<std::string> names;
    FieldValues values;         ///< while turtles walk, and after a restart until then
    bool has_restored = false;  ///< a world that was restarted has them from its checkpoint
    void take(const Fields& fields);
};

struct World::State {
    using Part = PlantSet::Part;
    using Stage = void (GrowingPlant::*)(ModuleString*);

    State(const Scene& described, const WorldOptions& options);

    // How it is made: world_making.cpp
    void make_environment();
    std::vector<GrowingPlant> make_plants(const std::filesystem::path& files);
    void place(std::vector<GrowingPlant> made, const WorldOptions& options);
    void require_waiting() const;
    DerivationSettings derivation_settings(const Plant& plant, const std::filesystem::path& files) const;
    void warn_of_likely_names(const Model& model, const std::string& plant);
    void share_out_memory();
    void set_lengths();

    // A step: world.cpp
    void begin_step();
    void grow(Stage stage);
    void derive(Part part, Stage stage);
    void place_births();
    void interpret(Part part);
    void walk(Part part);
    void exchange();
    void record();
    void end_step();

    void all_do(const std::function<void()>& work) { together(ranks, work); }
    Ends ends_here() const;
    void note_ends();
    void answer_queries();
    void store_answers();

    // Frames: frames.cpp
    void record_frame();
    std::vector<Part> pieces_of_frame();
    void record_parts();
    void record_pieces(std::span<const Part> pieces);
    void record_plants(std::span<const GrowingPlant> some, bool begins, bool ends_there, std::optional<int> piece = {});
    Frame frame_of(std::span<const GrowingPlant> some);
    std::vector<const Model*> models() const;

    void restore(std::istream& in);  // world_checkpoint.cpp
    void derive_all(Stage stage);    // staged_world.cpp

    std::size_t size() const { return scene.plants.size(); }
    double time() const { return step * scene.dt; }
    int last_step() const { return scene.last_frame.value_or(ends.longest); }
    bool is_at_end() const { return ends.stopped || step >= last_step(); }

    Scene scene;
    const std::shared_ptr<Printout> printout;
    Ranks* const ranks;                   ///< null: this process grows the world alone
    ReadLog* reads = ReadLog::current();  ///< log of the thread that makes the world
    const std::size_t budget;             ///< bytes for plants and fields
    MemoryBudget memory;
    Review review;
    std::unique_ptr<Environment> environment;
    std::unique_ptr<PlantSet> plants;
    FieldsForTurtles fields;
    Recording recording;

    bool exchanges = false;  ///< a process is there, or a model may ask the turtle
    bool is_looked_at;       ///< not only by recorders
    bool is_seen = true;     ///< turtles walk
    bool may_stop = false;   ///< models may end the run before its time
    bool is_drawn = false;   ///< recorders may read what is drawn of this step
    bool is_whole = true;    ///< it has seen all steps of the run
    bool has_begun = false;

    int step = 0;
    Ends ends;
    std::uint64_t births = 0;  ///< modules that were born so far, on all ranks
    StageTimes times;
    double busy = 0;      ///< seconds of work on the plants
    PlantSet::Sent sent;  ///< before the step
};

}  // namespace espalier::simulation
