// Frames made by hand, and the folder they are recorded into.
#pragma once

#include "espalier/timeline/timeline.h"

#include "lineage.h"

#include <glm/geometric.hpp>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace espalier {

struct RunFolder {
    std::filesystem::path path;

    RunFolder() {
        static std::atomic<int> number{0};
        path = std::filesystem::temp_directory_path() /
               ("espalier-timeline-" + std::to_string(getpid()) + "-" + std::to_string(number++));
    }
    ~RunFolder() { std::filesystem::remove_all(path); }
    RunFolder(const RunFolder&) = delete;
    RunFolder& operator=(const RunFolder&) = delete;
};

inline Settings timeline_table(const std::string& toml = "") {
    return Settings::parse_toml(toml, "scene.toml");
}

/// A plant of F(length, vigour), brackets, ?E(light), @o(diameter), P (a polygon) and A, written module by module.
struct HandmadePlant {
    Model model;
    ModuleString string;
    Interpretation interpretation;
    std::vector<Quantity> quantities;
    std::uint32_t number = 0;

    HandmadePlant() {
        model.name = "handmade.l";
        model.alphabet.letter("A", 0);
        model.alphabet.letter("F", 2);
        model.alphabet.letter("?", 0);
        model.alphabet.letter("E", 1);
        model.alphabet.letter("@", 0);
        model.alphabet.letter("o", 1);
        model.alphabet.letter("P", 0);
    }

    std::uint32_t add(const std::string& symbol, std::vector<double> parameters, Identity identity, Identity parent,
                      std::uint32_t birth) {
        string.append(model.alphabet.letter(symbol, static_cast<int>(parameters.size())), parameters);
        test::append_lineage(string, identity, parent, birth);
        return static_cast<std::uint32_t>(string.size() - 1);
    }

    /// An internode drawn by a module F(length, vigour).
    void add_internode(Identity identity, Identity parent, std::uint32_t birth, std::uint32_t axis, std::uint16_t order,
                       glm::dvec3 base, glm::dvec3 tip, double vigour) {
        const std::uint32_t module = add("F", {glm::distance(base, tip), vigour}, identity, parent, birth);
        PlantGeometry& geometry = interpretation.geometry;
        geometry.internodes.push_back({module, axis, order, std::uint16_t(7 + order), 0, base, tip, 0.1, 0.05});
        geometry.axes = std::max(geometry.axes, axis + 1);
        geometry.bounds.add(base);
        geometry.bounds.add(tip);
    }

    void add_query(Identity identity, glm::dvec3 position, double answer) {
        add("?", {}, identity + 1000, 0, 0);
        const std::uint32_t module = add("E", {answer}, identity, 0, 0);
        Query query;
        query.module = module;
        query.identity = identity;
        query.pose.position = position;
        interpretation.queries.push_back(query);
    }

    /// ?P(x, y, z), answered by the turtle.
    void add_place(Identity identity, glm::dvec3 position, double width) {
        add("?", {}, identity + 1000, 0, 0);
        const std::size_t at = string.parameters.size();
        const std::uint32_t module = add("P", {position.x, position.y, position.z}, identity, 0, 0);
        interpretation.answers.push_back({module, 3, at, position, width});
    }

    void add_organ(Organ::Shape shape, Identity identity, double diameter, Pose pose = {}) {
        add("@", {}, identity + 1000, 0, 0);
        const std::uint32_t module = add("o", {diameter}, identity, 0, 0);
        interpretation.geometry.organs.push_back({module, shape, 0, 3, 0, pose, glm::dvec3(diameter)});
        interpretation.geometry.bounds.add(pose.position);
    }

    void add_triangle(Identity identity) {
        const std::uint32_t module = add("P", {}, identity, 0, 0);
        PlantGeometry& geometry = interpretation.geometry;
        const auto first = static_cast<std::uint32_t>(geometry.vertices.size());
        for (const glm::dvec3 vertex : {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}) {
            geometry.vertices.push_back(vertex);
            geometry.bounds.add(vertex);
        }
        geometry.polygons.push_back({module, first, 3, 1, 5});
    }

    /// Returns the frame of the plant as it is now.
    PlantFrame frame() const {
        return {number,
                "plant",
                &model,
                std::make_shared<const ModuleString>(string),
                std::make_shared<const Interpretation>(interpretation),
                quantities};
    }
};

/// A stem of two internodes with a side branch from the end of the first: the modules in the string's order.
inline HandmadePlant branched_plant() {
    HandmadePlant plant;
    plant.add_internode(1, 0, 0, 0, 0, {0, 0, 0}, {0, 1, 0}, 0.5);
    plant.add("[", {}, 10, 1, 1);
    plant.add_internode(2, 1, 1, 1, 1, {0, 1, 0}, {1, 1.5, 0}, 0.25);
    plant.add("]", {}, 11, 1, 1);
    plant.add_internode(3, 1, 2, 0, 0, {0, 1, 0}, {0, 3, 0}, 0.75);
    plant.add_query(4, {0, 3, 0}, 0.125);
    return plant;
}

/// Records one frame of these plants and waits until it is written: plants and fields may be gone afterwards.
inline void record(Timeline& timeline, int step, const std::vector<const HandmadePlant*>& plants,
                   const Fields& fields = {}) {
    Frame frame{step, 0.5 * step, {}, &fields};
    for (const HandmadePlant* plant : plants) {
        frame.plants.push_back(plant->frame());
        frame.models.push_back(&plant->model);
    }
    timeline.record(frame);
    timeline.wait();
}

inline vtkSmartPointer<vtkPolyData> read_vtp(const std::filesystem::path& path) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader->GetOutput();
}

inline std::string bytes_of(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return std::move(text).str();
}

}  // namespace espalier
