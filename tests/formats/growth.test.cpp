// Growth in one file: glTF's animation and USD's time samples, read as their standards say.
#include "catch.h"
#include "formats/exporting.h"
#include "formats/small_tree.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>

namespace {

using namespace espalier;
using namespace espalier::formats;
using Json = nlohmann::json;

std::uint32_t word(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

/// The chunks of a .glb.
struct GlbFile {
    Json json;
    std::string binary;

    explicit GlbFile(const std::string& bytes) {
        REQUIRE(bytes.size() > 20);
        CHECK(bytes.substr(0, 4) == "glTF");
        CHECK(word(bytes, 4) == 2);
        CHECK(word(bytes, 8) == bytes.size());
        const std::uint32_t length = word(bytes, 12);
        CHECK(bytes.substr(16, 4) == "JSON");
        CHECK(length % 4 == 0);
        json = Json::parse(bytes.substr(20, length));
        const std::size_t next = 20 + length;
        CHECK(bytes.substr(next + 4, 4) == std::string("BIN\0", 4));
        binary = bytes.substr(next + 8, word(bytes, next));
        CHECK(json["buffers"][0]["byteLength"].get<std::size_t>() <= binary.size());
    }

    std::vector<float> numbers(std::size_t accessor) const {
        const Json& of = json["accessors"][accessor];
        REQUIRE(of["componentType"] == 5126);
        const Json& view = json["bufferViews"][of["bufferView"].get<std::size_t>()];
        const std::size_t width = of["type"] == "SCALAR" ? 1 : of["type"] == "VEC3" ? 3 : 4;
        std::vector<float> values(of["count"].get<std::size_t>() * width);
        REQUIRE(view["byteLength"].get<std::size_t>() == values.size() * 4);
        std::memcpy(values.data(), binary.data() + view["byteOffset"].get<std::size_t>(), values.size() * 4);
        return values;
    }

    std::size_t node_of(const std::string& plant, const std::string& identity) const {
        for (std::size_t i = 0; i < json["nodes"].size(); ++i) {
            const Json& node = json["nodes"][i];
            if (!node.contains("extras") || node["extras"]["identity"] != identity) continue;
            if (node["name"].get<std::string>().starts_with(plant)) return i;
        }
        FAIL("no node of " << plant << " " << identity);
        return 0;
    }

    /// Times and values of a channel; empty if the node has none.
    std::pair<std::vector<float>, std::vector<float>> channel(std::size_t node, const std::string& path) const {
        const Json& animation = json["animations"][0];
        for (const Json& known : animation["channels"]) {
            if (known["target"]["node"] != node || known["target"]["path"] != path) continue;
            const Json& sampler = animation["samplers"][known["sampler"].get<std::size_t>()];
            return {numbers(sampler["input"]), numbers(sampler["output"])};
        }
        return {};
    }
};

/// What stands behind an attribute of a prim within a plant: "STEP: VALUE" by step, or under -1 if it never changes.
std::map<int, std::string> samples(const std::string& text, const std::string& plant, const std::string& prim,
                                   const std::string& attribute) {
    const std::size_t begin = text.find("\"" + prim + "\"", text.find("displayName = \"" + plant + "\""));
    REQUIRE(begin != std::string::npos);
    const std::string body = text.substr(begin, text.find("\n        }\n", begin) - begin);
    const std::size_t plain = body.find(attribute + " = "), timed = body.find(attribute + ".timeSamples = {\n");
    if (timed == std::string::npos) {
        REQUIRE(plain != std::string::npos);
        const std::size_t value = plain + attribute.size() + 3;
        return {{-1, body.substr(value, body.find('\n', value) - value)}};
    }
    std::map<int, std::string> result;
    std::istringstream lines(body.substr(body.find('\n', timed) + 1));
    for (std::string line; std::getline(lines, line) && line.find('}') == std::string::npos;) {
        const std::size_t colon = line.find(':');
        result[std::stoi(line)] = line.substr(colon + 2, line.rfind(',') - colon - 2);
    }
    return result;
}

std::vector<double> numbers_in(const std::string& list) {
    std::string plain = list;
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return std::strchr("[](),", c) != nullptr; }, ' ');
    std::istringstream in(plain);
    std::vector<double> values;
    for (double value = 0; in >> value;) values.push_back(value);
    return values;
}

}  // namespace

TEST_CASE("in a glTF's animation an internode appears at its birth", "[export]") {
    const Exported exported("gltf", {}, {0, 4});
    const GlbFile file(exported.text());
    const std::size_t branch = file.node_of("left", "2");
    const auto [times, scales] = file.channel(branch, "scale");
    REQUIRE(times.size() == 2);
    CHECK(times[0] == 0);
    CHECK(times[1] == Approx(4 / 24.0));
    CHECK(std::vector<float>(scales.begin(), scales.begin() + 3) == std::vector<float>{0, 0, 0});
    CHECK(scales[3] == Approx(0.1));
    CHECK(scales[4] == Approx(std::sqrt(1.25)));
    // What was there from the beginning and did not change has no channel at all.
    CHECK(file.channel(file.node_of("left", "1"), "scale").first.empty());
    CHECK(file.channel(file.node_of("right", "50"), "scale").first.empty());
    CHECK(file.json["animations"][0]["channels"].size() == 2);  // the left plant's two new internodes

    const Json& node = file.json["nodes"][branch];
    CHECK(node["translation"] == Json({0, 1, 0}));
    // The turn takes the internode's own y to where it points.
    const Json& q = node["rotation"];
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    CHECK(2 * (x * y - w * z) == Approx(1 / std::sqrt(1.25)));
    CHECK(1 - 2 * (x * x + z * z) == Approx(0.5 / std::sqrt(1.25)));
    CHECK(2 * (y * z + w * x) == Approx(0).margin(1e-6));
}

TEST_CASE("things that look alike share a mesh, and each plant is a node", "[export]") {
    const Exported exported("gltf", {}, {0, 4});
    const GlbFile file(exported.text());
    // Frusta that taper by half, one cylinder, and a triangle.
    CHECK(file.json["meshes"].size() == 3);
    CHECK(file.json["nodes"].size() == 7 + 2);
    const Json& roots = file.json["scenes"][0]["nodes"];
    REQUIRE(roots.size() == 2);
    CHECK(file.json["nodes"][roots[0].get<std::size_t>()]["name"] == "left");
    CHECK(file.json["nodes"][roots[0].get<std::size_t>()]["children"].size() == 3);
}

TEST_CASE("USD's curves grow with time, and its meshes say when they are seen", "[export]") {
    const Exported exported("usd", {}, {0, 4});
    const std::string text = exported.text();
    CHECK(text.starts_with("#usda 1.0\n"));
    CHECK(text.find("upAxis = \"Y\"") != std::string::npos);
    CHECK(text.find("endTimeCode = 4\n") != std::string::npos);
    for (const auto& [open, close] : {std::pair{'{', '}'}, {'(', ')'}, {'[', ']'}}) {
        CHECK(std::count(text.begin(), text.end(), open) == std::count(text.begin(), text.end(), close));
    }
    CHECK(std::count(text.begin(), text.end(), '"') % 2 == 0);

    const auto counts = samples(text, "left", "axes", "curveVertexCounts");
    const auto points = samples(text, "left", "axes", "points");
    const auto widths = samples(text, "left", "axes", "widths");
    CHECK(numbers_in(counts.at(0)) == std::vector<double>{2});
    CHECK(numbers_in(counts.at(4)) == std::vector<double>{3, 2});
    CHECK(numbers_in(points.at(0)).size() == 3 * 2);
    CHECK(numbers_in(points.at(4)).size() == 3 * 5);
    REQUIRE(numbers_in(widths.at(4)).size() == 5);
    CHECK(numbers_in(widths.at(4))[0] == Approx(0.2));
    CHECK(samples(text, "left", "surfaces", "visibility").at(4) == "\"invisible\"");
    CHECK(samples(text, "right", "surfaces", "visibility").at(0) == "\"inherited\"");
    CHECK(numbers_in(samples(text, "right", "surfaces", "faceVertexIndices").at(4)) == std::vector<double>{0, 1, 2});
}

TEST_CASE("behind its samples every attribute of USD has the value of the last frame", "[export]") {
    const std::string text = Exported("usd", {}, {0, 4}).text();
    const std::string samples_of = ".timeSamples = {";
    std::size_t count = 0;
    for (std::size_t at = text.find(samples_of); at != std::string::npos; at = text.find(samples_of, at + 1)) {
        const std::size_t begin = text.rfind('\n', at) + 1, end = text.find("}\n", at);
        const std::string declaration = text.substr(begin, at - begin);  // with its margin
        const std::size_t last = text.rfind(": ", end) + 2;
        const std::string value = text.substr(last, text.rfind(",\n", end) - last);
        CHECK(text.substr(end + 2).starts_with(declaration + " = " + value));
        ++count;
    }
    CHECK(count > 10);
    CHECK(text.find("    interpolation = ") != std::string::npos);
}

TEST_CASE("every colour of a USD mesh is a material, which its faces are bound to", "[export]") {
    const ExportedPlant exported(SmallTree().plant, "usd", [](ExportJob& job) { job.mesh_axes = true; });
    const std::string text = bytes_of(exported.files.at(0).path);
    const std::string subset = "def GeomSubset \"", list = "int[] indices = [";
    std::size_t subsets = 0, faces = 0;
    for (std::size_t at = text.find(subset); at != std::string::npos; at = text.find(subset, at + 1)) {
        const std::size_t begin = at + subset.size();
        const std::string material = text.substr(begin, text.find('"', begin) - begin);
        const std::size_t defined = text.find("def Material \"" + material + '"');
        REQUIRE(defined != std::string::npos);
        CHECK(text.find("color3f inputs:diffuseColor = (", defined) < text.find("def Material", defined + 1));
        const std::size_t indices = text.find(list, at) + list.size();
        const std::string body = text.substr(indices, text.find(']', indices) - indices);
        faces += static_cast<std::size_t>(std::count(body.begin(), body.end(), ',')) + 1;
        ++subsets;
    }
    CHECK(subsets == 2);  // wood and leaves
    CHECK(faces == exported.files.at(0).triangles);
}

TEST_CASE("a USD of one frame has values without times", "[export]") {
    MeshOptions options;
    options.up = 'z';
    const std::string text = Exported("usd", options).text();
    CHECK(text.find("timeSamples") == std::string::npos);
    CHECK(text.find("upAxis = \"Z\"") != std::string::npos);
    const auto points = numbers_in(samples(text, "left", "axes", "points").at(-1));
    REQUIRE(points.size() == 15);
    CHECK(points[8] == 3);  // the stem's tip, upright
}

TEST_CASE("the frame rate of growth can be chosen", "[export]") {
    const auto twice = [](ExportJob& job) { job.steps_per_second = 48; };
    const Exported exported("gltf", {}, {0, 4}, "", twice);
    const GlbFile file(exported.text());
    CHECK(file.channel(file.node_of("left", "2"), "scale").first[1] == Approx(4 / 48.0));
    CHECK(Exported("usd", {}, {0, 4}, "", twice).text().find("timeCodesPerSecond = 48\n") != std::string::npos);
}

TEST_CASE("grouped growth has an object for what appears and vanishes together", "[export]") {
    const Exported exported("gltf", {}, {0, 4}, "", [](ExportJob& job) { job.grouped = true; });
    const GlbFile file(exported.text());
    // The left plant has the seedling, and what came at step 4; the right one has everything at once.
    CHECK(exported.files.at(0).elements == 3);
    CHECK(file.json["nodes"].size() == 3 + 2);
    REQUIRE(file.json["animations"][0]["channels"].size() == 1);
    const Json& sampler = file.json["animations"][0]["samplers"][0];
    CHECK(sampler["interpolation"] == "STEP");
    CHECK(file.numbers(sampler["output"]) == std::vector<float>{0, 0, 0, 1, 1, 1});
}

TEST_CASE("from 5,000 internodes and organs on growth is grouped unless one says no", "[export]") {
    const auto exported = [](int organs, std::optional<bool> grouped) {
        HandmadePlant early, late;
        for (int i = 0; i < organs; ++i) {
            const glm::dvec3 base(0.1 * i, 0, 0), tip(0.1 * i, 1, 0);
            const auto axis = static_cast<std::uint32_t>(i);
            const Identity identity = 1 + static_cast<Identity>(i);
            if (i > 0) early.add_internode(identity, 0, 0, axis, 0, base, tip, 0);
            late.add_internode(identity, 0, i > 0 ? 0 : 1, axis, 0, base, tip, 0);
        }
        const RunFolder folder;
        Timeline timeline(folder.path, timeline_table(), 1);
        record(timeline, 0, {&early});
        record(timeline, 1, {&late});
        timeline.finish();
        timeline.write_run(run_json);
        const RecordedRun run(folder.path);
        const RecordedFrame* const frames[] = {&run.frame(0), &run.frame(1)};
        ExportedFile file;
        ExportJob job{run, frames, {}, folder.path / "export", [&](const ExportedFile& written) { file = written; }};
        job.grouped = grouped;
        export_run(job, std::vector<std::string>{"gltf"});
        return std::pair(file, GlbFile(bytes_of(file.path)).json);
    };
    const auto [many, of_many] = exported(5000, std::nullopt);
    CHECK(of_many["meshes"].size() == 2);  // what was there, and what came
    CHECK_THAT(many.hint, Catch::Contains("--no-grouped"));
    const auto [each, of_each] = exported(5000, false);
    CHECK(each.elements == 5000);
    CHECK(of_each["nodes"].size() == 5001);
    const auto [fewer, of_fewer] = exported(4999, std::nullopt);
    CHECK(fewer.elements == 4999);
    CHECK(fewer.hint.empty());
}

TEST_CASE("materials have names that say what they look like", "[export]") {
    const Exported exported("gltf");
    const GlbFile file(exported.text());
    for (const Json& material : file.json["materials"]) {
        CHECK(material["name"].get<std::string>().starts_with("rgb_"));
    }
}

TEST_CASE("organs that look alike are one mesh in many places", "[export]") {
    const auto instances = [](ExportJob& job) { job.instances = true; };
    const Exported exported("gltf", {}, {4}, "", instances);
    const GlbFile file(exported.text());
    CHECK(file.json["extensionsUsed"] == Json({"EXT_mesh_gpu_instancing"}));
    int nodes = 0;
    for (const Json& node : file.json["nodes"]) {
        if (!node.contains("extensions")) continue;
        ++nodes;
        const Json& attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
        CHECK(file.numbers(attributes["TRANSLATION"]).size() == 3);
        CHECK(file.numbers(attributes["ROTATION"]).size() == 4);
    }
    CHECK(nodes == 1);  // the triangle
}

TEST_CASE("USD's instances name their shapes and stand where the organs do", "[export]") {
    const std::string text = Exported("usd", {}, {0, 4}, "", [](ExportJob& job) { job.instances = true; }).text();
    CHECK(text.find("rel prototypes = [</world/plant_1/organs/shapes/shape_0>]") != std::string::npos);
    CHECK(numbers_in(samples(text, "right", "organs", "protoIndices").at(0)) == std::vector<double>{0});
    CHECK(text.find("\"surfaces\"") == std::string::npos);
    for (const auto& [open, close] : {std::pair{'{', '}'}, {'(', ')'}, {'[', ']'}}) {
        CHECK(std::count(text.begin(), text.end(), open) == std::count(text.begin(), text.end(), close));
    }
}

TEST_CASE("USD's axes have a material, and may be meshes", "[export]") {
    CHECK(Exported("usd").text().find("rel material:binding = </world/materials/colours>") != std::string::npos);
    const std::string text = Exported("usd", {}, {4}, "", [](ExportJob& job) { job.mesh_axes = true; }).text();
    CHECK(text.find("BasisCurves") == std::string::npos);
    CHECK(numbers_in(samples(text, "left", "surfaces", "faceVertexCounts").at(-1)).size() > 50);
}
