#include "light_options.h"

#include "espalier/base/error.h"

#include "base/number.h"
#include "environment/light/sky/scene_sky.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::app {
namespace {

constexpr const char* group = "Light";

std::optional<environment::SceneSky> sky_of_scene(const RenderJob& job) {
    try {
        return environment::sky_of_run(job.run.folder());
    } catch (const UserError& error) {
        throw UserError(fmt::format("{}; --sky clear takes another one", error.what()));
    }
}

PictureSky::Kind drawn_kind(environment::SceneSky::Kind kind) {
    using Kind = environment::SceneSky::Kind;
    if (kind == Kind::uniform) return PictureSky::Kind::uniform;
    return kind == Kind::overcast ? PictureSky::Kind::overcast : PictureSky::Kind::clear;
}

PictureSky drawn_sky(const environment::SceneSky& scene, const RecordedFrame& frame) {
    const environment::StepSky step = scene.at_step(frame.step);
    PictureSky sky;
    sky.kind = drawn_kind(scene.kind());
    sky.diffuse = step.diffuse;
    if (!step.sun) return sky;
    const glm::dvec3& towards = *step.sun;
    sky.sun = {glm::degrees(std::atan2(towards.x, towards.z)), glm::degrees(std::asin(std::min(1.0, towards.y)))};
    return sky;
}

}  // namespace

LightOptions::LightOptions(CLI::App& command) : command_(command) {
    const auto option = [](CLI::Option* added) { return added->group(group); };
    option(command.add_flag("--light", light_,
                            "follow paths of light from sun and sky: soft shadows, leaves that light shines through, a "
                            "sky behind the plants; takes seconds to minutes"));
    option(
        command.add_option("--samples", samples_, "paths of light in each pixel; four times as many halve the noise"))
        ->check(CLI::Range(1, 65536))
        ->capture_default_str();
    option(command.add_option("--noise", noise_,
                              "go on in each pixel until its standard error is less, as a share of white, such as "
                              "0.01; --samples is then the most, 4096 if it is not given"))
        ->check(CLI::Range(0.0005, 0.5));
    option(command.add_option("--sky", sky_,
                              "scene: that of the scene's light process, if it has one, else clear; clear, overcast or "
                              "uniform"))
        ->check(CLI::IsMember({"scene", "clear", "overcast", "uniform"}))
        ->capture_default_str();
    option(command.add_option("--sun", sun_,
                              "AZIMUTH:ELEVATION of the sun in degrees, counted as those of the camera; default: that "
                              "of the scene's sky; else to the left of the camera, 40 degrees high"));
    option(command.add_option("--exposure", stops_,
                              "brightness: +1 doubles it, -1 halves it; at 0, what lies in the open and reflects half "
                              "of the light is bright"))
        ->check(CLI::Range(-10.0, 10.0));
}

void LightOptions::check() const {
    if (!light_) {
        for (const char* name : {"--samples", "--noise", "--sky", "--sun", "--exposure"}) {
            if (command_.count(name) > 0) throw UserError(fmt::format("{} needs --light", name));
        }
        return;
    }
    if (command_.count("--no-shade") > 0) {
        throw UserError("--no-shade and --light do not go together: light casts shadows; leave one out");
    }
    (void)sun();
}

std::optional<std::array<double, 2>> LightOptions::sun() const {
    if (sun_.empty()) return std::nullopt;
    const std::size_t colon = sun_.find(':');
    if (colon != std::string::npos) {
        const auto azimuth = finite_number(sun_.substr(0, colon)), elevation = finite_number(sun_.substr(colon + 1));
        if (azimuth && elevation && *elevation >= 0 && *elevation <= 90) return std::array{*azimuth, *elevation};
    }
    throw UserError(
        fmt::format("--sun {}: expected AZIMUTH:ELEVATION in degrees, the elevation from 0 to 90, such as "
                    "-40:35",
                    sun_));
}

void LightOptions::apply(RenderJob& job) const {
    if (!light_) return;
    PictureLight light;
    light.samples = noise_ > 0 && command_.count("--samples") == 0 ? 4096 : samples_;
    light.noise = noise_;
    light.stops = stops_;
    light.sky.sun = sun();
    light.shows_sky = command_.count("--background") == 0 && command_.count("--dark") == 0;
    if (sky_ == "overcast") light.sky.kind = PictureSky::Kind::overcast;
    if (sky_ == "uniform") light.sky.kind = PictureSky::Kind::uniform;
    job.style.light = light;
    if (sky_ != "scene") return;
    if (auto sky = sky_of_scene(job)) {
        job.sky_at = [sky = *sky, given = light.sky](const RecordedFrame& frame) {
            PictureSky here = drawn_sky(sky, frame);
            if (given.sun) here.sun = given.sun;
            return here;
        };
    }
}

}  // namespace espalier::app
