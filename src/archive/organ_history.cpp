#include "espalier/archive/organ_history.h"

#include "archive/organ_table.h"
#include "base/text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <list>
#include <system_error>

namespace espalier::archive {
namespace {

namespace fs = std::filesystem;

OrganMoment moment_of(const RecordedFrame& frame, const OrganTable& table, const OrganRow& row,
                      const std::vector<std::string>& parameters) {
    return {frame.step,     frame.time, row.base,
            row.tip,        row.length, row.base_radius,
            row.tip_radius, row.area,   table.parameters(row, parameters)};
}

OrganHistory begin_history(const OrganTable& table, const OrganRow& row) {
    OrganHistory history;
    history.organ = row.key;
    history.symbol = table.symbol(row);
    history.kind = row.kind;
    history.parent = row.parent;
    history.order = row.order;
    history.birth = row.birth;
    history.parameters = table.parameter_names();
    return history;
}

std::vector<const RecordedFrame*> frames_with_plants(const RecordedRun& run) {
    std::vector<const RecordedFrame*> frames;
    for (const RecordedFrame& frame : run.frames()) {
        if (!frame.plants.empty()) frames.push_back(&frame);
    }
    return frames;
}

std::string metres(double value) {
    return std::abs(value) < 0.1 ? fmt::format("{:.4g} mm", 1000 * value) : fmt::format("{:.4g} m", value);
}

std::string_view kind_word(Kind kind) {
    switch (kind) {
        case Kind::axis:
            return "internode";
        case Kind::query:
            return "query";
        case Kind::label:
            return "label";
        default:
            return "organ";
    }
}

}  // namespace

/// Tables of frames, those used last at the front. A file that was written anew is another file.
class OrganReader::Cache {
public:
    explicit Cache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

    const OrganTable& table(const RecordedRun& run, const RecordedFrame& frame) {
        std::error_code error;
        const fs::file_time_type written = fs::last_write_time(frame.plants, error);
        const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
            return entry.path == frame.plants && entry.written == written;
        });
        if (found != entries_.end()) {
            entries_.splice(entries_.begin(), entries_, found);
        } else {
            entries_.push_front({frame.plants, written, OrganTable(run.geometry(frame), run.folder())});
            bytes_ += entries_.front().table.bytes();
            while (bytes_ > most_bytes_ && entries_.size() > 1) {
                bytes_ -= entries_.back().table.bytes();
                entries_.pop_back();
            }
        }
        return entries_.front().table;
    }

private:
    struct Entry {
        fs::path path;
        fs::file_time_type written;
        OrganTable table;
    };

    std::size_t most_bytes_, bytes_ = 0;
    std::list<Entry> entries_;
};

OrganReader::OrganReader(std::size_t most_bytes) : cache_(std::make_unique<Cache>(most_bytes)) {}

OrganReader::~OrganReader() = default;

std::optional<OrganHistory> OrganReader::history(const RecordedRun& run, const OrganKey& organ,
                                                 std::optional<int> seen_at, const Progress& progress) {
    std::optional<OrganHistory> history;
    std::vector<const RecordedFrame*> frames = frames_with_plants(run);
    std::size_t first = 0;
    if (seen_at) {
        const OrganTable& table = cache_->table(run, run.frame(*seen_at));
        if (const OrganRow* row = table.find(organ)) {
            const auto before_birth = [&](const RecordedFrame* frame) { return frame->step < row->birth; };
            first = static_cast<std::size_t>(std::partition_point(frames.begin(), frames.end(), before_birth) -
                                             frames.begin());
        }
    }
    for (std::size_t i = first; i < frames.size(); ++i) {
        const OrganTable& table = cache_->table(run, *frames[i]);
        if (const OrganRow* row = table.find(organ)) {
            if (!history) history = begin_history(table, *row);
            history->gone.reset();
            history->moments.push_back(moment_of(*frames[i], table, *row, history->parameters));
        } else if (history && !history->gone) {
            history->gone = {history->moments.back().step, frames[i]->step};
        }
        if (progress && !progress(history.value_or(OrganHistory()), i + 1 - first, frames.size() - first)) break;
    }
    return history;
}

std::vector<std::pair<std::string, std::string>> described(const OrganHistory& history, const RecordedRun& run,
                                                           int step) {
    std::vector<std::pair<std::string, std::string>> lines;
    const auto add = [&](std::string name, std::string value) {
        lines.emplace_back(std::move(name), std::move(value));
    };
    add("symbol", fmt::format("{} ({})", history.symbol, kind_word(history.kind)));
    add("plant", run.plants().at(history.organ.plant).name);
    add("identity", fmt::format("{}", history.organ.identity));
    add("parent", history.parent == 0 ? "none" : fmt::format("{}", history.parent));
    add("order", fmt::format("{}", history.order));
    add("born", fmt::format("step {}", history.birth));
    if (const auto death = history.death()) {
        add("died", fmt::format("step {}", *death));
    } else if (history.gone) {
        add("died", fmt::format("step {} to {}", history.gone->first + 1, history.gone->second));
    } else {
        add("died", "no");
    }
    const auto after = std::find_if(history.moments.begin(), history.moments.end(),
                                    [&](const OrganMoment& moment) { return moment.step > step; });
    if (after == history.moments.begin()) {
        add("at step", fmt::format("{}, not there yet", step));
        return lines;
    }
    const OrganMoment& moment = *std::prev(after);
    const bool is_over = after == history.moments.end() && history.gone && step > moment.step;
    add(is_over ? "last seen" : "at step", fmt::format("{}", moment.step));
    if (history.kind != Kind::query && history.kind != Kind::label) add("length", metres(moment.length));
    if (history.kind == Kind::axis) {
        add("radius", fmt::format("{} to {}", metres(moment.base_radius), metres(moment.tip_radius)));
    }
    if (moment.area > 0) add("area", fmt::format("{:.4g} m2", moment.area));
    add("from", fmt::format("{:.3f}, {:.3f}, {:.3f}", moment.base.x, moment.base.y, moment.base.z));
    if (history.kind != Kind::query) {
        add("to", fmt::format("{:.3f}, {:.3f}, {:.3f}", moment.tip.x, moment.tip.y, moment.tip.z));
    }
    for (std::size_t i = 0; i < history.parameters.size(); ++i) {
        if (!std::isnan(moment.parameters[i])) add(history.parameters[i], fmt::format("{:.5g}", moment.parameters[i]));
    }
    return lines;
}

}  // namespace espalier::archive
