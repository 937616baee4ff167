#include "picture_options.h"

#include "espalier/base/error.h"

#include "app/options.h"
#include "base/number.h"
#include "base/text.h"
#include "picture/palette.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace espalier::app {

PictureOptions::PictureOptions(CLI::App& command) {
    command.add_option("--size", size_, "WIDTHxHEIGHT in pixels; default: depends on the content");
    command.add_flag("--dark", dark_, "use a dark background");
}

CameraOption::CameraOption(CLI::App& command) {
    command
        .add_option("--camera", camera_,
                    "author: place of the camera and light as in the view file of the model, if there is one; auto: "
                    "from azimuth 30 and elevation 12")
        ->check(CLI::IsMember({"author", "auto"}))
        ->capture_default_str();
}

PictureSize PictureOptions::size(const PictureSize& otherwise) const {
    return size_.empty() ? otherwise : picture_size("--size", size_);
}

PictureSize picture_size(const std::string& option, const std::string& text) {
    const std::size_t cross = std::min(text.find('x'), text.size() - 1);
    const auto width = whole_text_as<int>(text.substr(0, cross)), height = whole_text_as<int>(text.substr(cross + 1));
    if (width && height && *width > 0 && *height > 0) return {*width, *height};
    throw UserError(option == "--size" ? fmt::format("--size {}: expected WIDTHxHEIGHT, such as 1200x800", text)
                                       : fmt::format("{} {}: expected COLUMNSxROWS, such as 4x2", option, text));
}

std::optional<std::array<double, 2>> low_and_high(const std::string& text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos) return std::nullopt;
    const auto low = finite_number(text.substr(0, colon)), high = finite_number(text.substr(colon + 1));
    return low && high && *low < *high ? std::optional(std::array{*low, *high}) : std::nullopt;
}

PictureBackground picture_background(const std::string& text) {
    if (text == "light") return light_background;
    if (text == "dark") return dark_background;
    if (text == "transparent") return {light_background.rgb, true};
    if (const auto rgb = picture::hex_colour(text)) return {*rgb, false};
    throw UserError(fmt::format("--background {}: expected light, dark, transparent or #rrggbb", text));
}

FieldLook field_look(const std::string& text) {
    const auto reject = [&](const std::string& why) { throw UserError(fmt::format("--field {}: {}", text, why)); };
    FieldLook look;
    const std::size_t colon = text.rfind(':');
    look.name = text.substr(0, colon);
    if (look.name.empty()) reject("expected the name of a field, such as water:slice");
    if (colon == std::string::npos) return look;
    const std::string how = text.substr(colon + 1);
    const std::size_t equals = how.find('=');
    const std::string kind = how.substr(0, equals);
    std::string value = equals == std::string::npos ? "" : how.substr(equals + 1);
    const std::vector<std::string> kinds{"volume", "slice", "iso"};
    if (kind == "volume" && equals == std::string::npos) {
        look.kind = FieldLook::Kind::volume;
    } else if (kind == "slice") {
        look.kind = FieldLook::Kind::slice;
        const bool has_axis = !value.empty() && value[0] >= 'x' && value[0] <= 'z';
        if (has_axis) look.axis = value[0], value.erase(0, 1);
        look.place = finite_number(value);
        if ((equals != std::string::npos && !has_axis) || (!value.empty() && !look.place)) {
            reject("expected slice=z, or slice=z0.5 with a position in metres");
        }
    } else if (kind == "iso") {
        look.kind = FieldLook::Kind::surface;
        look.level = finite_number(value);
        if (equals != std::string::npos && !look.level) reject("expected iso=0.3, with the value of the surface");
    } else {
        reject(
            fmt::format("expected volume, slice[=AXIS[METRES]] or iso[=VALUE] after ':'{}", did_you_mean(kind, kinds)));
    }
    return look;
}

}  // namespace espalier::app
