// Grows what is open with one number swept, plant after plant, beside the thread that serves. The document stays as it
// is.
#pragma once

#include "espalier/base/read_log.h"
#include "espalier/base/stop.h"
#include "espalier/studio/studio.h"

#include "studio/document/document.h"
#include "studio/growth/workers.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace espalier::studio {

struct SweepOrder {
    std::uint32_t first = 0;            ///< number of the first growth; the others follow
    std::vector<DocumentState> states;  ///< what grows, one after the other
    std::filesystem::path scratch;
    std::function<Scene(const Opened&)> read;
    std::optional<ReadPermission> permission = {};  ///< none: it may read everything
    std::size_t memory = 0;                         ///< most bytes that a growth may take; 0: the default
};

/// The last step of one of them.
struct SweptPlant {
    std::uint32_t growth = 0;
    std::vector<std::string> messages;         ///< its shapes and its packet
    std::string statistics;                    ///< the rows of statistics.csv, with the header
    std::map<std::string, std::string> units;  ///< of its columns that have one
    std::string reason;                        ///< why there is none; empty otherwise
};

class SweepRun final : private PiecewiseWork {
public:
    /// `grown` is called by the worker for each plant, in order. The workers outlive it.
    SweepRun(SweepOrder order, std::function<void(SweptPlant)> grown, Workers& workers);
    /// Drops the plant at hand.
    ~SweepRun() override;
    SweepRun(const SweepRun&) = delete;
    SweepRun& operator=(const SweepRun&) = delete;

    void stop() { request_.ask(); }
    bool has_ended() const { return running_.has_ended(); }

private:
    struct Work;

    Then next() override;
    void wait() override {}  // it is never without a piece
    void open();
    SweptPlant drawn() const;
    Then go_on();

    const SweepOrder order_;
    const std::function<void(SweptPlant)> grown_;
    StopRequest request_;
    std::size_t at_ = 0;  ///< the plant at hand
    std::unique_ptr<ReadLog> reads_;
    std::unique_ptr<Work> work_;  ///< null: it has not been read
    RunningWork running_;         ///< the last: it uses all others
};

}  // namespace espalier::studio
