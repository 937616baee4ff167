// glTF 2.0 (.glb): one frame as smooth tubes and surfaces, or several as growth, each internode and organ moving.
#include "espalier/base/file.h"
#include "espalier/formats/exporter.h"

#include "formats/glb.h"
#include "formats/growth_nodes.h"

#include <algorithm>
#include <map>

namespace espalier::formats {
namespace {

constexpr float steps_per_second = 24;

// glTF's vertical is y.
MeshOptions standing(MeshOptions options) {
    options.up = 'y';
    return options;
}

/// Every plant a node with a mesh.
ExportedFile write_frame(const ExportJob& job, const RecordedFrame& frame) {
    const FrameMesh mesh = mesh_of(job.run.geometry(frame), standing(job.options));
    Glb glb(job.run.folder());
    std::vector<std::size_t> roots;
    for (const auto& [plant, own] : by_plant(mesh)) {
        const std::size_t shape =
            glb.add_mesh(own.points, own.normals, own.uvs, own.triangles, own.material_of, mesh.materials);
        roots.push_back(glb.add_node({{"name", job.run.plants()[plant].name}, {"mesh", shape}}));
    }
    const auto path = job.path(frame, "glb");
    write_text(path, glb.bytes(roots));
    return {path, mesh.points.size(), mesh.triangles.size(), 0, ""};
}

/// One property of a node through time.
class Channel {
public:
    Channel(Glb& glb, std::size_t node, const char* path) : glb_(glb), node_(node), path_(path) {}

    // Of a run of equal values the first and the last stay.
    void add(float time, const glm::vec4& value) {
        const std::size_t count = values_.size();
        if (count >= 2 && values_[count - 1] == value && values_[count - 2] == value) {
            times_.back() = time;
            return;
        }
        times_.push_back(time);
        values_.push_back(value);
    }

    void finish() const {
        const bool moves = std::any_of(values_.begin(), values_.end(), [&](const auto& v) { return v != values_[0]; });
        if (moves) glb_.animate(node_, path_, times_, values_);
    }

private:
    Glb& glb_;
    std::size_t node_;
    const char* path_;
    std::vector<float> times_;
    std::vector<glm::vec4> values_;
};

glm::vec4 quaternion(const glm::quat& q) {
    return {q.x, q.y, q.z, q.w};
}

class Growth {
public:
    explicit Growth(const ExportJob& job) : job_(job), nodes_(standing(job.options)), glb_(job.run.folder()) {}

    ExportedFile write() {
        for (const RecordedFrame* frame : job_.frames) {
            nodes_.add(job_.run.geometry(*frame));
            times_.push_back(static_cast<float>(frame->step - job_.frames.front()->step) / steps_per_second);
        }
        std::size_t number = 0;
        for (const GrowthNode& node : nodes_.all()) {
            if (!node.poses.empty()) add(node, number++);
        }
        std::vector<std::size_t> roots;
        for (auto& [plant, children] : children_) {
            roots.push_back(
                glb_.add_node({{"name", job_.run.plants()[plant].name}, {"children", std::move(children)}}));
        }
        const auto path = job_.path("glb");
        write_text(path, glb_.bytes(roots));
        return {path, vertices_, triangles_, number, "moving internodes and organs"};
    }

private:
    std::size_t shape_number(const NodeShape& shape) {
        vertices_ += shape.points.size();
        triangles_ += shape.triangles.size();
        NodeShape rounded = shape;
        rounded.round();
        const auto known = shapes_.find(rounded);
        if (known != shapes_.end()) return known->second;
        std::vector<MeshMaterial> materials;
        std::vector<std::uint32_t> material_of;
        for (const Rgb& rgb : shape.rgb) {
            const MeshMaterial look{rgb, shape.texture};
            const auto at = std::find(materials.begin(), materials.end(), look);
            material_of.push_back(static_cast<std::uint32_t>(at - materials.begin()));
            if (at == materials.end()) materials.push_back(look);
        }
        const std::size_t mesh =
            glb_.add_mesh(shape.points, shape.normals, shape.uvs, shape.triangles, material_of, materials);
        shapes_.emplace(std::move(rounded), mesh);
        return mesh;
    }

    void add(const GrowthNode& thing, std::size_t number) {
        const NodePose& last = thing.poses.back().second;
        const bool dies = thing.poses.back().first + 1 < times_.size();
        const glm::vec3 scale = dies ? glm::vec3(0) : last.scale;
        const glm::vec4 turn = quaternion(last.rotation);
        const std::size_t node =
            glb_.add_node({{"name", part_name(job_.run, thing.part, number)},
                           {"mesh", shape_number(shape_of(thing, job_.options.sides))},
                           {"translation", {last.translation.x, last.translation.y, last.translation.z}},
                           {"rotation", {turn.x, turn.y, turn.z, turn.w}},
                           {"scale", {scale.x, scale.y, scale.z}},
                           {"extras", {{"identity", std::to_string(thing.part.identity)}}}});
        children_[thing.part.plant].push_back(node);
        animate(node, thing);
    }

    // Nothing at the frame before its birth and at the first without it.
    void animate(std::size_t node, const GrowthNode& thing) {
        Channel translation(glb_, node, "translation"), rotation(glb_, node, "rotation"), scale(glb_, node, "scale");
        const std::size_t first = thing.poses.front().first, last = thing.poses.back().first;
        if (first > 0) scale.add(times_[first - 1], glm::vec4(0));
        for (const auto& [frame, pose] : thing.poses) {
            translation.add(times_[frame], glm::vec4(pose.translation, 0));
            rotation.add(times_[frame], quaternion(pose.rotation));
            scale.add(times_[frame], glm::vec4(pose.scale, 0));
        }
        if (last + 1 < times_.size()) scale.add(times_[last + 1], glm::vec4(0));
        translation.finish();
        rotation.finish();
        scale.finish();
    }

    struct ByKey {
        bool operator()(const NodeShape& a, const NodeShape& b) const { return a.key() < b.key(); }
    };

    const ExportJob& job_;
    GrowthNodes nodes_;
    std::vector<float> times_;
    Glb glb_;
    std::map<NodeShape, std::size_t, ByKey> shapes_;
    std::map<std::uint32_t, std::vector<std::size_t>> children_;  ///< of each plant
    std::size_t vertices_ = 0, triangles_ = 0;
};

class Gltf final : public Exporter {
public:
    std::string extension() const override { return "glb"; }

    void write(const ExportJob& job) const override {
        job.report(job.frames.size() == 1 ? write_frame(job, *job.frames[0]) : Growth(job).write());
    }
};

const Registered<ExporterType> entry{
    {"gltf", "glTF 2.0 (.glb), one frame or the growth as an animation: for the web, Blender, engines",
     "One frame: a node per plant, smooth tubes, materials by colour and texture (embedded). Several (--step all): one "
     "file in which every\n"
     "internode and organ is a node that appears at its birth, moves, grows and vanishes, 24 steps a second; it has\n"
     "the shape and colour it was last seen in, an internode a taper to a sixteenth. The vertical is y, as glTF says.\n"
     "Lost: parameters; in animations smooth joints, and --simplify means nothing",
     construct<Gltf>}};

}  // namespace
}  // namespace espalier::formats
