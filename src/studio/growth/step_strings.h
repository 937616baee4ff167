// The strings of one step and what derivation remembered with them: in memory, or in a file.
#pragma once

#include "espalier/simulation/staged_world.h"

#include "studio/growth/reuse_plan.h"
#include "studio/growth/spool.h"

#include <memory>
#include <vector>

namespace espalier::studio {

/// Never changes, so that growths may share it.
class StepStrings {
public:
    /// `origin` may be null if no growth will go on from them.
    StepStrings(DerivedStep derived, std::shared_ptr<const Origin> origin)
        : derived_(std::move(derived)), origin_(std::move(origin)) {}

    /// The same in a file. Throws RunError if the disk is full.
    std::shared_ptr<const StepStrings> filed(const std::shared_ptr<Spool>& spool) const;
    bool is_filed() const { return spool_ != nullptr; }

    std::size_t plants() const { return derived_.plants.size(); }
    ModuleString string(std::size_t plant) const;
    DerivedStep derived() const;
    const std::shared_ptr<const Origin>& origin() const { return origin_; }
    /// In memory.
    std::size_t bytes() const;

private:
    struct FiledPlant {
        Spool::Place letters, parameters, births, memory;
        SiblingTable siblings;
    };

    DerivedStep derived_;  ///< where it lies in a file, only the number of plants
    std::shared_ptr<const Origin> origin_;
    std::shared_ptr<Spool> spool_;
    std::vector<FiledPlant> filed_;
};

}  // namespace espalier::studio
