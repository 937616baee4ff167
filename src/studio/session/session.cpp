#include "studio/session/session.h"

#include "base/reason.h"
#include "studio/session/request.h"

#include <fmt/format.h>

#include <exception>
#include <utility>

namespace espalier::studio {
namespace {

struct AllTold {
    static constexpr TypeName type{"AllTold", "a page knows all that there is"};
    Nullable<std::uint32_t> growth;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("growth", self.growth, "the growth that was told; null if nothing grows yet");
    }
};

const Message<AllTold> told_message{"told", "to a new page, behind all that it is told at first"};

const RequestType& request_named(const std::string& name) {
    const auto& requests = registered<RequestType>();
    const auto found = requests.find(name);
    if (found == requests.end()) throw UserError(fmt::format("there is no request '{}'", name));
    return *found->second;
}

std::string name_of(const Json& request) {
    const auto name = request.find("do");
    if (name == request.end() || !name->is_string()) throw UserError("'do' is no text");
    return name->get<std::string>();
}

}  // namespace

Session::Session(const StudioOptions& options, Post post) : parts_(options, guarded(std::move(post))) {
    parts_.document.on_change([this](const DocumentChange& change) {
        if (change.is_other) parts_.disk.forget();
        parts_.growths.begin(change);
    });
    parts_.disk.restore();
    if (parts_.document.is_open()) parts_.growths.begin({true, {}});
}

Session::~Session() = default;

Post Session::guarded(Post post) {
    return [this, alive = std::weak_ptr(alive_), post = std::move(post)](std::function<void()> work) {
        post([this, alive, work = std::move(work)] {
            if (!alive.expired()) guard(work);
        });
    };
}

void Session::leave(Page& page) {
    parts_.pages.leave(page);
    parts_.jobs.forget(page);
    parts_.sweeps.forget(page);
}

void Session::receive(Page& page, const std::string& text) {
    Viewer* const viewer = parts_.pages.find(&page);
    if (!viewer) return;
    Json reply = {{"reply", nullptr}};
    try {
        const Json request = read_request(text);
        reply["reply"] = request["id"];
        reply.update(request_named(name_of(request)).answer(parts_, *viewer, request));
    } catch (const std::exception& error) {
        reply["error"] = reason_of(error);
    }
    Pages::send(*viewer, reply);
    // What a page shows at first it is told behind the reply to its greeting.
    if (viewer->is_new && !reply.contains("error")) guard([&] { greet(*viewer); });
}

void Session::greet(Viewer& viewer) {
    viewer.is_new = false;
    parts_.document.send_to(viewer);
    parts_.pages.send_notes(viewer);
    parts_.growths.send_to(viewer);
    parts_.fits.send_to(viewer);
    Pages::send(viewer, told_message({parts_.growths.number()}));
}

void Session::tick() {
    guard([this] {
        parts_.growths.tick();
        parts_.jobs.tick();
        parts_.disk.tick();
    });
}

// A file that has gone meanwhile must not end the studio.
void Session::guard(const std::function<void()>& work) {
    try {
        work();
    } catch (const std::exception& error) {
        parts_.pages.notify("error", reason_of(error));
    }
}

}  // namespace espalier::studio
