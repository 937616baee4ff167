// The studio's session in the worker of a page: what `espalier studio` serves over a socket, said by messages.
//
// The worker's script (studio/source/worker.ts) calls these functions and takes what is said by two functions of the
// module, `said(text)` and `sent(bytes)`.
#include "studio/session/session.h"

#include "espalier/studio/studio.h"

#include "app/look/studio_documents.h"
#include "base/reason.h"
#include "studio/growth/workers.h"

#include <nlohmann/json.hpp>

#include <deque>
#include <emscripten.h>
#include <functional>
#include <memory>
#include <utility>

EM_JS(void, say_text, (const char* text), { Module.said(UTF8ToString(text)); });
EM_JS(void, send_bytes_of, (const char* bytes, unsigned count),
      { Module.sent(HEAPU8.slice(bytes, bytes + count).buffer); });

namespace espalier::studio {
namespace {

/// The page that the worker belongs to.
class OwnPage final : public Page {
public:
    void send_text(std::string text) override { say_text(text.c_str()); }
    void send_bytes(std::string bytes) override {
        ++untaken_;
        send_bytes_of(bytes.data(), static_cast<unsigned>(bytes.size()));
    }
    bool is_behind() const override { return untaken_ > 2; }
    void take() { --untaken_; }

private:
    int untaken_ = 0;
};

class WebStudio {
public:
    explicit WebStudio(const Json& begin)
        : options_(options_of(begin)), session_(options_, [this](auto work) { posted_.push_back(std::move(work)); }) {
        session_.join(page_);
    }

    void receive(const std::string& text) {
        session_.receive(page_, text);
        do_posted();
    }
    void take() { page_.take(); }
    void tick() {
        session_.tick();
        do_posted();
    }
    bool take_turns() {
        const bool goes_on = Workers::take_turns();
        do_posted();
        return goes_on;
    }
    std::string file(std::uint32_t number) const {
        const auto file = session_.file(number);
        return file ? file->string() : "";
    }

private:
    static StudioOptions options_of(const Json& begin) {
        StudioOptions options;
        options.folder = "/home";
        options.library_folder = "/library";
        options.scratch = "/scratch";
        options.state = "/state/studio.json";
        options.opened.path = begin.value("open", "");
        if (begin.contains("seed")) options.opened.seed = begin["seed"].get<std::uint64_t>();
        if (begin.contains("steps")) options.opened.steps = begin["steps"].get<int>();
        options.is_named = begin.value("named", false);
        options.memory = std::size_t{begin.value("memory", 1024u)} << 20;
        options.read = [](const Opened& opened) {
            Scene scene = app::read_opened(opened);
            app::require_no_programs(scene);
            return scene;
        };
        options.library = [library = app::StudioLibrary("/home")] { return library.entries(); };
        return options;
    }

    void do_posted() {
        while (!posted_.empty()) {
            const std::function<void()> work = std::move(posted_.front());
            posted_.pop_front();
            work();
        }
    }

    const StudioOptions options_;
    std::deque<std::function<void()>> posted_;
    OwnPage page_;
    Session session_;
};

std::unique_ptr<WebStudio> studio_of_page;
std::string answered;  ///< stays until the next answer

}  // namespace
}  // namespace espalier::studio

using espalier::studio::studio_of_page;

extern "C" {

/// Begins with what the page says, JSON: open (a path, "" for none), seed, steps, named, memory (MiB). Returns why it
/// cannot, or "".
EMSCRIPTEN_KEEPALIVE const char* espalier_begin(const char* begin) {
    try {
        studio_of_page = std::make_unique<espalier::studio::WebStudio>(nlohmann::ordered_json::parse(begin));
        espalier::studio::answered.clear();
    } catch (const std::exception& error) {
        espalier::studio::answered = espalier::reason_of(error);
    }
    return espalier::studio::answered.c_str();
}

/// A request.
EMSCRIPTEN_KEEPALIVE void espalier_receive(const char* text) {
    studio_of_page->receive(text);
}

/// The page has taken a binary message.
EMSCRIPTEN_KEEPALIVE void espalier_taken() {
    studio_of_page->take();
}

/// Several times a second.
EMSCRIPTEN_KEEPALIVE void espalier_tick() {
    studio_of_page->tick();
}

/// A piece of what there is to do. 0: nothing, until a message comes.
EMSCRIPTEN_KEEPALIVE int espalier_turn() {
    return studio_of_page->take_turns() ? 1 : 0;
}

/// The path of a file that a reply named; "" if there is none.
EMSCRIPTEN_KEEPALIVE const char* espalier_file(unsigned number) {
    espalier::studio::answered = studio_of_page->file(number);
    return espalier::studio::answered.c_str();
}
}
