// A page as its session knows it.
#pragma once

#include "studio/session/session.h"

#include <optional>
#include <set>

namespace espalier::studio {

struct Session::Viewer {
    explicit Viewer(Page& its_page) : page(its_page) {}

    Page& page;
    bool is_new = true;            ///< has not been told what there is
    std::optional<int> step = {};  ///< that it looks at; none: the last
    std::uint32_t growth = 0;      ///< whose shapes it has
    std::size_t shapes = 0;        ///< messages of them
    std::size_t textures = 0;      ///< textures of this growth that it knows
    std::set<int> awaits = {};     ///< steps of the present growth that are sent when they have been drawn
};

}  // namespace espalier::studio
