#include "simulation/object/side_file_check.h"

#include "espalier/base/file.h"
#include "espalier/geometry/palette.h"

#include "language/side_files/side_files.h"
#include "simulation/object/animation_file.h"
#include "simulation/object/environment_file.h"
#include "simulation/object/panels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/trigonometric.hpp>

#include <map>

namespace espalier::simulation {
namespace {

namespace fs = std::filesystem;

void add_unused(const fs::path& path, const std::vector<std::string>& unused, Findings& findings) {
    if (unused.empty()) return;
    findings.facts.push_back(fmt::format("{}: {} (read; no meaning here)", path.string(), fmt::join(unused, ", ")));
}

// "2 surfaces", "1 function", ...
std::vector<std::string> parts_of(const View& view) {
    std::vector<std::string> parts;
    const auto count = [&](std::size_t number, const char* what) {
        if (number > 0) parts.push_back(fmt::format("{} {}{}", number, what, number == 1 ? "" : "s"));
    };
    count(view.turtle.tropisms.size(), "tropism");
    if (view.turtle.shapes) {
        count(view.turtle.shapes->surfaces.size(), "surface");
        count(view.turtle.shapes->contours.size(), "contour");
        count(view.turtle.shapes->textures.size(), "texture");
    }
    if (view.resources) {
        count(view.resources->functions.size(), "function");
        count(view.resources->curves.size(), "curve");
    }
    count(view.lights.size(), "light");
    count(view.backgrounds.size(), "background");
    return parts;
}

void check_view(const fs::path& path, Findings& findings) {
    const View view = read_view_file(path);
    findings.diagnostics = view.diagnostics;
    add_unused(path, view.unused, findings);
    review_view(view, findings);
}

void check_animation(const fs::path& path, Findings& findings) {
    const Animation animation = read_animation_file(path);
    findings.diagnostics = animation.diagnostics;
    add_unused(path, animation.unused, findings);
    findings.facts.push_back(fmt::format(
        "{}: frames from {} to {}, every {}{}", path.string(), animation.frames.first,
        animation.last ? std::to_string(*animation.last) : "the derivation length", animation.frames.step,
        animation.frames.intervals.empty() ? "" : fmt::format("; {} intervals", animation.frames.intervals.size())));
}

void check_environment(const fs::path& path, Findings& findings) {
    const EnvironmentFile file = read_environment_file(path);
    findings.diagnostics = file.diagnostics;
    add_unused(path, file.unused, findings);
    for (const auto& process : file.processes) {
        findings.facts.push_back(fmt::format("{}: answered by {}", path.string(), process.second.text("process")));
    }
}

void check_colours(const fs::path& path, Findings& findings) {
    Palette palette;
    path.extension() == ".mat" ? read_materials(path, 1, palette) : read_colour_map(path, 1, palette);
    findings.facts.push_back(fmt::format("{}: {} colours", path.string(), palette.entries.size()));
}

// How a view file would name it; "" for what no view file names. Curves and contours have the same extension.
std::string view_line(const fs::path& path) {
    const std::string extension = path.extension().string(), name = path.filename().string();
    if (extension == ".s") return fmt::format("surface: a {} 1\n", name);
    if (extension == ".ray" || extension == ".obj") return fmt::format("tsurface: a {} 1\n", name);
    if (extension == ".func") return fmt::format("function: {}\n", name);
    if (extension == ".fset") return fmt::format("function set: {}\n", name);
    if (extension != ".con") return "";
    return language::is_curve_text(read_text(path)) ? fmt::format("curve: {}\n", name)
                                                    : fmt::format("contour: 1 {}\n", name);
}

// What a run passes over is a mistake here, where nothing else is looked at.
void check_named_by_view(const fs::path& path, Findings& findings) {
    const View view = read_view_text(view_line(path), path.string());
    findings.diagnostics = view.diagnostics;
    for (Diagnostic& diagnostic : findings.diagnostics) diagnostic.severity = Diagnostic::Severity::error;
    if (findings.diagnostics.empty()) {
        findings.facts.push_back(fmt::format("{}: {}", path.string(), fmt::join(parts_of(view), ", ")));
    }
}

void check_panels(const fs::path& path, Findings& findings) {
    const std::vector<Panel> panels = read_panel_text(read_text(path), path.string());
    std::size_t sliders = 0;
    for (const Panel& panel : panels) sliders += panel.sliders.size();
    findings.facts.push_back(fmt::format("{}: {} slider{} in {} panel{}", path.string(), sliders,
                                         sliders == 1 ? "" : "s", panels.size(), panels.size() == 1 ? "" : "s"));
}

using Check = void (*)(const fs::path&, Findings&);

const std::map<std::string, Check>& checks() {
    static const std::map<std::string, Check> all{{".v", check_view},
                                                  {".a", check_animation},
                                                  {".e", check_environment},
                                                  {".map", check_colours},
                                                  {".mat", check_colours},
                                                  {".s", check_named_by_view},
                                                  {".ray", check_named_by_view},
                                                  {".obj", check_named_by_view},
                                                  {".func", check_named_by_view},
                                                  {".fset", check_named_by_view},
                                                  {".con", check_named_by_view},
                                                  {".panel", check_panels}};
    return all;
}

}  // namespace

bool is_side_file(const fs::path& path) {
    return checks().count(path.extension().string()) != 0 && !fs::is_directory(path);
}

void check_side_file(const fs::path& path, Findings& findings) {
    checks().at(path.extension().string())(path, findings);
}

void review_view(const View& view, Findings& findings) {
    const std::vector<std::string> parts = parts_of(view);
    findings.facts.push_back(fmt::format("view: angle {:g}{}{}", glm::degrees(view.turtle.angle),
                                         parts.empty() ? "" : ", ", fmt::join(parts, ", ")));
}

}  // namespace espalier::simulation
