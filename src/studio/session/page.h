// A page in a browser, as its session sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

namespace espalier::studio {

/// A page in a browser.
class Page {
public:
    virtual ~Page() = default;
    virtual void send_text(std::string text) = 0;
    virtual void send_bytes(std::string bytes) = 0;
    /// True while it has not yet taken what was sent: packets that only pass by are then left out.
    virtual bool is_behind() const = 0;
};

/// What a session knows of a page.
struct Viewer {
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
