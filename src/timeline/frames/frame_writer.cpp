#include "timeline/frames/frame_writer.h"

#include "espalier/base/error.h"

#include <string>
#include <system_error>

namespace espalier::timeline {

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

}  // namespace espalier::timeline
