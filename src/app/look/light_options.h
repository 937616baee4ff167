// Options of a picture that light paths make, and the sky of a run.
#pragma once

#include "espalier/picture/render.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace espalier::app {

/// --light, and what it needs: --samples, --noise, --sky, --sun, --exposure.
class LightOptions {
public:
    explicit LightOptions(CLI::App& command);

    bool is_on() const { return light_; }
    /// Throws UserError for options that need --light or each other, and for a sun that is none.
    void check() const;
    /// As asked for, into a style and, where the scene's own sky is wanted, the sky of each frame.
    void apply(RenderJob& job) const;

private:
    std::optional<std::array<double, 2>> sun() const;

    const CLI::App& command_;
    bool light_ = false;
    int samples_ = 64;
    double noise_ = 0, stops_ = 0;
    std::string sky_ = "scene", sun_;
};

}  // namespace espalier::app
