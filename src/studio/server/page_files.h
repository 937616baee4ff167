// The page of the studio, which is part of the program.
#pragma once

#include <optional>
#include <string_view>

namespace espalier::studio {

struct PageFile {
    std::string_view type, bytes;
};

/// The file at an address such as "/studio.js"; "/" is the page itself.
std::optional<PageFile> page_file(std::string_view address);

/// The page that needs no server, without a growth; studio/site.mjs makes it.
std::string_view live_page_file();

}  // namespace espalier::studio
