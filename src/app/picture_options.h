// Options of commands that draw: --size and --dark.
#pragma once

#include "espalier/timeline/chart_page.h"

#include <CLI/CLI.hpp>

#include <string>

namespace espalier {

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

}  // namespace espalier
