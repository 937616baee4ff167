// The environment of a world: its processes and their fields, and the exchange of one step.
#pragma once

#include "espalier/base/column.h"
#include "espalier/base/stations.h"
#include "espalier/environment/environment_process.h"

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace espalier::environment {

class Communication;

/// True if the model may write ?E, or declares a process without a default: something must answer.
bool needs_processes(const Model& model);

class Environment {
public:
    /// Makes the processes of `tables` (the scene's [environment.<name>] tables) in the given order, which share the
    /// memory of the context. Throws UserError for an unknown process or parameter.
    Environment(const std::vector<std::pair<std::string, Settings>>& tables, const EnvironmentContext& context);
    ~Environment();
    Environment(Environment&&) noexcept;
    Environment& operator=(Environment&&) noexcept;

    std::size_t size() const { return processes_.size(); }
    const std::string& name(std::size_t process) const { return names_[process]; }
    std::optional<std::size_t> find(const std::string& name) const;
    const Fields& fields() const { return fields_; }

    /// The process that answers ?E: the one named, or the only one. Throws UserError if there is no such process.
    void set_default(const std::string& name);
    std::optional<std::size_t> default_process() const { return default_; }
    /// ?E(k, ...) asks the k-th process, counted from 0, which sees and answers the parameters after the first.
    void route_by_first_parameter() { routed_ = true; }
    /// Queries that no process answers keep their parameters, instead of being mistakes.
    void keep_unanswered() { keeps_unanswered_ = true; }

    /// What may change between steps of a process.
    std::vector<ChangingSetting> changing_settings(std::size_t process) {
        return processes_[process]->changing_settings();
    }

    /// Throws UserError if `model` declares a process that the scene lacks and that has no default, or asks ?E where
    /// no process is the scene's default.
    void require_answers(const Model& model, const std::string& plant_name) const;
    /// The processes of the model that the scene lacks: queries to them are answered the model's defaults.
    std::vector<std::string> answered_by_default(const Model& model) const;

    /// The processes that strings of the model may query.
    std::set<std::size_t> may_ask(const Model& model) const;
    /// True if a query has come to the process since the beginning, or since the restart.
    bool was_asked(std::size_t process) const { return asked_[process]; }
    /// True if the process measures organs, asked or not.
    bool measures_organs(std::size_t process) const { return !processes_[process]->organ_quantities().empty(); }

    /// One exchange: all queries of all plants in plant order then string order; every process in scene order advances
    /// once and answers its batch; answers go into the parameters of `strings[i]` (of plant i). Nothing else changes.
    /// An answer that is NaN or infinite throws RunError.
    void exchange(const WorldView& world, std::span<ModuleString*> strings);

    /// The process that is answering now, and which consultation of the run this is.
    struct Consultation {
        const std::string* process = nullptr;  ///< null: none is answering
        std::uint64_t number = 0;
    };
    /// Another thread may ask at any time.
    Consultation consultation() const;

    /// Quantities of all processes for one plant, named "process.quantity", in scene order.
    std::vector<Quantity> statistics(std::uint32_t plant) const;

    /// One of them; NaN for an unknown name.
    double statistic(const std::string& name, std::uint32_t plant) const;

    /// What processes know of each organ, named "process.quantity", in scene order.
    std::vector<OrganQuantity> organ_quantities() const;
    /// Values of one of them for a plant's modules, see EnvironmentProcess; null for an unknown name or plant.
    std::shared_ptr<const std::vector<float>> organ_values(const std::string& name, std::uint32_t plant) const;

    /// What the process must know of plants that other ranks hold.
    Spreading spreading(std::size_t process) const;
    /// As the process says.
    Box reach(std::size_t process, const Query& query) const { return processes_[process]->reach(query); }
    /// The process that will answer; none: the query keeps its parameters. Throws UserError and RunError, as
    /// exchange().
    std::optional<std::size_t> process_of(const Query& query, const PlantView& plant, int step);

    /// Of plants that are not in memory, an exchange reads the queries in parts, and never holds all of them.
    bool takes_parts() const { return taker_of_parts() != nullptr; }

    /// Bytes that plants must leave to the fields of processes until the next exchange.
    std::size_t memory_kept() const;
    /// What all fields together may take from the next exchange on.
    void limit_memory(std::size_t bytes);

    void save(std::ostream& out) const;
    void restore(std::istream& in);

private:
    /// The questions to one process and its answers, their memory reused from step to step.
    struct Batch {
        Queries queries;                      ///< what the process sees
        Column<const Query*> places;          ///< of many plants: where they were asked
        QueryColumn copies;                   ///< the questions, if they cannot be read where they were asked
        std::vector<std::size_t> parameters;  ///< how many each block of queries has; empty: not counted
        Column<double> values;                ///< the answers, one after the other
        Column<double> sent;                  ///< the parameters as the process sees them, if they are rounded
        std::vector<Answer> answers;
    };

    struct Answering;

    TakesParts* taker_of_parts() const;
    void exchange_in_parts(TakesParts& taker, const WorldView& world, std::span<ModuleString*> strings);
    template <class Use>
    void for_parts(const WorldView& world, const Use& use);
    template <class Work>
    void have_work(std::size_t process, int step, const Work& work);
    template <class Use>
    void for_plants(const WorldView& world, const Use& use) const;
    void gather(const WorldView& world);
    void forget();
    bool borrow(const WorldView& world);
    void make_room(const WorldView& world);
    bool copies(const WorldView& world) const;
    void gather(const PlantView& plant, std::span<const Query> queries, const WorldView& world);
    const Query& copy(const Query& asked, Batch& batch) const;
    void write_defaults(std::span<ModuleString*> strings) const;
    void name_processes(const PlantView& plant);
    std::optional<std::size_t> process_for(const Query& query, const PlantView& plant, int step) const;
    bool is_routed(const Query& query) const;
    static void begin_answers(Batch& batch);
    void send(std::size_t process);
    void throw_unsound(const Query& query, std::size_t process, const PlantView& plant, int step) const;
    void consult(std::size_t process, const WorldView& world);
    void round_answers(std::size_t process);
    void require_finite(std::size_t process, const WorldView& world) const;
    static void write_answers(const Batch& batch, std::span<ModuleString*> strings);
    void note_memory();

    std::vector<std::string> names_;
    std::vector<std::string> kinds_;  ///< what each process is: "voxel-shade"
    std::vector<std::unique_ptr<EnvironmentProcess>> processes_;
    std::vector<std::pair<int, int>> arities_;
    std::vector<std::size_t> kept_;  ///< bytes of memory, for each process
    std::vector<bool> asked_;
    std::vector<Communication> communications_;
    Fields fields_;
    std::optional<std::size_t> default_;
    bool routed_ = false;
    bool keeps_unanswered_ = false;
    std::unique_ptr<Answering> answering_;
    std::vector<Batch> batches_;  ///< one per process
    /// What models say of a query that no process answers.
    struct DefaultAnswer {
        std::uint32_t plant;
        std::size_t parameters_at;
        std::span<const double> values;
    };
    std::vector<DefaultAnswer> defaults_;
    std::vector<std::optional<std::size_t>> by_name_;  ///< process of each name that `last_model_` declares
    const Model* last_model_ = nullptr;
};

}  // namespace espalier::environment
