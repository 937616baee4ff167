// A studio without a network.
#pragma once

#include "espalier/simulation/simulation.h"

#include "catch.h"
#include "listening_page.h"
#include "temporary_folder.h"

#include <chrono>
#include <cstring>
#include <memory>
#include <string>

namespace studio_test {

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
        session.reset();  // two would share one scratch folder
        session = std::make_unique<espalier::studio::Session>(
            options, [this](std::function<void()> work) { mailbox.post(std::move(work)); });
        version_ = 0;
        session->join(page);
        ask({{"do", "hello"}});
        return page;
    }

    /// The reply to a request.
    Json ask(Json request) {
        request["id"] = ++requests_;
        session->receive(page, request.dump());
        for (const Json& text : page.texts) {
            if (!text.contains("reply") || text["reply"] != requests_) continue;
            if (text.contains("version") && text["version"].is_number()) version_ = text["version"];
            return text;
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
            return !growth.is_null() && !document.is_null() && growth["state"] == "done" &&
                   growth["version"] == document["version"] && document["version"] >= version_;
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
    std::uint64_t version_ = 0;  ///< version of the document, as the last reply told
};

/// Grows a file with a timeline, as `espalier run FILE --steps STEPS --output FOLDER` does.
inline void record(const std::filesystem::path& file, int steps, const std::filesystem::path& folder) {
    const espalier::ReadLog reads;
    espalier::RunOptions options;
    options.output = folder;
    options.arguments = {file.string(), "--steps", std::to_string(steps)};
    options.inputs = &reads;
    espalier::run(read_as_run({file, steps, {}}), options);
}

/// A number of a binary message.
template <class T>
T number_at(const std::string& bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

/// Of a packet of growth.
inline std::size_t internodes(const std::string& packet) {
    return number_at<std::uint32_t>(packet, 16);
}

}  // namespace studio_test
