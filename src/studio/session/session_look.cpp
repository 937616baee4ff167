// What pages are told of the look of plants: limbs with bark and skin, which a page asks for, and the author's view.
#include "espalier/turtle/view_setting.h"

#include "simulation/run/view_record.h"
#include "studio/session/request_text.h"
#include "studio/session/session.h"
#include "studio/session/session_viewer.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <string_view>

namespace espalier::studio {

using Json = nlohmann::ordered_json;

/// What the status line says while it is made.
constexpr const char* skin_name(bool smooth) {
    return smooth ? "smooth skin" : "bark";
}

Json Session::limbs(Viewer& viewer, const Json& request) {
    const auto running = limb_runs_.find(&viewer.page);
    if (running != limb_runs_.end()) running->second->cancel();
    waiting_limbs_.erase(&viewer.page);
    if (request.at("skin").is_null()) return Json::object();
    const PlantSource& shown = grown_by(request);
    const int step = whole<int>(request, "step");
    if (!shown.has_packet(step)) throw UserError(fmt::format("step {} has not been drawn", step));
    const bool smooth = request["skin"].get<std::string>() == "smooth";
    Page* const page = &viewer.page;
    const auto progressed = [this, page, smooth](double share) {
        const Json progress{{"say", "progress"}, {"what", skin_name(smooth)}, {"done", share}};
        send_later(page, [text = progress.dump()](Page& to) { to.send_text(text); });
    };
    const auto done = [this, page, progressed](std::string bytes, const std::string& why) {
        progressed(1);
        if (why.empty()) {
            send_later(page, [bytes = std::move(bytes)](Page& to) { to.send_bytes(bytes); });
        } else {
            post_([this, why] { notify("error", why); });
        }
    };
    auto order = std::make_shared<const LimbOrder>(LimbOrder{shown.limb_axes(step), shown.number(), step, smooth});
    waiting_limbs_[page] = [order = std::move(order), progressed, done] {
        return std::make_unique<LimbRun>(order, progressed, done);
    };
    begin_limbs();
    return Json::object();
}

// One at a time for each page: those that were cancelled still take the machine until they end.
void Session::begin_limbs() {
    std::erase_if(limb_runs_, [](const auto& run) { return run.second->has_ended(); });
    std::erase_if(waiting_limbs_, [this](const auto& waiting) {
        const auto& [page, make] = waiting;
        if (limb_runs_.contains(page)) return false;
        limb_runs_[page] = make();
        return true;
    });
}

Json Session::view_json() const {
    return {{"say", "view"},
            {"growth", growth_->number()},
            {"view", growth_->scene() ? simulation::view_json(*growth_->scene()) : Json()}};
}

namespace {

constexpr std::string_view name_of(ViewKind kind) {
    switch (kind) {
        case ViewKind::number:
            return "number";
        case ViewKind::whole:
            return "whole";
        case ViewKind::on_off:
            return "switch";
        case ViewKind::word:
            return "word";
        case ViewKind::vector:
            return "vector";
        case ViewKind::colour:
            return "colour";
        case ViewKind::file:
            return "file";
        case ViewKind::flag:
            return "flag";
        case ViewKind::letters:
            return "letters";
        case ViewKind::other:
            break;
    }
    return "other";
}

Json value_json(const ViewValue& value) {
    const auto bound = [](double number) { return std::isfinite(number) ? Json(number) : Json(); };
    Json words = Json::array();
    std::istringstream list{std::string(value.words)};
    for (std::string word; list >> word;) words.push_back(word);
    return {{"kind", name_of(value.kind)},
            {"help", value.help},
            {"standard", value.standard},
            {"unit", value.unit},
            {"lowest", bound(value.lowest)},
            {"highest", bound(value.highest)},
            {"words", words},
            {"letter", value.letter ? std::string(1, value.letter) : ""}};
}

}  // namespace

Json view_settings_json() {
    Json list = Json::array();
    for (const ViewSetting& setting : view_settings()) {
        Json json = value_json(setting.value);
        json["name"] = setting.label;
        json["values"] = setting.values;
        json["group"] = setting.group;
        json["letters"] = Json::array();
        for (const ViewValue& letter : setting.letters) json["letters"].push_back(value_json(letter));
        list.push_back(std::move(json));
    }
    return list;
}

}  // namespace espalier::studio
