#include "espalier/simulation/side_file_check.h"

#include "espalier/geometry/palette.h"

#include "animation_file.h"
#include "environment_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/trigonometric.hpp>

#include <map>

namespace espalier {
namespace {

namespace fs = std::filesystem;

void add_unused(const fs::path& path, const std::vector<std::string>& unused, Findings& findings) {
    for (const std::string& setting : unused) {
        findings.facts.push_back(
            fmt::format("{}: {} (read; without meaning where there is no window)", path.string(), setting));
    }
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

using Check = void (*)(const fs::path&, Findings&);

const std::map<std::string, Check>& checks() {
    static const std::map<std::string, Check> all{{".v", check_view},
                                                  {".a", check_animation},
                                                  {".e", check_environment},
                                                  {".map", check_colours},
                                                  {".mat", check_colours}};
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
    const Shapes none;
    const Shapes& shapes = view.turtle.shapes ? *view.turtle.shapes : none;
    const std::size_t functions = view.resources ? view.resources->functions.size() : 0;
    const std::size_t curves = view.resources ? view.resources->curves.size() : 0;
    std::vector<std::string> parts{fmt::format("angle {:g}", glm::degrees(view.turtle.angle))};
    const auto count = [&](std::size_t number, const char* what) {
        if (number > 0) parts.push_back(fmt::format("{} {}{}", number, what, number == 1 ? "" : "s"));
    };
    count(view.turtle.tropisms.size(), "tropism");
    count(shapes.surfaces.size(), "surface");
    count(shapes.contours.size(), "contour");
    count(shapes.textures.size(), "texture");
    count(functions, "function");
    count(curves, "curve");
    count(view.lights.size(), "light");
    count(view.backgrounds.size(), "background");
    findings.facts.push_back(fmt::format("view: {}", fmt::join(parts, ", ")));
}

}  // namespace espalier
