// Writes frames beside the run: a thread of its own works through a short queue.
#pragma once

#include "espalier/timeline/frame.h"

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace espalier::timeline {

/// A frame that outlives its step: the world goes on while a recorder still reads it. Nothing large is copied: strings,
/// interpretations, models, palettes and grids are shared, and the world does not write into what a frame holds.
class KeptFrame {
public:
    /// With these of its fields; {"all"}, or the name of one that is not there, stands for all of them. `organs`: what
    /// its plants are to know of their organs.
    void take(const Frame& frame, std::span<const std::string> fields, std::span<const std::string> organs = {});
    /// Valid until the next is taken, or this one released.
    const Frame& frame() const { return frame_; }
    /// Holds nothing of the frame any longer.
    void release();

    /// What the plants of a frame take, without the grids.
    static std::size_t bytes(const Frame& frame);

private:
    void take_fields(const Fields& all, std::span<const std::string> wanted);

    Frame frame_;
    Fields fields_;  // instead of the world's, which change with its next step
};

class FrameWriter {
public:
    /// Called by the writing thread, frame after frame; `due`: as it was added.
    using Write = std::function<void(const Frame&, bool due)>;

    /// `fields`, `organs`: those that frames which are due are kept with.
    FrameWriter(std::vector<std::string> fields, Write write, std::vector<std::string> organs = {})
        : fields_(std::move(fields)), organs_(std::move(organs)), write_(std::move(write)) {}
    /// Waits until everything is written.
    ~FrameWriter();
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;

    /// Keeps the frame and returns; waits before that while the queue is full. After a failure nothing more is
    /// written: throws it, here and in wait().
    void add(const Frame& frame, bool due);
    /// Lets go of the frames that are written. For the thread that adds.
    void release_written();
    /// Returns when every frame is written.
    void wait();

    /// As many frames may be on their way, if together they take no more than so many bytes; one always may.
    static constexpr std::size_t most_frames = 4;
    static constexpr std::size_t most_bytes = std::size_t{256} << 20;
    /// Fewer bytes than that, from now on. For the thread that adds.
    void keep_at_most(std::size_t bytes) { room_ = std::min(bytes, most_bytes); }

private:
    struct Job {
        KeptFrame frame;
        bool due = false;
        std::size_t bytes = 0;
    };

    void start();
    std::unique_ptr<Job> make_room(std::size_t bytes);
    bool has_room(std::size_t bytes) const;
    void work();
    std::exception_ptr attempt(const Job& job) const;

    const std::vector<std::string> fields_, organs_;
    const Write write_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::unique_ptr<Job>> waiting_;  ///< in order; the first is being written
    /// They hold their frames until the run's thread releases these: it alone lets go of what is shared, and knows
    /// thereby what it may write into.
    std::vector<std::unique_ptr<Job>> done_;
    std::size_t bytes_ = 0;  ///< bytes of the frames that wait
    std::size_t room_ = most_bytes;
    std::exception_ptr failure_;
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace espalier::timeline
