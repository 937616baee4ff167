#include "studio/session/sweeps.h"

#include "studio/session/message.h"
#include "studio/session/statistics.h"

#include <utility>

namespace espalier::studio {
namespace {

struct Swept {
    static constexpr TypeName type{"Swept", "a plant of a sweep has grown"};
    std::uint32_t growth = 0;
    std::string reason;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("growth", self.growth, "its number");
        field("reason", self.reason, "why it did not grow; empty otherwise");
    }
};

const Message<Swept> swept_message{
    "swept", "to a page that asked for `sweep`, behind the shapes, the packet and the `statistics` of the last step"};

}  // namespace

std::uint32_t Sweeps::begin(const Page& page, SweepOrder order) {
    forget(page);
    const std::uint32_t first = order.first = next_;
    next_ += static_cast<std::uint32_t>(order.states.size());
    const auto grown = [this, to = &page, first](SweptPlant plant) {
        post_([this, to, first, plant = std::move(plant)] { tell(to, first, plant); });
    };
    runs_[&page] = {first, std::make_unique<SweepRun>(std::move(order), grown, workers_)};
    return first;
}

void Sweeps::forget(const Page& page) {
    std::erase_if(ending_, [](const auto& run) { return run->has_ended(); });
    const auto run = runs_.find(&page);
    if (run == runs_.end()) return;
    run->second.run->stop();
    ending_.push_back(std::move(run->second.run));
    runs_.erase(run);
}

void Sweeps::tell(const Page* page, std::uint32_t sweep, const SweptPlant& plant) {
    const auto run = runs_.find(page);
    Viewer* const viewer = pages_.find(page);
    if (!viewer || run == runs_.end() || run->second.first != sweep) return;
    for (const std::string& bytes : plant.messages) viewer->page.send_bytes(bytes);
    if (plant.reason.empty()) {
        Statistics statistics;
        statistics.add(plant.statistics, plant.units);
        Pages::send(*viewer, statistics.message(plant.growth));
    }
    Pages::send(*viewer, swept_message({plant.growth, plant.reason}));
}

}  // namespace espalier::studio
