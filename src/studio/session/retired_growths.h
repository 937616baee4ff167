// Growths that no page sees any more, which end after their step.
#pragma once

#include "studio/growth/plant_source.h"

#include <memory>
#include <utility>
#include <vector>

namespace espalier::studio {

class RetiredGrowths {
public:
    /// Cancels it; null is none.
    void add(std::unique_ptr<PlantSource> growth) {
        if (!growth) return;
        growth->cancel();
        growths_.push_back(std::move(growth));
    }
    void forget_ended() {
        std::erase_if(growths_, [](const auto& growth) { return growth->has_ended(); });
    }

private:
    std::vector<std::unique_ptr<PlantSource>> growths_;
};

}  // namespace espalier::studio
