// A recorded run as pages see it: read from its folder, not grown.
#pragma once

#include "espalier/archive/organ_history.h"
#include "espalier/archive/recorded_run.h"

#include "studio/growth/growth.h"
#include "studio/growth/plant_source.h"
#include "studio/growth/recorded_frame.h"
#include "studio/growth/workers.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace espalier::studio {

/// Steps between two frames show the frame before.
class Recording final : public PlantSource {
public:
    /// The workers and the listener outlive it.
    Recording(GrowthOrder order, GrowthListener& listener, Workers& workers);
    /// Waits for the frame at hand.
    ~Recording() override;
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

    std::uint32_t number() const override { return order_.number; }
    std::uint64_t version() const override { return order_.version; }
    const Opened& opened() const override { return order_.opened; }
    double seconds() const override;

    bool has(int step) const override;
    bool has_packet(int step) const override;
    void draw(int step) override;
    std::string packet(int step) const override;
    LimbAxes limb_axes(int step) const override { return frame(frame_at(step))->limb_axes(); }
    std::vector<std::string> shapes() const override { return {}; }
    std::vector<BrowserTexture> textures() const override { return {}; }
    std::vector<std::string> column_names() const override { return columns_; }
    std::string column(int step, const std::string& name) const override;
    Picked module_info(int step, std::uint32_t module) const override;
    std::string field(int step, const std::string& name) const override;

    void cancel() override;
    bool has_ended() const override { return running_.has_ended(); }

private:
    void live();
    void begin();
    void draw_wanted();
    /// The number of the frame that a step shows. Throws UserError for a step before the first or behind the last.
    std::size_t frame_at(int step) const;
    std::shared_ptr<const DrawnFrame> frame(std::size_t number) const;
    std::optional<OrganHistory> moments(const OrganKey& organ, int step) const;
    PickedHistory history(const OrganHistory& known, int step, const std::vector<std::string>& names) const;
    std::optional<PickedDay> day(const OrganHistory& known, int step, const std::vector<std::string>& names,
                                 const std::map<std::string, std::string>& units) const;

    const GrowthOrder order_;
    GrowthListener& listener_;
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    std::unique_ptr<const RecordedRun> run_;  ///< from the listener's start on
    std::vector<std::string> columns_;        ///< the same
    std::atomic<bool> cancelled_ = false;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    mutable std::deque<std::pair<std::size_t, std::shared_ptr<const DrawnFrame>>>
        frames_;                                  ///< the last used, the newest first
    std::map<std::size_t, std::string> packets_;  ///< by frames
    std::size_t packet_bytes_ = 0;
    std::set<int> wanted_;
    mutable OrganReader histories_;
    RunningWork running_;  ///< the last: it uses all others
};

}  // namespace espalier::studio
