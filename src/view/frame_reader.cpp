#include "view/frame_reader.h"

#include "base/reason.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace espalier::view {
namespace {

std::size_t bytes_of(const FrameAttributes& attributes) {
    return attributes.size() * (8 + 8 + 4 + 2 + 4 + 2 + 2 + 1) + attributes.rgb.size() * 3;
}

std::size_t bytes_of(const FrameGeometry& geometry) {
    std::size_t bytes = geometry.points.size() * (12 + 12 + 8 + 4 + 8 * geometry.parameters.size());
    for (const FrameCells* cells : {&geometry.vertices, &geometry.lines, &geometry.polygons}) {
        bytes += 4 * (cells->offsets.size() + cells->connectivity.size());
    }
    return bytes + bytes_of(geometry.of_points) + bytes_of(geometry.of_cells);
}

std::shared_ptr<const FrameData> read(const RecordedRun& run, const RecordedFrame& frame) {
    auto data = std::make_shared<FrameData>();
    try {
        if (!frame.plants.empty()) data->geometry = run.geometry(frame);
        count(*data);
    } catch (const std::exception& error) {
        data->error = reason_of(error);
    }
    return data;
}

}  // namespace

void count(FrameData& data) {
    const FrameGeometry& geometry = data.geometry;
    const FrameAttributes& of = geometry.of_cells;
    data.plants = std::set<std::uint32_t>(of.plants.begin(), of.plants.end()).size();
    for (std::size_t line = 0; line < geometry.lines.size(); ++line) {
        const std::size_t points = geometry.lines[line].size();
        if (of.kinds[geometry.lines.first + line] == Kind::axis && points > 0) data.internodes += points - 1;
    }
    for (std::size_t cell = 0; cell < geometry.polygons.size(); ++cell) {
        const std::size_t row = geometry.polygons.first + cell;
        const bool goes_on =
            cell > 0 && of.identities[row] == of.identities[row - 1] && of.plants[row] == of.plants[row - 1];
        if (!goes_on) ++data.organs;
    }
}

FrameReader::FrameReader(std::size_t most_bytes) : most_bytes_(most_bytes), thread_([this] { work(); }) {}

FrameReader::~FrameReader() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

void FrameReader::want(const std::shared_ptr<const RecordedRun>& run, std::vector<RecordedFrame> frames) {
    {
        const std::lock_guard lock(mutex_);
        run_ = run;
        urgent_ = frames.empty() ? std::filesystem::path() : frames.front().plants;
        wanted_ = std::move(frames);
    }
    wake_.notify_all();
}

std::shared_ptr<const FrameData> FrameReader::find(const RecordedFrame& frame) {
    const std::lock_guard lock(mutex_);
    const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& candidate) { return candidate.path == frame.plants; });
    if (entry == entries_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, entry);
    return entries_.front().data;
}

void FrameReader::forget() {
    const std::lock_guard lock(mutex_);
    entries_.clear();
    wanted_.clear();
    bytes_ = 0;
    ++generation_;
}

bool FrameReader::has(const std::filesystem::path& path) const {
    return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.path == path; });
}

// Each is read once, even if it has to leave for those after it.
bool FrameReader::take_next(RecordedFrame& frame) {
    while (!wanted_.empty()) {
        frame = wanted_.front();
        wanted_.erase(wanted_.begin());
        if (!has(frame.plants)) return true;
    }
    return false;
}

void FrameReader::keep(const RecordedFrame& frame, std::shared_ptr<const FrameData> data) {
    const std::size_t bytes = bytes_of(data->geometry);
    entries_.push_front({frame.plants, std::move(data), bytes});
    bytes_ += bytes;
    while (bytes_ > most_bytes_ && entries_.size() > 2) {
        if (entries_.back().path == urgent_) entries_.splice(entries_.begin(), entries_, std::prev(entries_.end()));
        bytes_ -= entries_.back().bytes;
        entries_.pop_back();
    }
}

void FrameReader::work() {
    std::unique_lock lock(mutex_);
    RecordedFrame frame;
    while (!ending_) {
        if (!take_next(frame)) {
            wake_.wait(lock);
            continue;
        }
        const std::shared_ptr<const RecordedRun> run = run_;
        const std::size_t generation = generation_;
        lock.unlock();
        std::shared_ptr<const FrameData> data = read(*run, frame);
        lock.lock();
        if (generation == generation_) keep(frame, std::move(data));
    }
}

}  // namespace espalier::view
