#include "timeline/frames/frame_writer.h"

#include "espalier/base/error.h"

#include "geometry/drawn/columns.h"

#include <algorithm>
#include <string>
#include <system_error>

namespace espalier::timeline {
namespace {

template <class Values>
std::size_t bytes_of(const Values& values) {
    return values.size() * sizeof(values[0]);
}

std::size_t bytes_of(const PlantGeometry& geometry) {
    std::size_t bytes = 0;
    geometry::for_drawn_columns(geometry, [&bytes](const auto& column) { bytes += bytes_of(column); });
    return bytes;
}

}  // namespace

FrameWriter::~FrameWriter() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

bool FrameWriter::has_room(std::size_t bytes) const {
    return waiting_.empty() || (waiting_.size() < most_frames && bytes_ + bytes <= room_);
}

std::unique_ptr<FrameWriter::Job> FrameWriter::make_room(std::size_t bytes) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return failure_ || has_room(bytes); });
    if (failure_) std::rethrow_exception(failure_);
    for (const std::unique_ptr<Job>& job : done_) job->frame.release();
    if (done_.empty()) return std::make_unique<Job>();
    std::unique_ptr<Job> job = std::move(done_.back());
    done_.pop_back();
    return job;
}

// Only the run's thread adds, so that room once made stays until the frame is in the queue.
void FrameWriter::add(const Frame& frame, bool due) {
    start();
    const std::size_t bytes = KeptFrame::bytes(frame);
    std::unique_ptr<Job> job = make_room(bytes);
    const std::span<const std::string> none;
    job->frame.take(frame, due ? std::span(fields_) : none, due ? std::span(organs_) : none);
    job->due = due;
    job->bytes = bytes;
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(job));
        bytes_ += bytes;
    }
    changed_.notify_all();
}

// Before anything is in the queue: without a thread, waiting for it would never end.
void FrameWriter::start() {
    if (thread_.joinable()) return;
    try {
        thread_ = std::thread(&FrameWriter::work, this);
    } catch (const std::system_error& error) {
        throw RunError(std::string("cannot start the thread that writes frames: ") + error.what());
    }
}

void FrameWriter::release_written() {
    const std::lock_guard lock(mutex_);
    for (const std::unique_ptr<Job>& job : done_) job->frame.release();
}

void FrameWriter::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return waiting_.empty(); });
    if (failure_) std::rethrow_exception(failure_);
}

void FrameWriter::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return ends_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        const Job& job = *waiting_.front();
        const bool failed = failure_ != nullptr;
        lock.unlock();
        std::exception_ptr failure;
        if (!failed) failure = attempt(job);
        lock.lock();
        if (failure) failure_ = failure;
        bytes_ -= job.bytes;
        done_.push_back(std::move(waiting_.front()));
        waiting_.pop_front();
        changed_.notify_all();
    }
}

std::exception_ptr FrameWriter::attempt(const Job& job) const {
    try {
        write_(job.frame.frame(), job.due);
    } catch (...) {
        return std::current_exception();
    }
    return nullptr;
}

void KeptFrame::take(const Frame& frame, std::span<const std::string> fields, std::span<const std::string> organs) {
    frame_ = frame;
    frame_.fields = &fields_;
    fields_ = {};
    if (frame.fields) take_fields(*frame.fields, fields);
    if (!frame.environment) return;
    for (PlantFrame& plant : frame_.plants) {
        for (const std::string& name : organs) plant.organs[name] = frame.environment->organ_values(name, plant.plant);
    }
}

void KeptFrame::take_fields(const Fields& all, std::span<const std::string> wanted) {
    const auto keep = [this](Field field) {
        field.current = {};
        fields_.provide(std::move(field));
    };
    const auto is_there = [&all](const std::string& name) { return all.find(name) != nullptr; };
    if (std::all_of(wanted.begin(), wanted.end(), is_there)) {
        for (const std::string& name : wanted) keep(*all.find(name));
    } else {
        for (const auto& [name, field] : all.all()) keep(field);
    }
}

void KeptFrame::release() {
    frame_.plants.clear();
    fields_ = {};
}

std::size_t KeptFrame::bytes(const Frame& frame) {
    std::size_t bytes = 0;
    for (const PlantFrame& plant : frame.plants) {
        bytes += plant.string->content() + bytes_of(plant.interpretation->geometry) +
                 bytes_of(plant.interpretation->queries) + bytes_of(plant.interpretation->answers) +
                 bytes_of(plant.interpretation->directions);
    }
    return bytes;
}

}  // namespace espalier::timeline
