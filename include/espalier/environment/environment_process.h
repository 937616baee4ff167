// A part of the world that answers queries. One file of its subject in src/environment/ per process.
#pragma once

#include "espalier/base/random.h"
#include "espalier/base/registry.h"
#include "espalier/base/settings.h"
#include "espalier/base/stations.h"
#include "espalier/environment/queries.h"
#include "espalier/geometry/field.h"
#include "espalier/turtle/interpretation.h"

#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::environment {

/// A plant as processes see it. `string` is the one that asked.
struct PlantView {
    std::uint32_t plant = 0;
    const Model* model = nullptr;
    const ModuleString* string = nullptr;
    const Interpretation* interpretation = nullptr;
    bool asks = true;  ///< false: there are no queries, not even to the turtle
    /// As geometry stages leave the plant and recorders show it; null: as the turtle does.
    const PlantGeometry* staged = nullptr;

    /// What light falls on. Queries come from where the turtle was.
    const PlantGeometry& drawn() const { return staged ? *staged : interpretation->geometry; }
};

/// The queries of plants that are not in memory, in place of those of their interpretations.
struct WaitingQueries {
    std::size_t count = 0;  ///< of all plants
    /// Of one plant; they may lie in `room`. Is called by several threads.
    std::function<std::span<const Query>(std::uint32_t plant, QueryColumn& room)> of;
};

class Environment;

/// The world at one step. `dt` is the time a derivation step stands for, in the scene's unit.
struct WorldView {
    int step = 0;
    double time = 0;
    double dt = 1;
    std::span<const PlantView> plants;
    const WaitingQueries* waiting = nullptr;  ///< null: all plants are in memory
    /// Whose processes before this one in the scene have advanced and answered; null outside an exchange.
    const Environment* environment = nullptr;
};

/// What a process knows when the world is made.
struct EnvironmentContext {
    std::string name;           ///< the process's name in the scene
    std::optional<Box> domain;  ///< the scene's domain, if it gives one
    std::uint64_t seed = 0;
    std::uint32_t plants = 0;              ///< how many plants the world has
    std::size_t memory = std::size_t(-1);  ///< bytes its fields may take at first; more is an error before allocating
    std::vector<Diagnostic>* warnings = nullptr;  ///< lasts as long as the process, and may grow in any step
};

/// One quantity of statistics.csv, "light.mean" being quantity "mean" of process "light".
/// The columns are the same in every step.
struct Quantity {
    std::string name;
    double value = 0;       ///< NaN where there is none, as the mean of no answers: an empty cell
    std::string unit = {};  ///< "": a number without one
};

/// A quantity that a process knows of each organ: "absorbed" of the process "light" is recorded as "light.absorbed".
struct OrganQuantity {
    std::string name;
    std::string unit = {};  ///< "": a number without one
    std::string meaning = {};
    int components = 1;  ///< 3 for directions
};

/// A number of a process's table that may change between steps.
struct ChangingSetting {
    std::string key;  ///< "strength"
    Range range;
    std::function<void(double)> set;
};

/// What the fields of a process take. The plants leave it room: as much, or twice as much if it may grow.
struct ProcessMemory {
    std::size_t held = 0;  ///< bytes
    bool grows = false;    ///< from step to step
};

/// What a process must know of plants that other ranks hold, where several ranks grow a world together: see Ranks.
enum class Spreading {
    refused,  ///< it cannot be spread
    reach,    ///< queries that change answers here, by EnvironmentProcess::reach(); it keeps nothing between steps
    queries,  ///< all queries: every rank answers for the whole world
    plants,   ///< all queries, all strings, and all that is drawn
};

/// What a process is besides which reads each query by itself. Of plants that are not in memory it is given parts of
/// the queries, each of whole plants, and memory holds no more than one part. In a step, in this order: `begin`; `take`
/// for each part; `settle`; `answer_part` for each part again.
class TakesParts {
public:
    virtual ~TakesParts() = default;
    virtual void begin() = 0;
    virtual void take(Queries part) = 0;
    virtual void settle() = 0;
    virtual void answer_part(Queries part, std::span<Answer> answers) = 0;
};

/// Constructors take (Settings&, const EnvironmentContext&, Fields&), read their parameters (the scene rejects unread
/// ones) and provide their fields. Order inside a step: `advance`, then `answer`, each once; then fields and statistics
/// are recorded. Answers do not depend on the order of the queries, nor on the number of threads.
class EnvironmentProcess {
public:
    virtual ~EnvironmentProcess() = default;

    /// Brings the fields on by one `dt`; step 0 is the beginning. The queries are its own, in plant and string order.
    virtual void advance(const WorldView&, Queries, Fields&) {}

    /// Answers the whole batch; answers[i] belongs to queries[i] and begins as a copy of its parameters.
    virtual void answer(const WorldView& world, Queries queries, std::span<Answer> answers, Fields& fields) = 0;

    /// This process, if it takes its queries in parts as well.
    virtual TakesParts* in_parts() { return nullptr; }

    /// What keyframes of a scene may change: they set it before `advance`. All other settings stay.
    virtual std::vector<ChangingSetting> changing_settings() { return {}; }

    /// This step's figures for a plant, by number. Quantities of the whole world repeat for every plant.
    virtual std::vector<Quantity> statistics(std::uint32_t) const { return {}; }

    /// What `organ_values` knows; the same in every step.
    virtual std::vector<OrganQuantity> organ_quantities() const { return {}; }
    /// This step's values of one of them for a plant, by number: `components` for each module of its string, NaN where
    /// there is none. Null if the plant is unknown.
    virtual std::shared_ptr<const std::vector<float>> organ_values(const std::string&, std::uint32_t) const {
        return nullptr;
    }

    /// Fewest and most parameters a query to this process may have, for `check` and for a clear error.
    virtual std::pair<int, int> query_arity() const = 0;

    /// Nothing where all that a process keeps is small beside the plants.
    virtual ProcessMemory memory() const { return {}; }
    /// Bytes that the fields of a process which grows may take in this step. More is a RunError before allocating.
    virtual void limit_memory(std::size_t) {}

    virtual Spreading spreading() const { return Spreading::refused; }
    /// Where other queries may be whose answers this one changes, metres; empty: nowhere. For Spreading::reach.
    virtual Box reach(const Query&) const { return {}; }

    /// What lasts from step to step, as bytes, for a checkpoint.
    virtual void save(std::ostream&) const {}
    virtual void restore(std::istream&) {}
};

/// What the file of a process registers.
struct ProcessType {
    std::string name;     ///< what scenes say: process = "..."
    std::string summary;  ///< a line
    std::string help;     ///< what a query is answered; parameters with units and defaults
    std::function<std::unique_ptr<EnvironmentProcess>(Settings&, const EnvironmentContext&, Fields&)> make;
    /// It reads the key `numbers`: "cpfg" makes it answer what cpfg's program of the same name answers.
    bool has_numbers_of_cpfg = false;
};

}  // namespace espalier::environment
