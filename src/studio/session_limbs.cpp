// Limbs with bark and skin, which a page asks for.
#include "studio/session.h"
#include "studio/session_viewer.h"

#include <fmt/format.h>

namespace espalier::studio {

using Json = nlohmann::ordered_json;

/// What the status line says while it is made.
constexpr const char* skin_name(bool smooth) {
    return smooth ? "smooth skin" : "bark";
}

Json Session::limbs(Viewer& viewer, const Json& request) {
    for (const auto& [page, run] : limb_runs_) {
        if (page == &viewer.page) run->cancel();
    }
    if (request.at("skin").is_null()) return Json::object();
    const Growth& growth = grown_by(request);
    const int step = request.at("step").get<int>();
    if (!growth.steps().has(step)) throw UserError(fmt::format("step {} has not been grown", step));
    const bool smooth = request["skin"].get<std::string>() == "smooth";
    Page* const page = &viewer.page;
    const auto tell_page = [this, page](auto send) {
        post_([this, page, send] {
            for (const auto& known : viewers_) {
                if (&known->page == page) send(*page);
            }
        });
    };
    const auto progressed = [tell_page, smooth](double share) {
        const Json progress{{"say", "progress"}, {"what", skin_name(smooth)}, {"done", share}};
        tell_page([text = progress.dump()](Page& to) { to.send_text(text); });
    };
    const auto done = [this, tell_page, progressed](std::string bytes, const std::string& why) {
        progressed(1);
        if (why.empty()) {
            tell_page([bytes = std::move(bytes)](Page& to) { to.send_bytes(bytes); });
        } else {
            post_([this, why] { say("error", why); });
        }
    };
    limb_runs_.emplace_back(
        page, std::make_unique<LimbRun>(LimbOrder{growth.steps().packet(step), growth.steps().textures(), smooth},
                                        progressed, done));
    return Json::object();
}

}  // namespace espalier::studio
