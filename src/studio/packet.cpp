#include "studio/packet.h"

#include "espalier/geometry/surface.h"

#include "geometry/polygon_texture.h"
#include "geometry/polygon_triangles.h"
#include "studio/message_bytes.h"
#include "timeline/meshes/organ_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace espalier::studio {
namespace {

constexpr std::uint32_t disc = 0, sphere = 1, outline = 2, first_surface = 3;
constexpr std::size_t most_label = 200;  ///< bytes

using Rgba = std::array<std::uint8_t, 4>;
using Normal = std::array<std::int8_t, 4>;
using Point = std::array<float, 3>;
using OnPicture = std::array<float, 2>;

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

Point point_of(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Normal normal_of(const glm::dvec3& v) {
    const auto part = [](double x) { return static_cast<std::int8_t>(std::lround(127 * std::clamp(x, -1.0, 1.0))); };
    return {part(v.x), part(v.y), part(v.z), 0};
}

/// The box and the largest radius of all internodes, which their bytes are parts of.
struct Extent {
    Box box;
    double radius = 0;

    explicit Extent(const timeline::Frame& frame) {
        for (const timeline::PlantFrame& plant : frame.plants) {
            for (const Internode& internode : plant.interpretation->geometry.internodes) {
                box.add(internode.base);
                box.add(internode.tip);
                radius = std::max({radius, internode.base_radius, internode.tip_radius});
            }
        }
        if (box.empty()) box.lower = box.upper = glm::dvec3(0);
    }

    std::array<std::uint16_t, 3> parts(const glm::dvec3& point) const {
        std::array<std::uint16_t, 3> result;
        for (int k = 0; k < 3; ++k) {
            const double size = box.upper[k] - box.lower[k];
            result[static_cast<std::size_t>(k)] = part(size > 0 ? (point[k] - box.lower[k]) / size : 0);
        }
        return result;
    }
    std::uint16_t part_of_radius(double value) const { return part(radius > 0 ? value / radius : 0); }

private:
    static std::uint16_t part(double share) {
        return static_cast<std::uint16_t>(65535 * std::clamp(share, 0.0, 1.0) + 0.5);
    }
};

struct InternodeBytes {
    std::array<std::uint16_t, 3> base, tip;
    std::uint16_t base_radius, tip_radius;
    std::array<std::uint8_t, 3> rgb;
    std::uint8_t order;
    std::uint32_t module;
};
static_assert(sizeof(InternodeBytes) == 24);

struct Triangles {
    std::vector<Point> points;
    std::vector<Normal> normals;
    std::vector<Rgba> colours;
    std::vector<OnPicture> uvs;
    std::vector<std::uint32_t> modules, indices;
    std::vector<std::uint32_t> textures;  ///< of the triangles

    std::uint32_t add(const SurfaceVertex& vertex, Rgba colour, std::uint32_t module) {
        points.push_back(point_of(vertex.position));
        normals.push_back(normal_of(vertex.normal));
        colours.push_back(colour);
        uvs.push_back({static_cast<float>(vertex.uv.x), static_cast<float>(vertex.uv.y)});
        modules.push_back(module);
        return static_cast<std::uint32_t>(points.size() - 1);
    }
    /// What was added since wears this texture.
    void wear(std::uint32_t texture) { textures.resize(indices.size() / 3, texture); }

    /// Puts triangles that wear the same texture behind each other.
    void sort() {
        if (std::is_sorted(textures.begin(), textures.end())) return;
        std::vector<std::uint32_t> order(textures.size()), sorted;
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return textures[a] < textures[b]; });
        for (const std::uint32_t triangle : order) {
            for (std::size_t k = 0; k < 3; ++k) sorted.push_back(indices[3 * std::size_t{triangle} + k]);
        }
        indices = std::move(sorted);
        std::sort(textures.begin(), textures.end());
    }
};

struct ShownLabel {
    Point position;
    Rgba colour;
    std::uint32_t module;
    const std::string* text;
};

/// Organs of one shape.
struct Group {
    std::vector<std::array<float, 12>> places;
    std::vector<Rgba> colours;
    std::vector<std::uint32_t> modules;
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

/// Newell's normal: right for polygons that are not quite flat.
glm::dvec3 normal_of_polygon(std::span<const glm::dvec3> corners) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        sum += glm::cross(a - corners.front(), b - corners.front());
    }
    const double length = glm::length(sum);
    return length > 0 ? sum / length : glm::dvec3(0, 1, 0);
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
class PacketWriter::Scribe {
public:
    Scribe(PacketWriter& writer, const timeline::Frame& frame) : writer_(writer), frame_(frame), extent_(frame) {}

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
        triangles_.sort();
        return {shapes_message(), packet(firsts), internodes_.size()};
    }

private:
    void add_internodes(const PlantGeometry& geometry, std::uint32_t first, Colours& colours) {
        internodes_.reserve(internodes_.size() + geometry.internodes.size());
        for (const Internode& internode : geometry.internodes) {
            const Rgba colour = colours.of(internode.colour, true);
            internodes_.push_back({extent_.parts(internode.base),
                                   extent_.parts(internode.tip),
                                   extent_.part_of_radius(internode.base_radius),
                                   extent_.part_of_radius(internode.tip_radius),
                                   {colour[0], colour[1], colour[2]},
                                   static_cast<std::uint8_t>(std::min<int>(internode.order, 255)),
                                   first + internode.module});
        }
        if (geometry.textures.empty()) return;
        limb_textures_.resize(internodes_.size() - geometry.internodes.size());
        for (const std::uint16_t texture : geometry.textures) {
            limb_textures_.push_back(static_cast<std::uint16_t>(picture(geometry, texture)));
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
        const auto origin = static_cast<std::uint32_t>(triangles_.points.size());
        std::vector<glm::dvec2> uvs(corners.size());
        if (texture > 0) uvs = geometry::texture_coordinates(corners, normal);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            triangles_.add({corners[i], normal, uvs[i]}, colour, module);
        }
        for (const std::uint32_t corner : cut) triangles_.indices.push_back(origin + corner);
        triangles_.wear(texture);
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
                if (place == unused) place = triangles_.add(mesh.vertices[index], colour, first + piece.module);
                triangles_.indices.push_back(place);
            }
            triangles_.wear(picture(geometry, piece.look.texture));
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
            Group& group = groups_[*shape];
            // Round organs lie across `up`; surfaces have x along left, y along heading, z along up.
            const glm::dvec3 size = is_surface ? organ.size : glm::dvec3(organ.size.x);
            group.places.push_back(matrix(size.x * pose.left, size.y * pose.heading, size.z * pose.up, pose.position));
            group.colours.push_back(colour);
            group.modules.push_back(first + organ.module);
        }
    }

    void add_labels(const PlantGeometry& geometry, std::uint32_t first, Colours& colours) {
        for (const Label& label : geometry.labels) {
            labels_.push_back(
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
            new_shapes_.push_back({known.number, writer_.texture_of(*shapes, texture), organ.surface, shapes, as_whole});
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

    std::string packet(const std::vector<std::uint32_t>& firsts) const {
        const auto count = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
        MessageBytes out("ESP1");
        out.reserve(128 + 24 * internodes_.size() + 28 * triangles_.points.size() + 4 * triangles_.indices.size());
        out.put(writer_.growth_, static_cast<std::int32_t>(frame_.step), count(frame_.plants), count(internodes_),
                count(triangles_.points), count(triangles_.indices), count(groups_), point_of(extent_.box.lower),
                point_of(extent_.box.upper), static_cast<float>(extent_.radius));
        out.put_all(std::span(firsts).first(frame_.plants.size()));
        out.put_all(std::span<const InternodeBytes>(internodes_));
        out.put_all(std::span<const Point>(triangles_.points));
        out.put_all(std::span<const Normal>(triangles_.normals));
        out.put_all(std::span<const Rgba>(triangles_.colours));
        out.put_all(std::span<const std::uint32_t>(triangles_.modules));
        out.put_all(std::span<const std::uint32_t>(triangles_.indices));
        for (const auto& [shape, group] : groups_) {
            out.put(shape, count(group.places));
            out.put_all(std::span<const std::array<float, 12>>(group.places));
            out.put_all(std::span<const Rgba>(group.colours));
            out.put_all(std::span<const std::uint32_t>(group.modules));
        }
        put_textures(out);
        put_labels(out);
        return out.take();
    }

    void put_textures(MessageBytes& out) const {
        struct Range {
            std::uint32_t texture, first, count;  ///< indices
        };
        std::vector<Range> ranges;
        for (std::uint32_t i = 0; i < triangles_.textures.size(); ++i) {
            const std::uint32_t texture = triangles_.textures[i];
            if (texture == 0) continue;
            if (ranges.empty() || ranges.back().texture != texture) ranges.push_back({texture, 3 * i, 0});
            ranges.back().count += 3;
        }
        const bool has_limbs = std::any_of(limb_textures_.begin(), limb_textures_.end(), [](auto t) { return t > 0; });
        std::vector<std::uint16_t> of_limbs;
        if (has_limbs) {
            of_limbs = limb_textures_;
            of_limbs.resize((internodes_.size() + 1) / 2 * 2);  // a multiple of 4 bytes
        }
        out.put(static_cast<std::uint32_t>(ranges.size()), static_cast<std::uint32_t>(labels_.size()),
                static_cast<std::uint32_t>(has_limbs));
        out.put_all(std::span<const Range>(ranges));
        if (!ranges.empty()) out.put_all(std::span<const OnPicture>(triangles_.uvs));
        out.put_all(std::span<const std::uint16_t>(of_limbs));
    }

    void put_labels(MessageBytes& out) const {
        for (const ShownLabel& label : labels_) {
            out.put(label.position, label.colour, label.module);
            out.put_text(label.text->substr(0, most_label));
        }
    }

    PacketWriter& writer_;
    const timeline::Frame& frame_;
    const Extent extent_;
    std::vector<InternodeBytes> internodes_;
    std::vector<std::uint16_t> limb_textures_;  ///< of the internodes; shorter where the last ones have none
    Triangles triangles_;
    std::vector<ShownLabel> labels_;
    std::map<std::uint32_t, Group> groups_;
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
    return Scribe(*this, frame).write();
}

}  // namespace espalier::studio
