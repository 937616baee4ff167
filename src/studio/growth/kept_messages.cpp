#include "studio/growth/kept_fields.h"

#include "espalier/base/error.h"

#include "studio/packets/field_bytes.h"

#include <fmt/format.h>

#include <cstring>
#include <utility>

namespace espalier::studio {

void KeptFields::add(const Fields& fields, int step) {
    for (const auto& [name, field] : fields.all()) {
        std::string message = field_bytes(field, growth_, 0);
        const std::lock_guard lock(mutex_);
        if (!spool_) spool_ = std::make_unique<Spool>(file_);
        History& history = histories_[name];
        const bool is_same = !history.steps.empty() && history.last == message;
        const Spool::Place place = is_same ? history.steps.rbegin()->second : spool_->add(message);
        history.steps[step] = place;
        history.last = std::move(message);
    }
}

std::string KeptFields::message(int step, const std::string& name) const {
    constexpr std::size_t place_of_step = 8;
    const std::lock_guard lock(mutex_);
    const auto history = histories_.find(name);
    if (history == histories_.end()) throw UserError(fmt::format("there is no field '{}'", name));
    const auto place = history->second.steps.find(step);
    if (place == history->second.steps.end()) throw UserError(fmt::format("step {} has not been grown", step));
    std::string message = spool_->text(place->second);
    const auto number = static_cast<std::int32_t>(step);
    std::memcpy(message.data() + place_of_step, &number, sizeof number);
    return message;
}

}  // namespace espalier::studio
