// Pages that remember what they were told, and a box for the work that other threads post to a studio.
#pragma once

#include "espalier/simulation/object.h"

#include "studio/session/session.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace studio_test {

using espalier::studio::Json;

class ListeningPage final : public espalier::studio::Page {
public:
    void send_text(std::string text) override { texts.push_back(Json::parse(text)); }
    void send_bytes(std::string bytes) override { packets.push_back(std::move(bytes)); }
    bool is_behind() const override { return false; }

    /// The last message that says so; null if there is none.
    Json last(const std::string& say) const {
        for (auto text = texts.rbegin(); text != texts.rend(); ++text) {
            if (text->value("say", "") == say) return *text;
        }
        return nullptr;
    }

    std::vector<Json> texts;
    std::vector<std::string> packets;
};

/// Work posted by growths, done when a test says so.
class Mailbox {
public:
    void post(std::function<void()> work) {
        const std::lock_guard lock(mutex_);
        work_.push_back(std::move(work));
        arrived_.notify_all();
    }
    /// False if nothing came for so long.
    bool work_once(std::chrono::milliseconds patience) {
        std::function<void()> work;
        {
            std::unique_lock lock(mutex_);
            if (!arrived_.wait_for(lock, patience, [this] { return !work_.empty(); })) return false;
            work = std::move(work_.front());
            work_.pop_front();
        }
        work();
        return true;
    }

private:
    std::mutex mutex_;
    std::condition_variable arrived_;
    std::deque<std::function<void()>> work_;
};

inline espalier::Scene read_as_run(const espalier::studio::Opened& opened) {
    const espalier::SceneOptions options{{}, opened.steps, opened.seed};
    if (opened.path.extension() == ".toml") return espalier::read_scene(opened.path, options);
    espalier::ObjectFiles object;
    object.model = opened.path;
    return espalier::scene_of_object(object, options);
}

}  // namespace studio_test
