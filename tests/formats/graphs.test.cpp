// RSML, MTG, CSV and VDB, each read by another reader than the one that wrote it.
#include "espalier/base/error.h"

#include "catch.h"
#include "formats/exporting.h"

#include <openvdb/io/File.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <set>

namespace {

using namespace espalier;
using namespace espalier::formats;

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == separator) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

std::vector<vtkXMLDataElement*> children(vtkXMLDataElement& parent, const std::string& name) {
    std::vector<vtkXMLDataElement*> found;
    for (int i = 0; i < parent.GetNumberOfNestedElements(); ++i) {
        vtkXMLDataElement* child = parent.GetNestedElement(i);
        if (child->GetName() == name) found.push_back(child);
    }
    return found;
}

vtkXMLDataElement& child(vtkXMLDataElement& parent, const std::string& name) {
    const auto found = children(parent, name);
    REQUIRE(found.size() == 1);
    return *found[0];
}

double number(vtkXMLDataElement& element, const char* attribute) {
    return std::stod(element.GetAttribute(attribute));
}

/// An MTG read by the rules of its rows: an entity in a column belongs to the last one in the column, or left of it.
struct MtgGraph {
    struct Vertex {
        std::string parent, edge, axis;
        std::map<std::string, std::string> features;
    };
    std::map<std::string, Vertex> internodes;
    std::set<std::string> plants;

    explicit MtgGraph(const std::string& text) {
        std::istringstream lines(text.substr(text.find("MTG:\n") + 5));
        std::string line;
        std::getline(lines, line);
        const std::vector<std::string> header = split(line, '\t');
        REQUIRE(header[0] == "ENTITY-CODE");
        const auto features = static_cast<std::size_t>(
            std::find_if(header.begin() + 1, header.end(), [](const auto& cell) { return !cell.empty(); }) -
            header.begin());
        std::map<std::size_t, std::string> last, axis;  // by column
        while (std::getline(lines, line)) {
            const std::vector<std::string> cells = split(line, '\t');
            REQUIRE(cells.size() == header.size());
            std::size_t column = 0;
            while (cells[column].empty()) ++column;
            REQUIRE(column < features);
            const std::string& code = cells[column];
            if (code.find('I') == std::string::npos) {  // a trunk's row
                REQUIRE(code.starts_with("/P"));
                plants.insert(code.substr(1, code.find('/', 1) - 1));
                axis[column] = code.substr(code.find('A'));
                continue;
            }
            const std::string name = code.substr(code.rfind('I'));
            Vertex vertex;
            if (code.starts_with("^<")) {
                vertex.parent = last.at(column);
                vertex.edge = "<";
            } else if (code.starts_with("+A")) {
                vertex.parent = last.at(column - 1);
                vertex.edge = "+";
                axis[column] = code.substr(1, code.find('/') - 1);
            } else {
                REQUIRE(code.starts_with("^/I"));
            }
            vertex.axis = axis[column];
            for (std::size_t i = features; i < header.size(); ++i) vertex.features[header[i]] = cells[i];
            last[column] = name;
            CHECK(internodes.emplace(name, vertex).second);
        }
    }
};

}  // namespace

TEST_CASE("RSML nests laterals in what bears them, with polylines and diameters", "[export]") {
    const Exported exported("rsml");
    const std::string text = exported.text();
    const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromString(text.c_str()));
    REQUIRE(root);
    CHECK(std::string(root->GetName()) == "rsml");
    CHECK(std::string(child(child(*root, "metadata"), "unit").GetCharacterData()) == "m");
    const auto plants = children(child(*root, "scene"), "plant");
    REQUIRE(plants.size() == 2);
    CHECK(std::string(plants[1]->GetAttribute("label")) == "right");
    vtkXMLDataElement& stem = child(*plants[0], "root");
    vtkXMLDataElement& polyline = child(child(stem, "geometry"), "polyline");
    REQUIRE(polyline.GetNumberOfNestedElements() == 3);
    CHECK(number(*polyline.GetNestedElement(2), "y") == 3);
    const auto functions = children(child(stem, "functions"), "function");
    REQUIRE(functions.size() == 2);
    vtkXMLDataElement& diameter = *functions[0];
    CHECK(std::string(functions[1]->GetAttribute("name")) == "node_creation_time");
    REQUIRE(functions[1]->GetNumberOfNestedElements() == 3);
    CHECK(std::stod(functions[1]->GetNestedElement(0)->GetCharacterData()) == 0);
    REQUIRE(diameter.GetNumberOfNestedElements() == 3);
    CHECK(std::stod(diameter.GetNestedElement(0)->GetCharacterData()) == Approx(0.2));
    CHECK(std::stod(diameter.GetNestedElement(2)->GetCharacterData()) == Approx(0.1));
    CHECK(number(child(child(stem, "properties"), "length"), "value") == Approx(3));

    vtkXMLDataElement& lateral = child(stem, "root");
    vtkXMLDataElement& line = child(child(lateral, "geometry"), "polyline");
    CHECK(number(*line.GetNestedElement(0), "y") == 1);
    CHECK(number(child(child(lateral, "properties"), "identity"), "value") == 2);
    CHECK(number(child(child(lateral, "properties"), "birth"), "value") == 1);
    // It stands on the first node behind the base of the stem.
    CHECK(number(child(child(lateral, "properties"), "parent-node"), "value") == 1);
    CHECK(number(*polyline.GetNestedElement(1), "y") == 1);
    CHECK(std::stod(children(child(lateral, "functions"), "function")[1]->GetNestedElement(0)->GetCharacterData()) ==
          0.5);  // step 1
    CHECK(children(lateral, "root").empty());
}

TEST_CASE("an MTG knows who follows whom and who is borne by whom", "[export]") {
    const Exported exported("mtg");
    const MtgGraph graph(exported.text());
    REQUIRE(graph.internodes.size() == 6);
    CHECK(graph.plants.size() == 2);
    std::map<std::string, std::string> name_of;  // names in the left plant, by identity
    for (const auto& [name, vertex] : graph.internodes) {
        if (vertex.features.at("plant") == "left") name_of[vertex.features.at("identity")] = name;
    }
    REQUIRE(name_of.size() == 3);
    const auto& first = graph.internodes.at(name_of["1"]);
    const auto& branch = graph.internodes.at(name_of["2"]);
    const auto& second = graph.internodes.at(name_of["3"]);
    CHECK(first.parent.empty());
    CHECK(branch.parent == name_of["1"]);
    CHECK(branch.edge == "+");
    CHECK(second.parent == name_of["1"]);
    CHECK(second.edge == "<");
    CHECK(first.axis == second.axis);
    CHECK(first.axis != branch.axis);
    CHECK(std::stod(second.features.at("length")) == Approx(2));
    CHECK(std::stod(second.features.at("YY")) == Approx(3));
    CHECK(std::stod(second.features.at("diameter")) == Approx(0.1));
    CHECK(second.features.at("birth") == "2");
    CHECK(branch.features.at("order") == "1");
}

TEST_CASE("the table has a row for every internode, organ and query of every frame", "[export]") {
    const Exported exported("csv", {}, {0, 4});
    std::istringstream lines(exported.text());
    std::string line;
    std::getline(lines, line);
    const std::vector<std::string> header = split(line, ',');
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(lines, line)) {
        const std::vector<std::string> cells = split(line, ',');
        REQUIRE(cells.size() == header.size());
        auto& row = rows.emplace_back();
        for (std::size_t i = 0; i < cells.size(); ++i) row[header[i]] = cells[i];
    }
    constexpr std::size_t queries = 2;  // queries of both plants
    REQUIRE(rows.size() == (1 + 4 + queries) + (3 + 4 + queries));
    const auto row = [&](const std::string& step, const std::string& plant, const std::string& identity) {
        const auto found = std::find_if(rows.begin(), rows.end(), [&](const auto& candidate) {
            return candidate.at("step") == step && candidate.at("name") == plant &&
                   candidate.at("identity") == identity;
        });
        REQUIRE(found != rows.end());
        return *found;
    };
    const auto branch = row("4", "left", "2");
    CHECK(branch.at("kind") == "internode");
    CHECK(branch.at("parent") == "1");
    CHECK(std::stod(branch.at("length")) == Approx(std::sqrt(1.25)));
    CHECK(std::stod(branch.at("vigour")) == 0.25);
    CHECK(std::stod(branch.at("volume")) == Approx(frustum_volume(std::sqrt(1.25), 0.1, 0.05, std::numbers::pi)));
    const auto triangle = row("0", "right", "50");
    CHECK(triangle.at("kind") == "organ");
    CHECK(triangle.at("symbol") == "P");
    CHECK(std::stod(triangle.at("area")) == Approx(0.5));
    CHECK(triangle.at("vigour").empty());
    const auto query = row("0", "left", "4");
    CHECK(query.at("kind") == "query");
    CHECK(std::stod(query.at("light")) == 0.125);
}

TEST_CASE("fields become OpenVDB grids with their values, from .vti too", "[export]") {
    for (const std::string files : {"field_files = [\"vti\"]\n", "field_files = [\"vdb\"]\n"}) {
        INFO(files);
        const Exported exported("vdb", {}, {0, 4}, files);
        REQUIRE(exported.files.size() == 2);
        openvdb::io::File file(exported.files[1].path.string());
        file.open(false);
        const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("light"));
        REQUIRE(grid);
        const openvdb::Vec3d centre(1.25, 2.25, 3.25);
        const auto value_at = [&](const openvdb::Vec3d& place) {
            return grid->tree().getValue(openvdb::Coord::round(grid->worldToIndex(place)));
        };
        CHECK(value_at(centre) == 4.5f);
        CHECK(value_at(centre + openvdb::Vec3d(0.5, 1, 0)) == 9);
        CHECK(grid->voxelSize().x() == Approx(0.5));
    }
}

TEST_CASE("a run without fields says so", "[export]") {
    CHECK_THROWS_WITH(ExportedPlant(branched_plant(), "vdb"), Catch::Contains("no fields"));
}

TEST_CASE("--voxel-corners moves a field back by half a voxel along its own axes, before it is turned upright",
          "[export]") {
    const auto transform_of = [](char up, bool corners) {
        MeshOptions options;
        options.up = up;
        const Exported exported("vdb", options, {4}, "", [&](ExportJob& job) { job.voxel_corners = corners; });
        openvdb::io::File file(exported.files.at(0).path.string());
        file.open(false);
        return file.readGrid("light")->transform().copy();
    };
    for (const char up : {'y', 'z'}) {
        const auto centres = transform_of(up, false), corners = transform_of(up, true);
        for (const openvdb::Vec3d& voxel : {openvdb::Vec3d(0, 0, 0), openvdb::Vec3d(3, 5, -2)}) {
            const openvdb::Vec3d expected = centres->indexToWorld(voxel - openvdb::Vec3d(0.5));
            CHECK((corners->indexToWorld(voxel) - expected).length() < 1e-12);
        }
    }
}

TEST_CASE("whoever writes fields and meshes together is told once how Blender sees them", "[export]") {
    const auto hints_of = [](const std::vector<std::string>& formats, char up) {
        const RecordedFolder recorded;
        const RecordedRun run(recorded.folder.path);
        const std::vector<const RecordedFrame*> frames{&run.frame(0), &run.frame(4)};
        std::vector<std::string> hints;
        MeshOptions options;
        options.up = up;
        const auto report = [&](const ExportedFile& file) {
            if (file.path.extension() == ".vdb" && !file.hint.empty()) hints.push_back(file.hint);
        };
        export_run({run, frames, options, recorded.folder.path / "export", report}, formats);
        return hints;
    };
    const auto together = hints_of({"obj", "vdb"}, 'y');
    REQUIRE(together.size() == 1);
    CHECK_THAT(together[0], Catch::Contains("Blender") && Catch::Contains("--up z"));
    CHECK(hints_of({"vdb"}, 'y').empty());
    CHECK(hints_of({"vdb", "csv"}, 'y').empty());
    CHECK(hints_of({"usd", "vdb"}, 'z').empty());
}
