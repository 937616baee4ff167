#include "studio/server/shared_page.h"

#include "espalier/base/error.h"

#include "environment/light/sky/scene_sky.h"
#include "studio/growth/recorded_frame.h"
#include "studio/packets/field_bytes.h"
#include "studio/server/frame_texts.h"
#include "studio/server/page_files.h"
#include "studio/server/page_text.h"
#include "studio/server/shared_organs.h"
#include "studio/session/sky_message.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace espalier::studio {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
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

/// The fields that were recorded as grids, at most once a step.
class SharedFields {
public:
    SharedFields(const RecordedRun& run, const std::vector<const RecordedFrame*>& frames) : run_(run) {
        for (const std::string& name : run.field_names()) {
            const auto has = [&](const RecordedFrame* frame) { return frame->fields.contains(name); };
            if (std::all_of(frames.begin(), frames.end(), has)) names_.push_back(name);
        }
        texts_.resize(names_.size());
    }

    void add(const RecordedFrame& frame) {
        for (std::size_t i = 0; i < names_.size(); ++i) {
            const RecordedField field = run_.field(frame, names_[i]);
            units_[names_[i]] = field.unit;
            texts_[i].add(field_bytes(field, 1, frame.step));
        }
    }

    Json take() {
        Json fields = Json::array();
        for (std::size_t i = 0; i < names_.size(); ++i) {
            fields.push_back({{"name", names_[i]}, {"unit", units_[names_[i]]}, {"texts", texts_[i].take()}});
        }
        return fields;
    }

private:
    const RecordedRun& run_;
    std::vector<std::string> names_;
    std::map<std::string, std::string> units_;
    std::vector<FrameTexts> texts_;
};

Json recording_of(const RecordedRun& run, const std::vector<const RecordedFrame*>& frames, const SharedPage& page) {
    Json steps = Json::array(), skies = Json::array();
    FrameTexts packets, moments;
    const std::optional<environment::SceneSky> sky = sky_of(run, frames.back()->step);
    SharedOrgans organs(run);
    SharedFields fields(run, frames);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const RecordedFrame* const frame = frames[i];
        if (page.progress) page.progress(i, frames.size());
        const DrawnFrame drawn(run, *frame);
        steps.push_back(frame->step);
        packets.add(drawn.packet(1, frame->step));
        moments.add(text_of(organs.add(drawn)));
        fields.add(*frame);
        if (sky) skies.push_back(json_of(shown_sky(sky->at_step(frame->step))));
    }
    const Json none = Json::array();
    return {{"title", page.title},
            {"theme", page.is_dark ? "dark" : "light"},
            {"letters", page_letters},
            {"together", FrameTexts::together},
            {"steps", steps},
            {"packets", packets.take()},
            {"shapes", none},
            {"images", none},
            {"reliefs", none},
            {"limbs", none},
            {"organs", in_letters(packed_by_xz(text_of(organs.table())))},
            {"moments", moments.take()},
            {"fields", fields.take()},
            {"skies", skies},
            {"camera", nullptr},
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
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; style-src 'unsafe-inline'; img-src data: blob:">
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
