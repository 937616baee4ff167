#include "studio/packets/limb_mesh.h"

#include "espalier/base/error.h"

#include "archive/meshes/axis_lines.h"
#include "archive/meshes/skin.h"
#include "archive/meshes/surface_mesh.h"
#include "studio/packets/message_bytes.h"
#include "studio/packets/packet_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <map>
#include <span>
#include <utility>

namespace espalier::studio {
namespace {

constexpr int tube_sides = 12;
constexpr double on_screen = 1.7;  // voxels that are coarser than those of pictures: a third of the triangles
constexpr std::size_t head_bytes = 60;
constexpr std::size_t vertex_bytes = sizeof(Point) + sizeof(Normal) + sizeof(Rgba) + sizeof(std::uint32_t);
constexpr std::size_t place_bytes = sizeof(std::array<float, 12>) + sizeof(Rgba) + sizeof(std::uint32_t);

/// Numbers of a packet, one after the other.
class PacketCursor {
public:
    explicit PacketCursor(std::string_view bytes) : bytes_(bytes) {}

    template <class Number>
    Number next() {
        Number number;
        std::memcpy(&number, bytes_.data() + at_, sizeof number);
        at_ += sizeof number;
        return number;
    }
    template <class Number, std::size_t N>
    std::array<Number, N> several() {
        return next<std::array<Number, N>>();
    }
    void skip(std::size_t bytes) { at_ += bytes; }
    void go_to(std::size_t at) { at_ = at; }

private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

struct Head {
    std::uint32_t growth;
    std::int32_t step;
    std::uint32_t plants, internodes, vertices, indices, groups;
    glm::vec3 lower, upper;
    float radius;
};

Head head_of(PacketCursor& in) {
    Head head{};
    in.go_to(4);
    head.growth = in.next<std::uint32_t>();
    head.step = in.next<std::int32_t>();
    for (std::uint32_t* count : {&head.plants, &head.internodes, &head.vertices, &head.indices, &head.groups}) {
        *count = in.next<std::uint32_t>();
    }
    for (glm::vec3* corner : {&head.lower, &head.upper}) {
        for (int k = 0; k < 3; ++k) (*corner)[k] = in.next<float>();
    }
    head.radius = in.next<float>();
    return head;
}

/// The textures of the internodes; none if no limb has one.
std::vector<std::uint16_t> limb_textures(PacketCursor in, const Head& head) {
    in.go_to(head_bytes + 4 * std::size_t{head.plants} + sizeof(InternodeBytes) * head.internodes +
             vertex_bytes * std::size_t{head.vertices} + 4 * std::size_t{head.indices});
    for (std::uint32_t i = 0; i < head.groups; ++i) {
        in.skip(4);
        in.skip(place_bytes * in.next<std::uint32_t>());
    }
    const auto [ranges, labels, has_limbs] = in.several<std::uint32_t, 3>();
    if (has_limbs == 0) return {};
    in.skip(12 * std::size_t{ranges} + (ranges > 0 ? 8 * std::size_t{head.vertices} : 0));
    std::vector<std::uint16_t> textures(head.internodes);
    for (std::uint16_t& texture : textures) texture = in.next<std::uint16_t>();
    return textures;
}

/// The internodes of a packet as a frame of axes. An axis goes on where the last internode of its order ended, unless
/// one of a lower order stands between.
class Axes {
public:
    Axes(std::string_view packet, const std::vector<BrowserTexture>& textures) : in_(packet), head_(head_of(in_)) {
        geometry_.texture_files.emplace_back();
        for (const BrowserTexture& texture : textures) geometry_.texture_files.push_back(texture.file.string());
        const std::vector<std::uint16_t> textures_of_limbs = limb_textures(in_, head_);
        std::vector<std::uint32_t> firsts;
        for (std::uint32_t i = 0; i < head_.plants; ++i) firsts.push_back(in_.next<std::uint32_t>());
        for (std::uint32_t i = 0; i < head_.internodes; ++i)
            read(firsts, textures_of_limbs.empty() ? std::uint16_t{0} : textures_of_limbs[i]);
        close();
    }

    const Head& head() const { return head_; }
    const RecordedGeometry& geometry() const { return geometry_; }
    std::uint32_t module(std::size_t point) const { return modules_[point]; }

private:
    struct Line {
        std::vector<std::int32_t> points;
        std::uint16_t order, texture;
    };

    void read(const std::vector<std::uint32_t>& firsts, std::uint16_t texture) {
        const auto internode = in_.next<InternodeBytes>();
        const auto behind = std::upper_bound(firsts.begin(), firsts.end(), internode.module);
        const auto plant = static_cast<std::uint32_t>(behind - firsts.begin() - 1);
        if (plant != plant_) open_.fill(none);
        plant_ = plant;
        const std::uint16_t order = internode.order;
        std::fill(open_.begin() + order + 1, open_.end(), none);
        if (open_[order] == none || ends_[order] != internode.base) {
            open_[order] = lines_.size();
            lines_.push_back({{}, order, texture});
            add_point(internode, internode.base, internode.base_radius);
        }
        add_point(internode, internode.tip, internode.tip_radius);
        ends_[order] = internode.tip;
    }

    // One end of an internode.
    void add_point(const InternodeBytes& internode, const std::array<std::uint16_t, 3>& parts, std::uint16_t radius) {
        glm::vec3 point;
        for (int k = 0; k < 3; ++k) {
            const float share = static_cast<float>(parts[static_cast<std::size_t>(k)]) / 65535;
            point[k] = head_.lower[k] + (head_.upper[k] - head_.lower[k]) * share;
        }
        lines_[open_[internode.order]].points.push_back(static_cast<std::int32_t>(geometry_.points.size()));
        geometry_.points.push_back(point);
        geometry_.radii.push_back(head_.radius * static_cast<float>(radius) / 65535);
        add_attributes(geometry_.of_points, internode.rgb, internode.order);
        modules_.push_back(internode.module);
    }

    void add_attributes(RecordedAttributes& of, const archive::Rgb& rgb, std::uint16_t order) const {
        of.identities.push_back(0);
        of.parents.push_back(0);
        of.plants.push_back(plant_);
        of.symbols.push_back(0);
        of.births.push_back(0);
        of.orders.push_back(order);
        of.colours.push_back(0);
        of.kinds.push_back(Kind::axis);
        of.rgb.push_back(rgb);
    }

    void close() {
        for (const Line& line : lines_) {
            const auto first = static_cast<std::size_t>(line.points.front());
            plant_ = geometry_.of_points.plants[first];
            add_attributes(geometry_.of_cells, geometry_.of_points.rgb[first], line.order);
            geometry_.textures.push_back(line.texture);
            geometry_.lines.connectivity.insert(geometry_.lines.connectivity.end(), line.points.begin(),
                                                line.points.end());
            geometry_.lines.offsets.push_back(static_cast<std::int32_t>(geometry_.lines.connectivity.size()));
        }
    }

    static constexpr std::size_t none = std::size_t(-1);

    PacketCursor in_;
    const Head head_;
    RecordedGeometry geometry_;
    std::vector<std::uint32_t> modules_;  ///< modules of the points
    std::vector<Line> lines_;
    std::array<std::size_t, 256> open_{};  ///< the line of each order
    std::array<std::array<std::uint16_t, 3>, 256> ends_{};
    std::uint32_t plant_ = 0xFFFFFFFF;
};

/// Tubes of one texture after those of another.
class LimbMessage {
public:
    explicit LimbMessage(const Axes& axes) : axes_(axes) {}

    void add(const AxisLine& axis, const Tube& tube) {
        const auto origin = static_cast<std::uint32_t>(positions_.size());
        const RecordedGeometry& geometry = axes_.geometry();
        for (const TubeVertex& vertex : tube.vertices) {
            const auto row = static_cast<std::size_t>(axis.line.nodes[vertex.node].row);
            const auto [red, green, blue] = geometry.of_points.rgb[row];
            positions_.push_back(vertex.position);
            std::array<std::int8_t, 4> normal{};
            for (int k = 0; k < 3; ++k) {
                normal[static_cast<std::size_t>(k)] = static_cast<std::int8_t>(std::lround(127 * vertex.normal[k]));
            }
            normals_.push_back(normal);
            colours_.push_back({red, green, blue, 255});
            modules_.push_back(axes_.module(row));
            uvs_.push_back(vertex.uv);
        }
        std::vector<std::uint32_t>& indices = indices_[geometry.textures[axis.row]];
        for (const TubeTriangle& triangle : tube.triangles) {
            for (const std::uint32_t corner : triangle.corners) indices.push_back(origin + corner);
        }
    }

    std::string take(bool smooth) const {
        MessageBytes out("ESM1");
        std::size_t count = 0;
        for (const auto& [texture, indices] : indices_) count += indices.size();
        out.reserve(64 + 32 * positions_.size() + 4 * count);
        out.put(axes_.head().growth, axes_.head().step, static_cast<std::uint32_t>(smooth), size(positions_),
                static_cast<std::uint32_t>(count), size(indices_));
        std::uint32_t first = 0;
        for (const auto& [texture, indices] : indices_) {
            out.put(texture, first, size(indices));
            first += size(indices);
        }
        out.put_all(std::span<const glm::vec3>(positions_));
        out.put_all(std::span<const std::array<std::int8_t, 4>>(normals_));
        out.put_all(std::span<const std::array<std::uint8_t, 4>>(colours_));
        out.put_all(std::span<const std::uint32_t>(modules_));
        out.put_all(std::span<const glm::vec2>(uvs_));
        for (const auto& [texture, indices] : indices_) out.put_all(std::span<const std::uint32_t>(indices));
        return out.take();
    }

private:
    template <class List>
    static std::uint32_t size(const List& list) {
        return static_cast<std::uint32_t>(list.size());
    }

    const Axes& axes_;
    std::vector<glm::vec3> positions_;
    std::vector<std::array<std::int8_t, 4>> normals_;
    std::vector<std::array<std::uint8_t, 4>> colours_;
    std::vector<std::uint32_t> modules_;
    std::vector<glm::vec2> uvs_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> indices_;  ///< by texture
};

std::vector<Tube> tubes_of_plant(std::span<const AxisLine> lines, const AxisSkin& skin) {
    if (skin.smooth) return skin_of(lines, std::vector<int>(lines.size(), tube_sides), skin);
    std::vector<Tube> tubes;
    for (const AxisLine& axis : lines) tubes.push_back(sweep(axis.line, tube_sides));
    return tubes;
}

}  // namespace

std::string limb_mesh(std::string_view packet, const std::vector<BrowserTexture>& textures, bool smooth,
                      const ContinueCallback& may_continue) {
    const Axes axes(packet, textures);
    const RecordedGeometry& geometry = axes.geometry();
    const std::vector<AxisLine> lines =
        axis_lines(geometry, axis_paths(geometry, {}), 0, archive::thinnest_radius(geometry),
                   smooth ? archive::Forks::none : archive::Forks::rings);
    AxisSkin skin;
    skin.smooth = smooth;
    if (smooth) skin.voxel = on_screen * archive::skin_voxel(lines, skin);
    LimbMessage message(axes);
    // Plant after plant, so that one may stop between them.
    for (std::size_t first = 0, end = 0; first < lines.size(); first = end) {
        while (end < lines.size() && lines[end].plant == lines[first].plant) ++end;
        if (!may_continue(static_cast<double>(first) / static_cast<double>(lines.size()))) return "";
        const auto plant = std::span(lines).subspan(first, end - first);
        const std::vector<Tube> tubes = tubes_of_plant(plant, skin);
        for (std::size_t i = 0; i < plant.size(); ++i) message.add(plant[i], tubes[i]);
    }
    return message.take(smooth);
}

LimbRun::LimbRun(LimbOrder order, std::function<void(double)> progressed, Done done)
    : order_(std::move(order)),
      progressed_(std::move(progressed)),
      done_(std::move(done)),
      thread_([this] { work(); }) {}

LimbRun::~LimbRun() {
    cancelled_ = true;
    thread_.join();
}

void LimbRun::work() {
    try {
        const auto may_continue = [this](double share) {
            if (!cancelled_) progressed_(share);
            return !cancelled_;
        };
        std::string bytes = limb_mesh(order_.packet, order_.textures, order_.smooth, may_continue);
        if (!cancelled_) done_(std::move(bytes), "");
    } catch (const std::exception& error) {
        if (!cancelled_) done_("", error.what());
    }
    ended_ = true;
}

}  // namespace espalier::studio
