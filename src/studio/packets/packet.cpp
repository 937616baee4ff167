#include "studio/packets/packet.h"

#include "espalier/geometry/surface.h"

#include "geometry/polygon_texture.h"
#include "geometry/polygon_triangles.h"
#include "geometry/vectors.h"
#include "studio/packets/message_bytes.h"
#include "studio/packets/packet_parts.h"
#include "timeline/meshes/organ_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::studio {
namespace {

constexpr std::uint32_t disc = 0, sphere = 1, outline = 2, first_surface = 3;

/// The colours of a plant's indices, each worked out once.
class Colours {
public:
    explicit Colours(const Palette* palette) : palette_(palette) {}

    Rgba of(std::uint16_t index, bool is_wood) {
        if (!palette_) return is_wood ? Rgba{117, 84, 55, 255} : Rgba{82, 143, 61, 255};
        const auto [place, is_new] = known_.try_emplace(index);
        if (is_new) {
            const Material material = palette_->material(index);
            const auto [red, green, blue] = shown_colour(material);
            const double opacity = std::clamp(material.diffuse.a, 0.0, 1.0);
            place->second = {red, green, blue, static_cast<std::uint8_t>(std::lround(255 * opacity))};
        }
        return place->second;
    }

private:
    const Palette* palette_;
    std::map<std::uint16_t, Rgba> known_;
};

Extent extent_of(const timeline::Frame& frame) {
    Extent extent;
    for (const timeline::PlantFrame& plant : frame.plants) {
        for (const Internode& internode : plant.interpretation->geometry.internodes) {
            extent.add(internode.base, internode.tip, internode.base_radius, internode.tip_radius);
        }
    }
    return extent;
}

std::array<float, 12> matrix(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z, const glm::dvec3& at) {
    std::array<float, 12> rows;
    for (int row = 0; row < 3; ++row) {
        const std::array<double, 4> values{x[row], y[row], z[row], at[row]};
        std::transform(values.begin(), values.end(), rows.begin() + 4 * row,
                       [](double value) { return static_cast<float>(value); });
    }
    return rows;
}

/// Newell's normal: right for polygons that are not quite flat.
glm::dvec3 normal_of_polygon(std::span<const glm::dvec3> corners) {
    return unit_or(geometry::area_vector(corners.size(), [&](std::size_t i) { return corners[i]; }), {0, 1, 0});
}

}  // namespace

std::vector<std::uint32_t> first_modules(const timeline::Frame& frame) {
    std::vector<std::uint32_t> firsts{0};
    for (const timeline::PlantFrame& plant : frame.plants) {
        firsts.push_back(firsts.back() + static_cast<std::uint32_t>(plant.string->size()));
    }
    return firsts;
}

/// One packet while it is written.
class PacketWriter::PacketBuilder {
public:
    PacketBuilder(PacketWriter& writer, const timeline::Frame& frame) : writer_(writer), frame_(frame) {
        parts_.extent = extent_of(frame);
    }

    Packet write() {
        const std::vector<std::uint32_t> firsts = first_modules(frame_);
        for (std::size_t i = 0; i < frame_.plants.size(); ++i) {
            const timeline::PlantFrame& plant = frame_.plants[i];
            Colours colours(plant.palette);
            add_internodes(plant.interpretation->geometry, firsts[i], colours);
            add_polygons(plant.interpretation->geometry, firsts[i], colours);
            add_mesh(plant.interpretation->geometry, firsts[i], colours);
            add_organs(plant.interpretation->geometry, firsts[i], colours);
            add_labels(plant.interpretation->geometry, firsts[i], colours);
        }
        parts_.first_modules.assign(firsts.begin(), firsts.end() - 1);
        parts_.triangles.sort();
        return {shapes_message(), parts_.bytes(writer_.growth_, frame_.step), parts_.internodes.size()};
    }

private:
    void add_internodes(const PlantGeometry& geometry, std::uint32_t first, Colours& colours) {
        parts_.internodes.reserve(parts_.internodes.size() + geometry.internodes.size());
        for (const Internode& internode : geometry.internodes) {
            const Rgba colour = colours.of(internode.colour, true);
            parts_.internodes.push_back({parts_.extent.parts(internode.base),
                                         parts_.extent.parts(internode.tip),
                                         parts_.extent.part_of_radius(internode.base_radius),
                                         parts_.extent.part_of_radius(internode.tip_radius),
                                         {colour[0], colour[1], colour[2]},
                                         static_cast<std::uint8_t>(std::min<int>(internode.order, 255)),
                                         first + internode.module});
        }
        if (geometry.textures.empty()) return;
        parts_.limb_textures.resize(parts_.internodes.size() - geometry.internodes.size());
        for (const std::uint16_t texture : geometry.textures) {
            parts_.limb_textures.push_back(static_cast<std::uint16_t>(picture(geometry, texture)));
        }
    }

    // As pages count pictures; 0 for none.
    std::uint32_t picture(const PlantGeometry& geometry, std::uint32_t texture) {
        return geometry.shapes ? writer_.texture_of(*geometry.shapes, texture) : 0;
    }

    void add_polygon(std::span<const glm::dvec3> corners, Rgba colour, std::uint32_t module, std::uint32_t texture) {
        if (corners.size() < 3) return;
        const glm::dvec3 normal = normal_of_polygon(corners);
        std::vector<std::uint32_t> cut = geometry::triangles_of(corners, normal);
        for (std::uint32_t i = 2; cut.size() < 3 * (corners.size() - 2) && i < corners.size(); ++i) {
            cut.insert(cut.end(), {0, i - 1, i});
        }
        const auto origin = static_cast<std::uint32_t>(parts_.triangles.points.size());
        std::vector<glm::dvec2> uvs(corners.size());
        if (texture > 0) uvs = geometry::texture_coordinates(corners, normal);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            parts_.triangles.add({corners[i], normal, uvs[i]}, colour, module);
        }
        for (const std::uint32_t corner : cut) parts_.triangles.indices.push_back(origin + corner);
        parts_.triangles.set_texture(texture);
    }

    void add_polygons(const PlantGeometry& geometry, std::uint32_t first, Colours& colours) {
        for (const Polygon& polygon : geometry.polygons) {
            add_polygon(std::span(geometry.vertices).subspan(polygon.first, polygon.count),
                        colours.of(polygon.colour, false), first + polygon.module,
                        picture(geometry, polygon.look.texture));
        }
    }

    // Pieces of a cylinder share rings: a vertex is the first piece's that uses it.
    void add_mesh(const PlantGeometry& geometry, std::uint32_t first, Colours& colours) {
        const DrawnMesh& mesh = geometry.mesh;
        constexpr std::uint32_t unused = 0xFFFFFFFF;
        std::vector<std::uint32_t> written(mesh.vertices.size(), unused);
        for (const MeshPiece& piece : mesh.pieces) {
            const Rgba colour = colours.of(piece.colour, piece.kind == MeshPiece::Kind::cylinder);
            for (const std::uint32_t index : std::span(mesh.triangles).subspan(piece.first, piece.count)) {
                std::uint32_t& place = written[index];
                if (place == unused) place = parts_.triangles.add(mesh.vertices[index], colour, first + piece.module);
                parts_.triangles.indices.push_back(place);
            }
            parts_.triangles.set_texture(picture(geometry, piece.look.texture));
        }
    }

    void add_organs(const PlantGeometry& geometry, std::uint32_t first, Colours& colours) {
        for (const Organ& organ : geometry.organs) {
            const Rgba colour = colours.of(organ.colour, false);
            const bool is_surface = organ.shape == Organ::Shape::surface;
            const std::optional<std::uint32_t> shape = shape_of(organ, geometry.shapes);
            if (!shape) {
                add_polygon(timeline::rhombus_of(organ), colour, first + organ.module, 0);
                continue;
            }
            const Pose& pose = organ.pose;
            Group& group = parts_.groups[*shape];
            // Round organs lie across `up`; surfaces have x along left, y along heading, z along up.
            const glm::dvec3 size = is_surface ? organ.size : glm::dvec3(organ.size.x);
            group.places.push_back(matrix(size.x * pose.left, size.y * pose.heading, size.z * pose.up, pose.position));
            group.colours.push_back(colour);
            group.modules.push_back(first + organ.module);
        }
    }

    void add_labels(const PlantGeometry& geometry, std::uint32_t first, Colours& colours) {
        for (const Label& label : geometry.labels) {
            parts_.labels.push_back(
                {point_of(label.position), colours.of(label.colour, false), first + label.module, &label.text});
        }
    }

    // None for a surface that no view file describes.
    std::optional<std::uint32_t> shape_of(const Organ& organ, const std::shared_ptr<const Shapes>& shapes) {
        switch (organ.shape) {
            case Organ::Shape::disc:
                return disc;
            case Organ::Shape::sphere:
                return sphere;
            case Organ::Shape::circle:
                return outline;
            case Organ::Shape::surface:
                break;
        }
        if (!shapes || !shapes->surfaces.contains(organ.surface)) return std::nullopt;
        const Surface& surface = shapes->surfaces.at(organ.surface);
        const auto texture = static_cast<std::uint32_t>(surface.texture.value_or(organ.look.texture));
        KnownShape& known = writer_.shape(shapes, organ.surface, texture);
        if (!std::exchange(known.is_told, true)) {
            const bool as_whole =
                texture > 0 && texture <= shapes->textures.size() && shapes->textures[texture - 1].per_surface;
            new_shapes_.push_back(
                {known.number, writer_.texture_of(*shapes, texture), organ.surface, shapes, as_whole});
        }
        return known.number;
    }

    std::string shapes_message() const {
        if (new_shapes_.empty()) return "";
        MessageBytes out("ESS1");
        out.put(writer_.growth_, static_cast<std::uint32_t>(new_shapes_.size()));
        for (const NewShape& shape : new_shapes_) put_shape(shape, out);
        return out.take();
    }

    struct NewShape {
        std::uint32_t number, texture, surface;
        std::shared_ptr<const Shapes> shapes;
        bool as_whole;  ///< one picture over the whole surface
    };

    static void put_shape(const NewShape& shape, MessageBytes& out) {
        timeline::SurfaceMeshes meshes(shape.shapes);
        const timeline::SurfaceMeshes::Entry& entry = *meshes.find(shape.surface);
        const SurfaceMesh& mesh = entry.mesh;
        std::vector<std::uint32_t> triangles;
        std::uint32_t at = 0;
        for (const std::uint32_t corners : mesh.faces) {
            for (std::uint32_t i = 2; i < corners; ++i) {
                triangles.insert(triangles.end(), {mesh.indices[at], mesh.indices[at + i - 1], mesh.indices[at + i]});
            }
            at += corners;
        }
        out.put(shape.number, shape.texture, static_cast<std::uint32_t>(mesh.vertices.size()),
                static_cast<std::uint32_t>(triangles.size()));
        for (const SurfaceVertex& vertex : mesh.vertices) out.put(point_of(vertex.position));
        for (const SurfaceVertex& vertex : mesh.vertices) out.put(point_of(vertex.normal));
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
            const glm::dvec2& uv = shape.as_whole ? entry.whole[i] : mesh.vertices[i].uv;
            out.put(static_cast<float>(uv.x), static_cast<float>(uv.y));
        }
        out.put_all(std::span<const std::uint32_t>(triangles));
    }

    PacketWriter& writer_;
    const timeline::Frame& frame_;
    PacketParts parts_;
    std::vector<NewShape> new_shapes_;
};

std::uint32_t PacketWriter::texture_of(const Shapes& shapes, std::uint32_t texture) {
    if (texture == 0 || texture > shapes.textures.size()) return 0;
    return pictures_.number(shapes.textures[texture - 1].file);
}

PacketWriter::KnownShape& PacketWriter::shape(const std::shared_ptr<const Shapes>& shapes, std::uint32_t surface,
                                              std::uint32_t texture) {
    const auto [place, is_new] = shapes_.try_emplace({shapes.get(), surface, texture});
    if (is_new) {
        place->second.number = first_surface + static_cast<std::uint32_t>(shapes_.size()) - 1;
        kept_.insert(shapes);
    }
    return place->second;
}

void PacketWriter::expect(const std::shared_ptr<const Shapes>& shapes) {
    if (!shapes) return;
    for (const auto& [number, surface] : shapes->surfaces) {
        const auto own = static_cast<std::uint32_t>(surface.texture.value_or(0));
        const auto last = surface.texture ? own : static_cast<std::uint32_t>(shapes->textures.size());
        for (std::uint32_t texture = own; texture <= last; ++texture) shape(shapes, number, texture);
    }
}

Packet PacketWriter::write(const timeline::Frame& frame) {
    return PacketBuilder(*this, frame).write();
}

}  // namespace espalier::studio
