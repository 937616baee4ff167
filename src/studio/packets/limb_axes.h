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

/// What a step keeps of its axes until a page asks for limbs: the internodes as they were drawn. Finding the lines
/// waits until then, too.
class KeptAxes {
public:
    struct Internode {
        glm::vec3 base, tip;
        float base_radius, tip_radius;
        std::uint32_t module;  ///< counted through the plants
        std::uint32_t axis;
        std::uint16_t order, texture;  ///< texture as pages count them
        std::array<std::uint8_t, 3> rgb;
        bool goes_on;  ///< begins where the one before it on its axis has ended
    };

    KeptAxes() = default;
    explicit KeptAxes(std::string_view bytes);

    /// To be filled in the order of drawing.
    void reserve(std::size_t internodes) { internodes_.reserve(internodes); }
    void add(const Internode& internode) { internodes_.push_back(internode); }
    /// What was added since the plant before is a plant's.
    void end_plant() { ends_.push_back(static_cast<std::uint32_t>(internodes_.size())); }

    std::string bytes() const;
    std::size_t size() const { return internodes_.size() * sizeof(Internode) + ends_.size() * sizeof(ends_[0]); }
    LimbAxes axes(const std::vector<BrowserTexture>& textures) const;

private:
    Column<Internode> internodes_;
    std::vector<std::uint32_t> ends_;  ///< of the plants
};

}  // namespace espalier::studio
