// Frames read ahead by a thread of its own, so that the window never waits for the disk.
#pragma once

#include "espalier/archive/recorded_run.h"

#include <condition_variable>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace espalier::view {

struct FrameData {
    FrameGeometry geometry;
    std::size_t plants = 0, internodes = 0, organs = 0;
    std::string error;  ///< why there is no geometry
};

/// Plants, internodes and organs (neighbouring polygons of one module) of a frame.
void count(FrameData& data);

class FrameReader {
public:
    explicit FrameReader(std::size_t most_bytes = std::size_t{512} << 20);
    ~FrameReader();
    FrameReader(const FrameReader&) = delete;
    FrameReader& operator=(const FrameReader&) = delete;

    /// What is to be read, most urgent first; what was wanted before and is not begun is forgotten.
    void want(const std::shared_ptr<const RecordedRun>& run, std::vector<RecordedFrame> frames);
    /// Null while it is not read.
    std::shared_ptr<const FrameData> find(const RecordedFrame& frame);
    /// Reads everything anew: the files are others now.
    void forget();

private:
    struct Entry {
        std::filesystem::path path;
        std::shared_ptr<const FrameData> data;
        std::size_t bytes;
    };

    void work();
    /// Takes the first frame that is wanted and not read yet; false if there is none.
    bool take_next(RecordedFrame& frame);
    void keep(const RecordedFrame& frame, std::shared_ptr<const FrameData> data);
    bool has(const std::filesystem::path& path) const;

    std::size_t most_bytes_, bytes_ = 0, generation_ = 0;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::shared_ptr<const RecordedRun> run_;
    std::vector<RecordedFrame> wanted_;
    std::filesystem::path urgent_;  ///< stays until it is no longer
    std::list<Entry> entries_;      ///< those used last at the front
    bool ending_ = false;
    std::thread thread_;
};

}  // namespace espalier::view
