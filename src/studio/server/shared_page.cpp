#include "studio/server/shared_page.h"

#include "espalier/base/error.h"

#include "base/base64.h"
#include "environment/light/sky/scene_sky.h"
#include "studio/growth/recorded_frame.h"
#include "studio/server/page_files.h"
#include "studio/server/page_text.h"
#include "studio/server/shared_organs.h"
#include "studio/session/sky_message.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace espalier::studio {
namespace {

using Json = nlohmann::ordered_json;

std::string packed(const Json& json) {
    return base64(deflated(json.dump(-1, ' ', false, Json::error_handler_t::replace)));
}

/// What the viewer does when it fits a plant that it sees from the side, in a window that is no higher than wide.
Json camera_for(const FrameGeometry& geometry) {
    glm::vec3 lower(0), upper(0, 1, 0);
    if (!geometry.points.empty()) {
        lower = glm::vec3(std::numeric_limits<float>::max()), upper = -lower;
        for (const glm::vec3& point : geometry.points) lower = glm::min(lower, point), upper = glm::max(upper, point);
    }
    const glm::vec3 size = upper - lower, middle = 0.5f * (lower + upper);
    constexpr double azimuth = 0.5, elevation = 0.16, half_of_view = 16 * std::numbers::pi / 180;
    const double wide = std::max(size.x, size.z) / 2, high = size.y / 2 + 0.3 * wide * std::sin(elevation);
    const double distance = 1.18 * std::max({high, wide, 1e-4}) / std::tan(half_of_view) + 0.6 * wide;
    return {{"target", {middle.x, middle.y, middle.z}},
            {"distance", distance},
            {"azimuth", azimuth},
            {"elevation", elevation}};
}

/// Up to a step. Nothing where a measured series has gone since: the page then has its usual light.
std::optional<environment::SceneSky> sky_of(const RecordedRun& run, int last_step) {
    try {
        auto sky = environment::sky_of_run(run.folder());
        if (sky) sky->at_step(last_step);
        return sky;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

Json recording_of(const RecordedRun& run, const std::vector<const RecordedFrame*>& frames, const SharedPage& page) {
    Json steps = Json::array(), packets = Json::array(), moments = Json::array(), skies = Json::array();
    const std::optional<environment::SceneSky> sky = sky_of(run, frames.back()->step);
    SharedOrgans organs(run);
    for (const RecordedFrame* const frame : frames) {
        const DrawnFrame drawn(run, *frame);
        steps.push_back(frame->step);
        packets.push_back(base64(deflated(drawn.packet(1, frame->step))));
        moments.push_back(packed(organs.add(drawn)));
        if (sky) skies.push_back(json_of(shown_sky(sky->at_step(frame->step))));
    }
    const Json none = Json::array();
    return {{"title", page.title},
            {"theme", page.is_dark ? "dark" : "light"},
            {"steps", steps},
            {"packets", packets},
            {"shapes", none},
            {"images", none},
            {"reliefs", none},
            {"limbs", none},
            {"organs", packed(organs.table())},
            {"moments", moments},
            {"skies", skies},
            {"camera", camera_for(run.geometry(*frames.back()))},
            {"light", {{"towardsEye", nullptr}, {"towardsLight", nullptr}, {"background", nullptr}}}};
}

/// The first of the two scripts of the page: what a shared file has, too.
std::string_view viewer() {
    const std::string_view script = page_file("/studio.js")->bytes;
    return script.substr(0, script.find("/*--- studio ---*/"));
}

}  // namespace

std::string shared_page(const RecordedRun& run, const std::vector<const RecordedFrame*>& frames,
                        const SharedPage& page) {
    const std::string recording = recording_of(run, frames, page).dump(-1, ' ', false, Json::error_handler_t::replace);
    return fmt::format(R"(<!doctype html>
<html lang="en" data-theme="{}">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:">
<title>{}</title>
<style>{}</style>
</head>
<body class="recording">
<script type="application/json" id="recording">{}</script>
<script>{}
EspalierView.playRecording();</script>
</body>
</html>
)",
                       page.is_dark ? "dark" : "light", in_html(page.title), page_file("/studio.css")->bytes,
                       in_script(recording, "\\u003c"), in_script(viewer(), "<\\"));
}

}  // namespace espalier::studio
