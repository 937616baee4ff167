// Options of commands that draw, and what their words mean.
#pragma once

#include "espalier/picture/chart_page.h"
#include "espalier/picture/picture_style.h"

#include <CLI/CLI.hpp>

#include <array>
#include <optional>
#include <string>

namespace espalier::app {

/// --size and --dark.
class PictureOptions {
public:
    explicit PictureOptions(CLI::App& command);

    bool dark() const { return dark_; }
    /// As asked for, or the one given. Throws UserError if --size is not WIDTHxHEIGHT.
    PictureSize size(const PictureSize& otherwise) const;

private:
    std::string size_;
    bool dark_ = false;
};

/// --camera.
class CameraOption {
public:
    explicit CameraOption(CLI::App& command);

    /// False where the author's place of the camera is wanted.
    bool is_ours() const { return camera_ == "auto"; }

private:
    std::string camera_ = "author";
};

// What these words mean; each throws UserError saying what is expected.

/// "1200x800", of an option.
PictureSize picture_size(const std::string& option, const std::string& text);
/// "LOW:HIGH", two numbers of which the first is less; none for another text.
std::optional<std::array<double, 2>> low_and_high(const std::string& text);
/// "light", "dark", "transparent" or "#rrggbb".
PictureBackground picture_background(const std::string& text);
/// "water", "water:volume", "water:slice", "water:slice=z0.5", "water:iso", "water:iso=0.3".
FieldLook field_look(const std::string& text);

}  // namespace espalier::app
