#include "view/run_follower.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include <system_error>

namespace espalier::view {
namespace {

// Frames only join a run at its end; where earlier ones differ it is a new run in the old one's folder.
bool goes_on(const RecordedRun& before, const RecordedRun& after) {
    if (after.frames().size() < before.frames().size() || after.scene() != before.scene()) return false;
    for (std::size_t i = 0; i < before.frames().size(); ++i) {
        if (after.frames()[i].step != before.frames()[i].step) return false;
    }
    return true;
}

}  // namespace

RunFollower::RunFollower(std::filesystem::path folder) : folder_(std::move(folder)), stamp_(stamp()) {
    run_ = std::make_shared<const RecordedRun>(folder_);
}

RunFollower::Stamp RunFollower::stamp() const {
    Stamp result{{}, is_locked(folder_)};
    std::size_t i = 0;
    for (const char* name : {"run.json", "plants.pvd", "fields.pvd"}) {
        std::error_code error;
        const auto written = std::filesystem::last_write_time(folder_ / name, error);
        result.written[i++] = error ? std::filesystem::file_time_type::min() : written;
    }
    return result;
}

bool RunFollower::look() {
    const Stamp now = stamp();
    if (now == stamp_) return false;
    try {
        auto again = std::make_shared<const RecordedRun>(folder_);
        is_another_ = !goes_on(*run_, *again);
        run_ = std::move(again);
        stamp_ = now;
        error_.clear();
        return true;
    } catch (const UserError& error) {
        error_ = error.what();
        return false;
    }
}

}  // namespace espalier::view
