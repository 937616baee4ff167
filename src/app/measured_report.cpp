#include "app/measured_report.h"

#include "app/model_arguments.h"
#include "base/json_text.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace espalier::app {
namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

void print_json(const MeasuredPlants& plants, const MeasuredSummary& summary) {
    Json report;
    report["file"] = plants.path.string();
    report["unit"] = plants.unit;
    report["up"] = plants.up;
    report["plants"] = summary.plants;
    report["axes"] = summary.axes;
    report["axes_of_order"] = summary.axes_of_order;
    report["nodes"] = summary.nodes;
    report["length"] = summary.length;
    report["surface"] = summary.surface;
    report["volume"] = summary.volume;
    report["drawn_surface"] = summary.drawn_surface;
    report["drawn_volume"] = summary.drawn_volume;
    report["organs"] = summary.organs;
    report["organ_area"] = summary.organ_area;
    report["link_length"] = summary.link_length;
    report["lowest"] = vector_json(summary.extent[0]);
    report["highest"] = vector_json(summary.extent[1]);
    report["warnings"] = Json::array();
    for (const Diagnostic& warning : plants.warnings) report["warnings"].push_back(to_string(warning));
    fmt::print("{}\n", json_text(report));
}

std::string in_words(double metres) {
    return format_general(metres) + " m";
}

/// Of cylinders, and where that differs of the cones that are drawn.
void print_both(const char* name, double cylinders, double cones, const char* unit) {
    const std::string first = format_general(cylinders), second = format_general(cones);
    if (first == second) return fmt::print("{:10} {} {}\n", name, first, unit);
    fmt::print("{:10} {} {} of cylinders, {} {} of the cones that a run draws and `analyse` counts\n", name, first,
               unit, second, unit);
}

void print_text(const MeasuredPlants& plants, const MeasuredSummary& summary) {
    const glm::dvec3 size = summary.extent[1] - summary.extent[0];
    fmt::print("{}: unit {}, {} points upwards\n", plants.path.string(), plants.unit, plants.up);
    fmt::print("plants     {}\n", summary.plants);
    fmt::print("axes       {}; by order from 0: {}\n", summary.axes, fmt::join(summary.axes_of_order, ", "));
    fmt::print("nodes      {}\n", summary.nodes);
    fmt::print(
        "length     {}{}\n", in_words(summary.length),
        summary.link_length > 0 ? ", and " + in_words(summary.link_length) + " of links, which belong to no axis" : "");
    print_both("surface", summary.surface, summary.drawn_surface, "m2");
    print_both("volume", summary.volume, summary.drawn_volume, "m3");
    if (summary.organs > 0) {
        fmt::print("organs     {}, with {} m2 on one side\n", summary.organs, format_general(summary.organ_area));
    }
    fmt::print("size       {} wide, {} high, {} deep\n", in_words(size.x), in_words(size.y), in_words(size.z));
    for (const auto& [axis, name] : {std::pair{0, 'x'}, {1, 'y'}, {2, 'z'}}) {
        fmt::print("  {}        {} to {}{}\n", name, in_words(summary.extent[0][axis]),
                   in_words(summary.extent[1][axis]), axis == 1 ? ", upwards" : "");
    }
}

}  // namespace

void report_measured(const MeasuredPlants& plants, bool json) {
    const MeasuredSummary summary = summary_of(plants);
    if (json) return print_json(plants, summary);
    print_warnings(plants.warnings, false);
    print_text(plants, summary);
}

}  // namespace espalier::app
