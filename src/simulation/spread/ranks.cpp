#include "espalier/simulation/ranks.h"

#include "espalier/base/error.h"
#include "espalier/base/stop.h"

#include "base/reason.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <optional>

namespace espalier::simulation {
namespace {

enum class Failure : char { none = 0, user = 'u', run = 'r', stopped = 's' };

/// How the work ended here.
struct Outcome {
    Failure failure = Failure::none;
    std::string message = {};
    std::exception_ptr error = {};
};

Outcome outcome_of(const std::function<void()>& work) {
    try {
        work();
        return {};
    } catch (const Stopped&) {
        return {Failure::stopped, "", std::current_exception()};
    } catch (const UserError& error) {
        return {Failure::user, error.what(), std::current_exception()};
    } catch (const std::bad_alloc&) {
        return {Failure::run, "the machine has no memory left; set a limit with --memory", std::current_exception()};
    } catch (const std::exception& error) {
        return {Failure::run, reason_of(error), std::current_exception()};
    }
}

[[noreturn]] void fail_as(Failure failure, const std::string& message) {
    if (failure == Failure::stopped) throw Stopped();
    if (failure == Failure::user) throw UserError(message);
    throw RunError(message);
}

}  // namespace

bool is_first(const Ranks* ranks) {
    return !ranks || ranks->rank() == 0;
}

std::vector<std::string> from_all(Ranks* ranks, const std::string& own) {
    if (!ranks) return {own};
    return ranks->trade(std::vector<std::string>(static_cast<std::size_t>(ranks->count()), own));
}

std::string from_first(Ranks* ranks, const std::string& own) {
    if (!ranks) return own;
    const auto count = static_cast<std::size_t>(ranks->count());
    return ranks->trade(std::vector<std::string>(count, is_first(ranks) ? own : "")).front();
}

std::size_t ranks_on_node(Ranks* ranks) {
    if (!ranks) return 1;
    const std::vector<std::string> all = from_all(ranks, ranks->node());
    return static_cast<std::size_t>(std::count(all.begin(), all.end(), ranks->node()));
}

bool any(Ranks* ranks, bool own) {
    const std::vector<std::string> all = from_all(ranks, own ? "1" : "");
    return std::any_of(all.begin(), all.end(), [](const std::string& one) { return !one.empty(); });
}

void together(Ranks* ranks, const std::function<void()>& work) {
    if (!ranks) return work();
    const Outcome outcome = outcome_of(work);
    std::string told;
    if (outcome.failure != Failure::none) {
        told = static_cast<char>(outcome.failure) + fmt::format("{}: {}", ranks->name(), outcome.message);
    }
    const std::vector<std::string> all = from_all(ranks, told);
    const auto first = std::find_if(all.begin(), all.end(), [](const std::string& one) { return !one.empty(); });
    if (first == all.end()) return;
    ranks->agree();
    // What failed here first is known with its place.
    if (first - all.begin() == ranks->rank()) std::rethrow_exception(outcome.error);
    fail_as(static_cast<Failure>(first->front()), first->substr(1));
}

}  // namespace espalier::simulation
