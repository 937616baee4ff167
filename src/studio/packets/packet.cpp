#include "studio/packets/packet.h"

#include "espalier/geometry/surface.h"

#include "geometry/drawn/plant_mesh.h"
#include "studio/packets/message_bytes.h"
#include "studio/packets/packet_parts.h"

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

/// Where the axes of a plant have ended while its internodes are added.
class AxisEnds {
public:
    explicit AxisEnds(std::uint32_t axes) : last_(axes, nullptr) {}

    /// False if it is the first of a line. It stays where it is.
    bool go_on(const Internode& internode) {
        const Internode* const before = std::exchange(last_[internode.axis], &internode);
        return before && geometry::goes_on(*before, internode);
    }

private:
    std::vector<const Internode*> last_;  ///< of each axis; null: none
};

std::array<float, 12> matrix(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z, const glm::dvec3& at) {
    std::array<float, 12> rows;
    for (int row = 0; row < 3; ++row) {
        const std::array<double, 4> values{x[row], y[row], z[row], at[row]};
        std::transform(values.begin(), values.end(), rows.begin() + 4 * row,
                       [](double value) { return static_cast<float>(value); });
    }
    return rows;
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
        std::size_t internodes = 0;
        for (const timeline::PlantFrame& plant : frame_.plants) {
            internodes += plant.interpretation->geometry.internodes.size();
        }
        parts_.internodes.reserve(internodes);
        axes_.reserve(internodes);
        std::vector<Colours> colours;
        for (const timeline::PlantFrame& plant : frame_.plants) colours.emplace_back(plant.palette);
        mesh_.begin();
        for (std::uint32_t i = 0; i < frame_.plants.size(); ++i) {
            const PlantGeometry& geometry = frame_.plants[i].interpretation->geometry;
            add_internodes(geometry, firsts[i], colours[i]);
            add_polygons(mesh_, geometry, i);
            add_pieces(mesh_, geometry, i);
            add_organs(geometry, i, firsts[i], colours[i]);
            add_labels(geometry, firsts[i], colours[i]);
        }
        add_mesh(firsts, colours);
        parts_.first_modules.assign(firsts.begin(), firsts.end() - 1);
        parts_.triangles.sort();
        return {shapes_message(), parts_.bytes(writer_.growth_, frame_.step), std::move(axes_),
                parts_.internodes.size()};
    }

private:
    void add_internodes(const PlantGeometry& geometry, std::uint32_t first, Colours& colours) {
        const Extent extent = parts_.extent;
        AxisEnds ends(geometry.axes);
        for (std::size_t i = 0; i < geometry.internodes.size(); ++i) {
            const Internode& internode = geometry.internodes[i];
            const Rgba colour = colours.of(internode.colour, true);
            const std::array<std::uint8_t, 3> rgb{colour[0], colour[1], colour[2]};
            const std::uint32_t module = first + internode.module;
            const std::uint16_t texture = i < geometry.textures.size() ? picture(geometry, geometry.textures[i]) : 0;
            parts_.internodes.push_back({extent.parts(internode.base), extent.parts(internode.tip),
                                         extent.part_of_radius(internode.base_radius),
                                         extent.part_of_radius(internode.tip_radius), rgb,
                                         static_cast<std::uint8_t>(std::min<int>(internode.order, 255)), module});
            axes_.add({internode.base, internode.tip, static_cast<float>(internode.base_radius),
                       static_cast<float>(internode.tip_radius), module, internode.axis, internode.order, texture, rgb,
                       ends.go_on(internode)});
        }
        axes_.end_plant();
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

    // Triangles of all that stands once: polygons, cylinders, patches, and what no view file describes.
    void add_mesh(const std::vector<std::uint32_t>& firsts, std::vector<Colours>& colours) {
        mesh_.end();
        const std::span<const float> places = mesh_.points.values(), normals = mesh_.normals.values(),
                                     uvs = mesh_.uvs.values();
        const std::span<const std::uint32_t> ends = mesh_.owners.ends.values();
        std::size_t point = 0;
        for (std::size_t run = 0; run < ends.size(); ++run) {
            const geometry::Owner& owner = mesh_.owners.values[run];
            const Rgba colour = colours[owner.plant].of(owner.colour, owner.kind == Kind::cylinder);
            for (; point < ends[run]; ++point) {
                const std::size_t at = 3 * point;
                parts_.triangles.add({{places[at], places[at + 1], places[at + 2]},
                                      {normals[at], normals[at + 1], normals[at + 2]},
                                      {uvs[2 * point], uvs[2 * point + 1]}},
                                     colour, firsts[owner.plant] + owner.module);
            }
        }
        add_cells(mesh_.polygons);
    }

    void add_cells(const geometry::Cells& cells) {
        const std::span<const std::int32_t> offsets = cells.offsets.values(), corners = cells.connectivity.values();
        const std::span<const std::uint32_t> ends = cells.owners.ends.values();
        std::size_t cell = 0;
        std::int32_t first = 0;
        for (std::size_t run = 0; run < ends.size(); ++run) {
            const geometry::Owner& owner = cells.owners.values[run];
            for (; cell < ends[run]; first = offsets[cell++]) {
                for (std::int32_t k = first + 2; k < offsets[cell]; ++k) {
                    for (const std::int32_t corner : {first, k - 1, k}) {
                        const auto at = static_cast<std::size_t>(corner);
                        parts_.triangles.indices.push_back(static_cast<std::uint32_t>(corners[at]));
                    }
                }
            }
            parts_.triangles.set_texture(
                picture(frame_.plants[owner.plant].interpretation->geometry, owner.look.texture));
        }
    }

    void add_organs(const PlantGeometry& geometry, std::uint32_t plant, std::uint32_t first, Colours& colours) {
        for (const Organ& organ : geometry.organs) {
            const bool is_surface = organ.shape == Organ::Shape::surface;
            const std::optional<std::uint32_t> shape = shape_of(organ, geometry.shapes);
            if (!shape) {
                add_organ(mesh_, plain_.of(organ), {plant, organ.module, organ.order, organ.colour, Kind::organ});
                continue;
            }
            const Pose& pose = organ.pose;
            Group& group = parts_.groups[*shape];
            // Round organs lie across `up`; surfaces have x along left, y along heading, z along up.
            const glm::dvec3 size = is_surface ? organ.size : glm::dvec3(organ.size.x);
            group.places.push_back(matrix(size.x * pose.left, size.y * pose.heading, size.z * pose.up, pose.position));
            group.colours.push_back(colours.of(organ.colour, false));
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
        SurfaceMeshes meshes(shape.shapes);
        const SurfaceMeshes::Entry& entry = *meshes.find(shape.surface);
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
    KeptAxes axes_;
    geometry::PlantMesh mesh_;
    OrganMeshes plain_;
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
