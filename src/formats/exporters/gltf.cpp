// glTF 2.0 (.glb): one frame as smooth tubes and surfaces, or several as growth, each internode and organ moving.
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/formats/exporter.h"

#include "archive/meshes/mesh_pieces.h"
#include "formats/glb.h"
#include "formats/growth_nodes.h"
#include "formats/mesh_files.h"
#include "formats/textures.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <map>

namespace espalier::formats {
namespace {

// glTF's vertical is y.
MeshOptions standing(MeshOptions options) {
    options.up = 'y';
    return options;
}

glm::vec4 quaternion(const glm::quat& q) {
    return {q.x, q.y, q.z, q.w};
}

/// Every plant a node with a mesh, or with one for each piece.
ExportedFile write_frame(const ExportJob& job, const RecordedFrame& frame) {
    const FrameMesh mesh = mesh_of(job.geometry(frame), standing(job.options));
    Glb glb(job.run);
    std::vector<std::size_t> roots;
    std::size_t vertices = 0;
    const auto add = [&](const FrameMesh& own, const std::string& name) {
        vertices += own.points.size();
        const std::size_t shape =
            glb.add_mesh(own.points, own.normals, own.uvs, own.triangles, own.material_of, mesh.materials);
        roots.push_back(glb.add_node({{"name", name}, {"mesh", shape}}));
    };
    for (const auto& [plant, own] : by_plant(mesh)) {
        const std::string& name = job.run.plants()[plant].name;
        if (job.most_vertices == 0) {
            add(own, name);
            continue;
        }
        std::size_t piece = 0;
        for (const FrameMesh& part : pieces_of(own, {.vertices = job.most_vertices})) {
            add(part, ++piece > 1 ? fmt::format("{}_{}", name, piece) : name);
        }
    }
    const auto path = job.path(frame, "glb", {vertices, mesh.triangles.size(), 0, ""});
    write_text(path, glb.bytes(roots));
    return {path, vertices, mesh.triangles.size(),
            0,    "",       joined_hints({hint_of_triangles(job, mesh.triangles.size()), glb.hint()})};
}

/// One property of a node through time.
class Channel {
public:
    Channel(Glb& glb, std::size_t node, const char* path) : glb_(glb), node_(node), path_(path) {}

    // Keeps the first and the last of a run of equal values.
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

/// Meshes of shapes, each once.
class ShapeMeshes {
public:
    explicit ShapeMeshes(Glb& glb) : glb_(glb) {}

    std::size_t number(const NodeShape& shape) {
        NodeShape rounded = shape;
        rounded.round();
        const auto known = numbers_.find(rounded);
        if (known != numbers_.end()) return known->second;
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
        numbers_.emplace(std::move(rounded), mesh);
        return mesh;
    }

private:
    struct ByKey {
        bool operator()(const NodeShape& a, const NodeShape& b) const { return a.key() < b.key(); }
    };

    Glb& glb_;
    std::map<NodeShape, std::size_t, ByKey> numbers_;
};

/// Every plant's wood as a mesh, and each of the shapes of its organs once, in all its places.
class Instances {
public:
    Instances(const ExportJob& job, const RecordedFrame& frame)
        : job_(job), frame_(frame), glb_(job.run), meshes_(glb_) {}

    ExportedFile write() {
        const FrameGeometry geometry = job_.geometry(frame_);
        add_wood(geometry);
        add_organs(geometry);
        std::vector<std::size_t> roots;
        for (auto& [plant, children] : children_) {
            roots.push_back(
                glb_.add_node({{"name", job_.run.plants()[plant].name}, {"children", std::move(children)}}));
        }
        const auto path = job_.path(frame_, "glb", {vertices_, triangles_, 0, ""});
        write_text(path, glb_.bytes(roots));
        return {path, vertices_, triangles_, organs_, "instances", glb_.hint()};
    }

private:
    struct Places {
        std::string symbol;
        std::vector<glm::vec3> translations, scales;
        std::vector<glm::vec4> rotations;
    };

    void add_wood(const FrameGeometry& geometry) {
        const FrameMesh mesh = tubes_of(geometry, standing(job_.options));
        for (const auto& [plant, own] : by_plant(mesh)) {
            vertices_ += own.points.size();
            triangles_ += own.triangles.size();
            const std::size_t shape =
                glb_.add_mesh(own.points, own.normals, own.uvs, own.triangles, own.material_of, mesh.materials);
            children_[plant].push_back(glb_.add_node({{"name", "axes"}, {"mesh", shape}}));
        }
    }

    void add_organs(const FrameGeometry& geometry) {
        GrowthNodes nodes(standing(job_.options));
        nodes.add_organs(geometry);
        std::map<std::pair<std::uint32_t, std::size_t>, Places> places;  // by plant and mesh
        for (const GrowthNode& organ : nodes.all()) {
            if (organ.poses.empty()) continue;
            Places& here = places[{organ.part.plant, meshes_.number(organ.organ)}];
            if (here.translations.empty()) {
                vertices_ += organ.organ.points.size();
                triangles_ += organ.organ.triangles.size();
            }
            const NodePose& pose = organ.poses.back().second;
            here.symbol = organ.part.symbol;
            here.translations.push_back(pose.translation);
            here.rotations.push_back(quaternion(pose.rotation));
            here.scales.push_back(pose.scale);
            ++organs_;
        }
        for (const auto& [key, here] : places) {
            children_[key.first].push_back(glb_.add_instances({{"name", here.symbol}, {"mesh", key.second}},
                                                              here.translations, here.rotations, here.scales));
        }
    }

    const ExportJob& job_;
    const RecordedFrame& frame_;
    Glb glb_;
    ShapeMeshes meshes_;
    std::map<std::uint32_t, std::vector<std::size_t>> children_;  ///< children of each plant
    std::size_t vertices_ = 0, triangles_ = 0, organs_ = 0;
};

class Growth {
public:
    explicit Growth(const ExportJob& job) : job_(job), nodes_(standing(job.options)), glb_(job.run), meshes_(glb_) {}

    ExportedFile write() {
        for (const RecordedFrame* frame : job_.frames) {
            nodes_.add(job_.geometry(*frame));
            const double seconds = (frame->step - job_.frames.front()->step) / job_.steps_per_second;
            times_.push_back(static_cast<float>(seconds));
        }
        const bool is_grouped = job_.grouped.value_or(nodes_.all().size() >= many);
        const std::size_t number = is_grouped ? add_groups() : add_nodes();
        std::vector<std::size_t> roots;
        for (auto& [plant, children] : children_) {
            roots.push_back(
                glb_.add_node({{"name", job_.run.plants()[plant].name}, {"children", std::move(children)}}));
        }
        const auto path = job_.path("glb", {vertices_, triangles_, 0, ""});
        write_text(path, glb_.bytes(roots));
        if (!is_grouped) return {path, vertices_, triangles_, number, "moving internodes and organs", glb_.hint()};
        ExportedFile file{path, vertices_, triangles_, number, "groups that appear", glb_.hint()};
        if (!job_.grouped) {
            file.hint = joined_hints(
                {file.hint, fmt::format("{} internodes and organs would be slow to load one by one: those that are "
                                        "born together are one object; --no-grouped moves each",
                                        nodes_.all().size())});
        }
        return file;
    }

private:
    static constexpr std::size_t many = 5000;  ///< programs take seconds to load so many objects

    std::size_t add_nodes() {
        std::size_t number = 0;
        for (const GrowthNode& node : nodes_.all()) {
            if (!node.poses.empty()) add(node, number++);
        }
        return number;
    }

    std::size_t shape_number(const NodeShape& shape) {
        vertices_ += shape.points.size();
        triangles_ += shape.triangles.size();
        return meshes_.number(shape);
    }

    /// What one plant has from one frame to another, each thing as it was last seen.
    std::size_t add_groups() {
        std::map<std::tuple<std::uint32_t, std::size_t, std::size_t>, FrameMesh> groups;
        for (const GrowthNode& node : nodes_.all()) {
            if (node.poses.empty()) continue;
            const auto& [last, pose] = node.poses.back();
            append(groups[{node.part.plant, node.poses.front().first, last}], shape_of(node, job_.options.sides), pose);
        }
        for (const auto& [key, mesh] : groups) {
            const auto& [plant, first, last] = key;
            const std::size_t shape =
                glb_.add_mesh(mesh.points, mesh.normals, mesh.uvs, mesh.triangles, mesh.material_of, mesh.materials);
            vertices_ += mesh.points.size();
            triangles_ += mesh.triangles.size();
            const std::size_t node = glb_.add_node(
                {{"name", fmt::format("{}_born_{}", job_.run.plants()[plant].name, job_.frames[first]->step)},
                 {"mesh", shape}});
            children_[plant].push_back(node);
            show(node, first, last);
        }
        return groups.size();
    }

    static void append(FrameMesh& mesh, const NodeShape& shape, const NodePose& pose) {
        const auto origin = static_cast<std::uint32_t>(mesh.points.size());
        for (std::size_t i = 0; i < shape.points.size(); ++i) {
            mesh.points.push_back(pose.translation + pose.rotation * (pose.scale * shape.points[i]));
            mesh.normals.push_back(glm::normalize(pose.rotation * (shape.normals[i] / pose.scale)));
            mesh.uvs.push_back(shape.uvs[i]);
        }
        for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
            const auto [a, b, c] = shape.triangles[i];
            mesh.triangles.push_back({origin + a, origin + b, origin + c});
            const MeshMaterial look{shape.rgb[i], shape.texture};
            auto at = std::find(mesh.materials.begin(), mesh.materials.end(), look);
            if (at == mesh.materials.end()) at = mesh.materials.insert(at, look);
            mesh.material_of.push_back(static_cast<std::uint32_t>(at - mesh.materials.begin()));
        }
    }

    /// At the frames from `first` to `last` alone, at once and whole.
    void show(std::size_t node, std::size_t first, std::size_t last) {
        std::vector<float> times;
        std::vector<glm::vec4> scales;
        const auto add = [&](std::size_t frame, float scale) {
            times.push_back(times_[frame]);
            scales.emplace_back(scale, scale, scale, 0);
        };
        if (first > 0) add(0, 0);
        add(first, 1);
        if (last + 1 < times_.size()) add(last + 1, 0);
        if (times.size() > 1) glb_.animate(node, "scale", times, scales, "STEP");
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

    const ExportJob& job_;
    GrowthNodes nodes_;
    std::vector<float> times_;
    Glb glb_;
    ShapeMeshes meshes_;
    std::map<std::uint32_t, std::vector<std::size_t>> children_;  ///< children of each plant
    std::size_t vertices_ = 0, triangles_ = 0;
};

class Gltf final : public Exporter {
public:
    std::string extension() const override { return "glb"; }

    void check(const ExportJob& job) const override {
        if (job.frames.size() > 1) {
            if (job.options.skin.smooth) {
                throw UserError("--skin smooth: things that move have shapes of their own; export one --step");
            }
            refuse_triangles_and_split(job, "things that move have shapes of their own; export one --step");
        } else if (job.instances) {
            refuse_triangles_and_split(
                job, "organs that are one shape in many places stay as they are; leave out --instances");
        }
    }

    void write(const ExportJob& job) const override {
        const RecordedFrame& frame = *job.frames[0];
        if (job.frames.size() > 1) return job.report(Growth(job).write());
        job.report(job.instances ? Instances(job, frame).write() : write_frame(job, frame));
    }
};

const Registered<ExporterType> entry{
    {"gltf", "glTF 2.0 (.glb), one frame or the growth as an animation: for the web, Blender, engines",
     "One frame: a node per plant, smooth tubes, materials by colour and texture (embedded). Several (--step all): one "
     "file in which every\n"
     "internode and organ is a node that appears at its birth, moves, grows and vanishes, --rate steps a second; it "
     "has\n"
     "the shape and colour it was last seen in, an internode a taper to a sixteenth. --grouped, and from 5,000 "
     "internodes\n"
     "and organs on unless --no-grouped: what is born and dies at the same steps is one object that appears as it was "
     "last\nseen. --instances, of one frame: organs that look "
     "alike\n"
     "are one mesh in many places (EXT_mesh_gpu_instancing). The vertical is y, as glTF says.\n"
     "Lost: parameters; in animations smooth joints and textures of axes, and --simplify means nothing",
     construct<Gltf>}};

}  // namespace
}  // namespace espalier::formats
