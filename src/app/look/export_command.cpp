#include "espalier/base/error.h"
#include "espalier/formats/exporter.h"

#include "app/command.h"
#include "archive/chosen_frames.h"
#include "base/json_text.h"
#include "base/text.h"
#include "mesh_file_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace espalier::app {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> known_formats() {
    std::vector<std::string> names;
    for (const auto& type : registered<ExporterType>()) names.push_back(type.first);
    return names;
}

void print_file(const ExportedFile& file) {
    std::string line = file.path.string();
    if (file.vertices > 0) line += fmt::format(": {} vertices, {} triangles", file.vertices, file.triangles);
    if (!file.noun.empty()) line += fmt::format("{} {} {}", file.vertices > 0 ? "," : ":", file.elements, file.noun);
    fmt::print("{}\n", line);
}

Json json_of(const ExportedFile& file) {
    Json json = {{"path", file.path.string()}, {"vertices", file.vertices}, {"triangles", file.triangles}};
    if (!file.noun.empty()) json[file.noun] = file.elements;
    return json;
}

class ExportCommand final : public Command {
public:
    explicit ExportCommand(CLI::App& program)
        : Command(program, "export", "write a recorded run as files of other programs"), mesh_(app(), 8) {
        app().add_option("run", folder_, "the folder of a run")->required();
        app()
            .add_option("--format", formats_, fmt::format("one or several of {}", fmt::join(known_formats(), ", ")))
            ->delimiter(',')
            ->allow_extra_args(false);  // or it would take the run's folder for a format
        app().add_option("--step", step_, frame_option_help)->capture_default_str();
        app().add_option("--output", output_,
                         "a folder, or a file whose extension selects the format; default: RUN/export");
        app().add_option("--plant", plant_, "draw or write only this plant, by its name in the scene");
        app()
            .add_option("--rate", rate_, "gltf, usd: steps per second of growth as an animation")
            ->check(CLI::Range(0.01, 1000.0))
            ->capture_default_str();
        grouped_option_ =
            app().add_flag("--grouped,!--no-grouped", grouped_,
                           "gltf: in animations, what is born and dies at the same steps is one object, or none is; "
                           "default: from 5,000 internodes and organs on");
        app().add_flag(
            "--voxel-corners", voxel_corners_,
            "vdb: a voxel stands where its lower corner is, as Blender draws it; default: where its centre is");
        app().add_flag("--keep", keep_, "never replace a file: a new one is numbered, as in tree-2.obj");
        app().add_flag("--quiet", quiet_, "print errors only");
        add_json_flag("print the names of the files as JSON");
        app().footer(R"(The run is not grown again. Lengths are in metres. Files appear complete or not at all.
Examples:
  espalier export output/two-trees --format obj                      the last frame, for any 3D program
  espalier export output/two-trees --output trees.obj                the same, in this file
  espalier export output/two-trees --format gltf --step all          the growth as an animation, in one file
  espalier export output/two-trees --format usd --step 0:274:8       every eighth step
  espalier export output/two-trees --format stl --plant left --sides 16 --up z
  espalier export output/two-roots --format rsml,mtg,csv
  espalier export output/forest --format ply --simplify 0.002        fewer triangles; their number is printed
  espalier export output/two-trees --format obj --triangles 5000     so many, to a tenth
  espalier export output/two-trees --format gltf --split 65535       meshes for programs with indices of 16 bits
`espalier list exporters` describes the content of each format.)");
    }

    int run() override {
        const RecordedRun recorded(folder_);
        const std::vector<const RecordedFrame*> frames = chosen_frames(recorded, step_);
        const Target target = this->target();
        Json files = Json::array();
        const auto report = [&](const ExportedFile& file) {
            if (wants_json()) {
                files.push_back(json_of(file));
            } else if (!quiet_) {
                print_file(file);
            }
            if (!quiet_ && !file.hint.empty()) fmt::print(stderr, "{}\n", file.hint);
        };
        ExportJob job{recorded, frames, {}, target.folder, report, target.name};
        mesh_.put_into(job);
        if (!plant_.empty()) job.options.plant = recorded.plant(plant_);
        job.steps_per_second = rate_;
        if (grouped_option_->count() > 0) job.grouped = grouped_;
        job.voxel_corners = voxel_corners_;
        if (!quiet_) name_unused(target.formats);
        job.keep = keep_;
        export_run(job, target.formats);
        if (wants_json()) {
            fmt::print("{}\n", json_text(Json{{"files", files}}));
        }
        return exit_code::done;
    }

private:
    struct Target {
        std::filesystem::path folder;
        std::string name;
        std::vector<std::string> formats;
    };

    /// Options that none of the formats heeds.
    void name_unused(const std::vector<std::string>& formats) {
        const std::vector<std::pair<std::string, std::vector<std::string>>> heeded_by{
            {"--rate", {"gltf", "usd"}},
            {"--grouped", {"gltf"}},
            {"--voxel-corners", {"vdb"}},
            {"--instances", {"gltf", "usd"}},
            {"--mesh-axes", {"usd"}},
            {"--split", {"obj", "gltf", "ply", "stl"}},
            {"--sides", {"obj", "gltf", "ply", "stl", "usd"}}};
        for (const auto& [option, heeding] : heeded_by) {
            const bool is_heeded =
                std::any_of(formats.begin(), formats.end(), [&formats = heeding](const auto& format) {
                    return std::find(formats.begin(), formats.end(), format) != formats.end();
                });
            if (app().count(option) == 0 || is_heeded) continue;
            fmt::print(stderr, "{} is for {}: nothing here heeds it\n", option, fmt::join(heeding, ", "));
        }
    }

    Target target() const {
        const std::string told = format_of_extension(output_.extension().string());
        const bool is_file = !told.empty() && !std::filesystem::is_directory(output_) &&
                             (formats_.empty() || formats_ == std::vector{told});
        if (is_file) return {output_.parent_path(), output_.stem().string(), {told}};
        if (formats_.empty()) {
            throw UserError(
                fmt::format("no format given: use --format {}, or an --output with an extension such as plant.obj",
                            fmt::join(known_formats(), ", ")));
        }
        return {output_.empty() ? folder_ / "export" : output_, "", formats_};
    }

    std::filesystem::path folder_, output_;
    std::vector<std::string> formats_;
    std::string step_ = "last", plant_;
    double rate_ = 24;
    CLI::Option* grouped_option_ = nullptr;
    bool grouped_ = false, voxel_corners_ = false, keep_ = false, quiet_ = false;
    MeshFileOptions mesh_;
};

const RegisteredCommand<ExportCommand> export_entry{42};

}  // namespace
}  // namespace espalier::app
