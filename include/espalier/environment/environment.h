// The environment of a world: its processes and their fields, and the exchange of one step.
#pragma once

#include "espalier/environment/environment_process.h"

#include <memory>
#include <string>
#include <vector>

namespace espalier {

class Environment {
public:
    /// Makes the processes of `tables` (the scene's [environment.<name>] tables) in the given order.
    /// Throws UserError for an unknown process or parameter.
    Environment(const std::vector<std::pair<std::string, Settings>>& tables, const EnvironmentContext& context);

    std::size_t size() const { return processes_.size(); }
    const std::string& name(std::size_t process) const { return names_[process]; }
    std::optional<std::size_t> find(const std::string& name) const;
    const Fields& fields() const { return fields_; }

    /// The process that answers ?E: the one named, or the only one. Throws UserError if there is no such process.
    void set_default(const std::string& name);
    std::optional<std::size_t> default_process() const { return default_; }

    /// Throws UserError if `model` declares a process the scene lacks, or asks ?E where none is default.
    void require_answers(const Model& model, const std::string& plant_name) const;

    /// One exchange: all queries of all plants in plant order then string order; every process in scene order advances
    /// once and answers its batch; answers go into the parameters of `strings[i]` (of plant i). Nothing else changes.
    /// An answer that is NaN or infinite throws RunError.
    void exchange(const WorldView& world, std::span<ModuleString*> strings);

    /// Quantities of all processes for one plant, named "process.quantity", in scene order.
    std::vector<Quantity> statistics(std::uint32_t plant) const;

    void save(std::ostream& out) const;
    void restore(std::istream& in);

private:
    std::vector<std::string> names_;
    std::vector<std::unique_ptr<EnvironmentProcess>> processes_;
    Fields fields_;
    std::optional<std::size_t> default_;
};

}  // namespace espalier
