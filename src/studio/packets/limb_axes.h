// The axes of a step as they were drawn: what limbs are made of.
#pragma once

#include "espalier/geometry/frame_geometry.h"
#include "espalier/timeline/frame.h"

#include "studio/packets/textures.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::studio {

/// Lines, and the module behind each of their points. Modules are counted through the plants of the step, textures are
/// numbers of what the page wears.
struct LimbAxes {
    FrameGeometry geometry;
    std::vector<std::uint32_t> modules;
};

/// What a step keeps of its axes until a page asks for limbs.
class KeptAxes {
public:
    using Rgb = std::array<std::uint8_t, 3>;

    struct Look {
        std::function<Rgb(std::uint32_t plant, std::uint16_t colour)> colour;
        std::function<std::uint32_t(std::uint32_t plant, std::uint16_t texture)> texture;  ///< as pages count them
    };
    KeptAxes(const timeline::Frame& frame, const Look& look);
    explicit KeptAxes(std::string_view bytes);

    std::string bytes() const;
    LimbAxes axes(const std::vector<BrowserTexture>& textures) const;

private:
    template <class Self, class Visit>
    static void for_columns(Self& self, const Visit& visit);

    // Of the points.
    Column<glm::vec3> points_;
    Column<float> radii_;
    Column<std::uint32_t> modules_;
    Column<std::uint16_t> orders_;
    Column<Rgb> rgb_;
    // Of the lines, whose points follow each other.
    Column<std::uint32_t> plants_;
    Column<std::int32_t> ends_;
    Column<std::uint16_t> textures_;
};

}  // namespace espalier::studio
