// A studio without a network: pages that remember what they were told, and the work that other threads post.
#pragma once

#include "espalier/simulation/object.h"

#include "catch.h"
#include "studio/session.h"
#include "temporary_folder.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

namespace studio_test {

using Json = espalier::studio::Session::Json;

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

/// A folder with a model, and a studio that has it open.
class OpenStudio {
public:
    explicit OpenStudio(const std::string& model, const std::string& name = "plant.l") {
        options.folder = folder.path();
        options.scratch = scratch.path();
        options.read = read_as_run;
        options.library = [] { return std::vector<espalier::studio::LibraryEntry>(); };
        options.opened.path = file = folder.write(name, model);
    }
    ~OpenStudio() { session.reset(); }

    /// Begins, with one page that has said hello.
    ListeningPage& begin() {
        session = std::make_unique<espalier::studio::Session>(
            options, [this](std::function<void()> work) { mailbox.post(std::move(work)); });
        session->join(page);
        ask({{"do", "hello"}});
        return page;
    }

    /// The reply to a request.
    Json ask(Json request) {
        request["id"] = ++requests_;
        session->receive(page, request.dump());
        for (const Json& text : page.texts) {
            if (text.contains("reply") && text["reply"] == requests_) return text;
        }
        return nullptr;
    }

    /// Does what arrives until `done` holds; fails after ten seconds.
    template <class Done>
    void wait(const Done& done) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (!done() && std::chrono::steady_clock::now() < end) {
            mailbox.work_once(std::chrono::milliseconds(20));
            session->tick();
        }
        REQUIRE(done());
    }
    /// Until the newest version has grown to its end.
    void wait_until_grown() {
        wait([this] {
            const Json growth = page.last("growth");
            const Json document = page.last("document");
            return !growth.is_null() && growth["state"] == "done" && growth["version"] == document["version"];
        });
    }

    Json change(Json what, bool transient = false) {
        what["do"] = "change";
        what["transient"] = transient;
        return ask(what);
    }

    TemporaryFolder folder, scratch;
    std::filesystem::path file;
    espalier::studio::StudioOptions options;
    Mailbox mailbox;
    ListeningPage page;
    std::unique_ptr<espalier::studio::Session> session;

private:
    int requests_ = 0;
};

/// A number of a binary message.
template <class T>
T number_at(const std::string& bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

}  // namespace studio_test
