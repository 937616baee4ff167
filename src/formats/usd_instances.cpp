#include "formats/usd_instances.h"

#include "formats/usd_mesh.h"
#include "formats/usd_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace espalier::formats::usd {

Instancers::Instancers(const ExportJob& job, UsdMaterials& materials) : job_(job), nodes_(job.options) {
    for (const RecordedFrame* frame : job.frames) nodes_.add_organs(job.run.geometry(*frame));
    std::map<std::uint32_t, std::map<NodeShape, std::size_t, ByKey>> numbers;
    for (const GrowthNode& node : nodes_.all()) {
        NodeShape rounded = node.organ;
        rounded.round();
        std::vector<Shape>& shapes = shapes_[node.part.plant];
        const auto [known, is_new] = numbers[node.part.plant].emplace(std::move(rounded), shapes.size());
        shape_of_.push_back(known->second);
        if (!is_new || node.organ.rgb.empty()) continue;
        Shape& shape = shapes.emplace_back(Shape{&node.organ, {}});
        for (std::size_t i = 0; i < node.organ.rgb.size(); ++i) {
            shape.faces[materials.name({node.organ.rgb[i], node.organ.texture})].push_back(i);
        }
        vertices_ += node.organ.points.size();
        triangles_ += node.organ.triangles.size();
    }
}

void Instancers::append_to(std::string& text, std::uint32_t plant, const std::string& path) const {
    const auto shapes = shapes_.find(plant);
    if (shapes == shapes_.end()) return;
    text += "        def PointInstancer \"organs\"\n        {\n";
    std::vector<std::string> prototypes;
    for (std::size_t i = 0; i < shapes->second.size(); ++i) {
        prototypes.push_back(fmt::format("<{}/organs/shapes/shape_{}>", path, i));
    }
    text += fmt::format("            rel prototypes = [{}]\n", fmt::join(prototypes, ", "));
    append_places(text, plant);
    append_shapes(text, plant);
    text += "        }\n";
}

void Instancers::append_shapes(std::string& text, std::uint32_t plant) const {
    text += "            def Scope \"shapes\"\n            {\n";
    const std::vector<Shape>& shapes = shapes_.at(plant);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const NodeShape& shape = *shapes[i].shape;
        append_mesh(text, fmt::format("shape_{}", i),
                    {shape.triangles, shape.points, shape.normals, shape.uvs, shape.rgb, shapes[i].faces}, 16);
    }
    text += "            }\n";
}

void Instancers::append_places(std::string& text, std::uint32_t plant) const {
    struct Places {
        std::vector<std::size_t> shapes, ids;
        std::vector<glm::vec3> positions, scales;
        std::vector<glm::quat> turns;
    };
    std::vector<Places> frames(job_.frames.size());
    for (std::size_t i = 0; i < nodes_.all().size(); ++i) {
        const GrowthNode& node = nodes_.all()[i];
        if (node.part.plant != plant) continue;
        for (const auto& [frame, pose] : node.poses) {
            frames[frame].shapes.push_back(shape_of_[i]);
            frames[frame].ids.push_back(i);
            frames[frame].positions.push_back(pose.translation);
            frames[frame].scales.push_back(pose.scale);
            frames[frame].turns.push_back(pose.rotation);
        }
    }
    Samples shapes("int[] protoIndices", ""), ids("int64[] ids", ""), positions("point3f[] positions", ""),
        scales("float3[] scales", ""), turns("quath[] orientations", "");
    for (std::size_t frame = 0; frame < frames.size(); ++frame) {
        const int step = job_.frames[frame]->step;
        shapes.add(step, numbers(frames[frame].shapes));
        ids.add(step, numbers(frames[frame].ids));
        positions.add(step, vectors(frames[frame].positions));
        scales.add(step, vectors(frames[frame].scales));
        turns.add(step, turns_as_text(frames[frame].turns));
    }
    for (const Samples* samples : {&shapes, &ids, &positions, &scales, &turns}) samples->append_to(text);
}

}  // namespace espalier::formats::usd
