#include "studio/growth/kept_messages.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

#include <cstring>
#include <utility>

namespace espalier::studio {

void KeptMessages::add(const std::string& name, int step, std::string message) {
    const std::lock_guard lock(mutex_);
    if (!spool_) spool_ = std::make_unique<Spool>(file_);
    History& history = histories_[name];
    const bool is_same = !history.steps.empty() && history.last == message;
    const Spool::Place place = is_same ? history.steps.rbegin()->second : spool_->add(message);
    history.steps[step] = place;
    history.last = std::move(message);
}

bool KeptMessages::has(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    return histories_.contains(name);
}

std::string KeptMessages::message(const std::string& name, int step, std::uint32_t growth) const {
    constexpr std::size_t place_of_growth = 4, place_of_step = 8;
    const std::lock_guard lock(mutex_);
    const auto history = histories_.find(name);
    if (history == histories_.end()) throw UserError(fmt::format("nothing is known of '{}'", name));
    const auto place = history->second.steps.find(step);
    if (place == history->second.steps.end()) throw UserError(fmt::format("step {} has not been grown", step));
    std::string message = spool_->text(place->second);
    const auto number = static_cast<std::int32_t>(step);
    std::memcpy(message.data() + place_of_growth, &growth, sizeof growth);
    std::memcpy(message.data() + place_of_step, &number, sizeof number);
    return message;
}

}  // namespace espalier::studio
