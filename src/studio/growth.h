// One growth of what the studio has open, beside the thread that serves.
#pragma once

#include "espalier/base/read_log.h"
#include "espalier/simulation/world.h"
#include "espalier/studio/studio.h"

#include "studio/kept_steps.h"
#include "studio/workers.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
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
    std::uint64_t version = 0;  ///< of the document that it grows
    Opened opened;
    UnsavedTexts unsaved;
    std::filesystem::path scratch;  ///< a folder for its files
    std::function<Scene(const Opened&)> read;
    /// The steps of an earlier growth, which need not be derived again if only looks have changed; may be null.
    std::shared_ptr<const KeptSteps> before = nullptr;
    /// Nobody wants to see it grow up to this step: where drawing can wait, what pages look at is drawn first.
    int unseen_to = 0;
    std::set<int> looked_at = {};  ///< besides the last step
};

struct FieldDescription {
    std::string name, unit, meaning;
};

/// What is known once the files were read.
struct GrowthStart {
    std::map<std::filesystem::path, ReadLog::File> files;
    std::vector<std::string> plants;
    std::vector<Diagnostic> warnings;
    std::vector<FieldDescription> fields;
    int last_step = 0;
    std::uint64_t seed = 0;
};

struct GrownStep {
    int step = 0, last_step = 0;
    std::size_t modules = 0, internodes = 0;
    int derived = 0;         ///< steps that were derived for it, and not taken from an earlier growth
    double seconds = 0;      ///< since it began
    std::string statistics;  ///< the rows of statistics.csv that this step added, with the header in the first
    bool is_end = false;     ///< no step follows
};

/// Told on the thread of the growth.
class GrowthListener {
public:
    virtual ~GrowthListener() = default;
    virtual void started(std::uint32_t growth, GrowthStart start) = 0;
    /// A later step than all before can be shown, or it has become clear that none will follow.
    virtual void grown(std::uint32_t growth, GrownStep step) = 0;
    /// An earlier step can be shown; `statistics` as in GrownStep.
    virtual void drawn(std::uint32_t growth, int step, std::string statistics) = 0;
    /// It was told to stop before its end, and no more steps come.
    virtual void stopped(std::uint32_t growth) = 0;
    /// It could not be read, or did not go on. A growth that is told to end says nothing.
    virtual void failed(std::uint32_t growth, std::vector<Diagnostic> why) = 0;
};

class Growth {
public:
    /// The workers and the listener outlive it.
    Growth(GrowthOrder order, GrowthListener& listener, Workers& workers);
    /// Waits for the step at hand.
    ~Growth();
    Growth(const Growth&) = delete;
    Growth& operator=(const Growth&) = delete;

    std::uint32_t number() const { return order_.number; }
    std::uint64_t version() const { return version_; }
    const Opened& opened() const { return order_.opened; }
    const KeptSteps& steps() const { return *steps_; }
    std::shared_ptr<const KeptSteps> shared_steps() const { return steps_; }
    double seconds() const;  ///< since it began
    /// The scene as it grows; null before it has started.
    std::shared_ptr<const Scene> scene() const;

    /// No more steps: it ends after the one at hand.
    void cancel();
    /// True once its work has ended: the destructor does not wait.
    bool has_ended() const { return ended_.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
    /// No more steps, but it still answers questions.
    void stop() { stopped_ = true; }
    /// Goes on to a later step, for a later version of the document that asks for nothing else. False if what grows
    /// depends on how far it is to grow: then it must grow anew.
    bool extend(int last_step, std::uint64_t version);

    /// Called with the world on the thread of the growth: between two steps, or after the last.
    void ask(std::function<void(const World&)> question);
    /// Steps that nobody looks at are not drawn for the time being: another growth is to begin.
    void rest(bool rests);
    /// A step that has been derived is drawn next.
    void draw(int step);

private:
    struct Work;

    void live();
    void begin(Work& work, GrowthStart start);
    void grow(Work& work);
    bool advance(Work& work);
    bool may_grow(const Work& work) const;
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
    void note_grown(Work& work, std::size_t internodes, std::string statistics);
    void answer(const World& world);
    void wait_for_more(const Work& work);

    const GrowthOrder order_;
    GrowthListener& listener_;
    const std::shared_ptr<KeptSteps> steps_;
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    std::uint64_t version_ = 0;
    std::atomic<int> last_step_ = -1;
    std::atomic<bool> may_extend_ = false;
    std::atomic<bool> cancelled_ = false, stopped_ = false, rests_ = false;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::shared_ptr<const Scene> scene_;
    std::deque<std::function<void(const World&)>> questions_;
    std::set<int> wanted_;     ///< steps to be drawn before others
    std::future<void> ended_;  ///< the last: its work uses all others
};

}  // namespace espalier::studio
