// One growth of what the studio has open, beside the thread that serves.
#pragma once

#include "espalier/base/read_log.h"
#include "espalier/base/stop.h"
#include "espalier/simulation/staged_world.h"
#include "espalier/studio/studio.h"

#include "studio/growth/kept_steps.h"
#include "studio/growth/organ_columns.h"
#include "studio/growth/plant_source.h"
#include "studio/growth/printed_text.h"
#include "studio/growth/workers.h"
#include "studio/protocol/shared_model.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace espalier::studio {

struct GrowthOrder {
    std::uint32_t number = 0;   ///< names the growth
    std::uint64_t version = 0;  ///< version of the document that it grows
    Opened opened;
    UnsavedTexts unsaved;
    std::filesystem::path scratch;  ///< a folder for its files
    std::function<Scene(const Opened&)> read;
    std::optional<ReadPermission> permission = {};  ///< none: it may read everything
    std::size_t memory = 0;                         ///< most bytes that it may take; 0: the default
    /// The steps of an earlier growth, which need not be derived again if only looks have changed; may be null.
    std::shared_ptr<const KeptSteps> before = nullptr;
    /// Pages do not ask to see it grow up to this step: where drawing can wait, what pages look at is drawn first.
    int unseen_to = 0;
    std::set<int> looked_at = {};  ///< besides the last step
    bool may_be_large = false;     ///< it need not ask before it passes most_unasked
};

/// Modules that a growth may have before it asks whether to go on.
inline constexpr std::size_t most_unasked = 5'000'000;

class Growth final : public PlantSource, private PiecewiseWork {
public:
    /// The workers and the listener outlive it.
    Growth(GrowthOrder order, GrowthListener& listener, Workers& workers);
    /// Drops the step at hand.
    ~Growth() override;
    Growth(const Growth&) = delete;
    Growth& operator=(const Growth&) = delete;

    std::uint32_t number() const override { return order_.number; }
    std::uint64_t version() const override { return version_; }
    const Opened& opened() const override { return order_.opened; }
    double seconds() const override;
    const KeptSteps& steps() const { return *steps_; }
    std::shared_ptr<const KeptSteps> shared_steps() const override { return steps_; }
    std::shared_ptr<const Scene> scene() const override;

    bool has(int step) const override { return steps_->has(step); }
    bool has_packet(int step) const override { return steps_->has_packet(step); }
    void draw(int step) override;
    std::string packet(int step) const override { return steps_->packet(step); }
    LimbAxes limb_axes(int step) const override { return steps_->limb_axes(step); }
    std::vector<std::string> shapes() const override { return steps_->shapes(); }
    std::vector<BrowserTexture> textures() const override { return steps_->textures(); }
    std::vector<std::string> column_names() const override;
    std::string column(int step, const std::string& name) const override;
    Picked module_info(int step, std::uint32_t module) const override;
    std::string field(int step, const std::string& name) const override {
        return steps_->fields().message(name, step, number());
    }

    void cancel() override;
    bool has_ended() const override { return running_.has_ended(); }
    void stop() override;
    void go_on() override;
    /// False if what grows depends on how far it is to grow: then it must grow anew.
    bool extend(int last_step, std::uint64_t version) override;
    void pause_drawing(bool pauses) override;

private:
    struct Work;

    Then next() override;
    void wait() override;
    Then open();
    Then end();
    Then fail(const std::vector<Diagnostic>& why);
    void begin(Work& work, GrowthStart start);
    Then grow(Work& work);
    void drop(Work& work);
    void forget_stop();
    bool advance(Work& work);
    bool may_grow(const Work& work) const;
    bool must_ask(const Work& work) const;
    void note_derived(Work& work);
    void step(Work& work);
    void derive(Work& work);
    void go_to(Work& work, int step);
    bool draw_wanted(Work& work);
    void forget_wanted();
    std::optional<int> next_wanted(const Work& work);
    bool may_draw_in_order(const Work& work) const;
    void draw_in_order(Work& work);
    Frame frame_at(Work& work, int step);
    Frame answered_frame(const Work& work, int step) const;
    void note_grown(Work& work, std::size_t internodes, std::string statistics);

    std::shared_ptr<const KeptSteps> before_;  ///< until it has begun
    const GrowthOrder order_;
    GrowthListener& listener_;
    PrintedText printed_;
    const std::shared_ptr<KeptSteps> steps_;
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    std::uint64_t version_ = 0;
    std::atomic<int> last_step_ = -1;
    std::atomic<bool> may_extend_ = false;
    std::atomic<bool> cancelled_ = false, stopped_ = false, rests_ = false, may_be_large_ = false;
    StopRequest request_;  ///< to what its thread does at this moment
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::shared_ptr<const Scene> scene_;
    std::vector<OrganColumn> organ_columns_;
    std::set<int> wanted_;  ///< steps to be drawn before others
    // Of its own thread, while it grows.
    std::unique_ptr<ReadLog> reads_;
    std::unique_ptr<const Scene> read_scene_;
    std::unique_ptr<Work> work_;
    RunningWork running_;  ///< the last: it uses all others
};

}  // namespace espalier::studio
