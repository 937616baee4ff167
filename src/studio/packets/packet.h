// A frame as the studio's page draws it: docs/developer/studio-protocol.md, "Binary messages".
#pragma once

#include "espalier/timeline/frame.h"

#include "studio/packets/limb_axes.h"
#include "studio/packets/textures.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace espalier::studio {

/// The number of the first module of each plant, and behind the last the number of all modules: the modules of a frame
/// are counted through its plants.
std::vector<std::uint32_t> first_modules(const timeline::Frame& frame);

struct Packet {
    std::string shapes;  ///< the message with the surfaces that this packet is the first to use; may be empty
    std::string bytes;
    KeptAxes axes;
    std::size_t internodes = 0;
};

/// Writes the packets of one growth.
class PacketWriter {
public:
    /// Pictures that browsers do not show are written into `folder` as some that they do.
    PacketWriter(std::uint32_t growth, std::filesystem::path folder) : growth_(growth), pictures_(std::move(folder)) {}

    /// Surfaces that may be used, so that their numbers do not depend on which is used first; may be null.
    void expect(const std::shared_ptr<const Shapes>& shapes);
    Packet write(const timeline::Frame& frame);
    /// What the packets so far wear; texture 1 is the first.
    const std::vector<BrowserTexture>& textures() const { return pictures_.all(); }

private:
    /// Tells organs with a surface apart that need different groups.
    struct ShapeKey {
        const Shapes* shapes;
        std::uint32_t surface;
        std::uint32_t texture;
        auto operator<=>(const ShapeKey&) const = default;
    };

    struct KnownShape {
        std::uint32_t number = 0;
        bool is_told = false;  ///< a message has told the pages
    };

    class PacketBuilder;

    KnownShape& shape(const std::shared_ptr<const Shapes>& shapes, std::uint32_t surface, std::uint32_t texture);
    std::uint32_t texture_of(const Shapes& shapes, std::uint32_t texture);

    std::uint32_t growth_;
    BrowserTextures pictures_;
    std::map<ShapeKey, KnownShape> shapes_;
    std::set<std::shared_ptr<const Shapes>> kept_;  ///< so that no other has the address of one
};

}  // namespace espalier::studio
