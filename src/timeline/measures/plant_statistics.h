// What statistics.csv says of a plant at a step.
#pragma once

#include "espalier/timeline/frame.h"

#include "timeline/measures/module_quantities.h"

#include <cstdint>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace espalier::timeline {

/// Names of the quantities that processes tell of a plant.
std::vector<std::string> quantity_names(const PlantFrame& plant);

/// Columns: modules (of the string, brackets included); queries; internodes; organs (polygons included); length (m, of
/// all internodes); height (m, highest point above the base of the first internode); volume (m3, of all internodes);
/// born, died (modules since the step before, brackets included; NaN where strings keep no lineage); then the
/// quantities of processes and those that `timeline` names.
class PlantStatistics {
public:
    /// `timeline`: a scene's [timeline], for its `quantities`. Throws UserError for one that is none.
    explicit PlantStatistics(const Settings& timeline) : own_(timeline.table("quantities")) {}

    /// Throws UserError for quantities of symbols that no model has.
    void require_known(const Frame& frame) const { own_.require_known(frame.models); }
    /// `quantities`: names of those of processes.
    std::vector<std::string> columns(const std::vector<std::string>& quantities) const;
    /// Every step of a plant must be asked for, once and in order.
    std::vector<double> of(const PlantFrame& plant);
    /// After all plants of a step.
    void end_step(const Frame& frame) { previous_step_ = frame.step; }
    int previous_step() const { return previous_step_; }  ///< -1 before the first

    /// Without the step, which `restore` is given.
    void save(std::ostream& out) const;
    void restore(std::istream& in, int previous_step);

private:
    ModuleQuantities own_;
    std::map<std::uint32_t, std::size_t> modules_;  ///< per plant, one step ago
    int previous_step_ = -1;
};

}  // namespace espalier::timeline
