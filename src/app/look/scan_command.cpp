// scan: a recorded run as a laser scanner or a depth camera sees it.
#include "espalier/archive/recorded_run.h"
#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "app/command.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/run_command.h"
#include "archive/chosen_frames.h"
#include "base/csv_file.h"
#include "base/folder.h"
#include "base/json_text.h"
#include "base/number.h"
#include "picture_options.h"
#include "study/scan/leaf_density.h"
#include "study/scan/point_files.h"
#include "study/scan/scan_plan.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

/// "x,y,z" or "x,z" of an option.
std::vector<double> numbers_of(const std::string& option, const std::string& text, std::size_t count) {
    std::vector<double> numbers;
    for (const std::string& cell : csv_cells(text)) {
        const auto number = finite_number(cell);
        if (!number) break;
        numbers.push_back(*number);
    }
    if (numbers.size() == count) return numbers;
    throw UserError(fmt::format("{} {}: expected {} numbers between commas, m", option, text, count));
}

glm::dvec3 place_of(const std::string& option, const std::string& text) {
    const std::vector<double> numbers = numbers_of(option, text, 3);
    return {numbers[0], numbers[1], numbers[2]};
}

class Scan final : public Command {
public:
    explicit Scan(CLI::App& program)
        : Command(program, "scan", "a recorded run as a laser scanner or a depth camera sees it: labelled points") {
        app().add_option("run", run_, "the folder of a run")->required();
        app().add_option("--output", output_, "the points: .csv, .xyz, .ply or .vtp; default: RUN/scan.ply");
        app().add_option("--step", step_, std::string(frame_option_help) + "; one frame")->capture_default_str();
        app()
            .add_option(
                "--columns", points_.columns,
                "columns of the points: x,y,z,distance,intensity,return,returns,beam,plant,organ,identity,symbol,"
                "order,age, which are the default, echo_width,time,zenith,azimuth; or helios++, those of its .xyz "
                "files")
            ->delimiter(',');
        app().add_option("--up", up_, "the axis that points upwards in the file")->check(CLI::IsMember({"y", "z"}));
        add_instruments();
        add_beams();
        app()
            .add_option("--density", voxel_, "edge of voxels, m: estimate leaf area density in them, beside the truth")
            ->check(above_zero());
        app()
            .add_option("--projection", projection_, "mean projection of a unit of leaf area; 0.5: leaves at random")
            ->check(CLI::Range(0.01, 1.0))
            ->capture_default_str();
        app().add_flag("--quiet", quiet_, "print errors only");
        add_json_flag("print the numbers of beams and points as JSON");
        app().footer(R"(Instruments: --at places scanners on tripods, --fly one that flies, --eye a depth camera.
Examples:
  espalier scan output/two-trees --at 6,1.5,6 --at=-6,1.5,6 --output scan.ply
  espalier scan output/two-trees --fly=-10,40,0:10,40,0 --pulses 50 --divergence 0.03 --rays 7
  espalier scan output/two-trees --eye 0,2,12 --target 0,2,0 --size 640x480 --distance-noise 0.005 --output depth.csv
  espalier scan output/two-trees --at 6,1.5,6 --angle 0.5 --density 0.5
docs/scanning.md tells what each point has, and how the density is estimated.)");
    }

    int run() override {
        points_.up = up_[0];
        const fs::path output = output_.empty() ? run_ / "scan.ply" : output_;
        study::require_point_file(output, points_);
        const std::vector<study::Beam> beams = beams_of();
        const RecordedRun run(run_);
        const std::vector<const RecordedFrame*> frames = chosen_frames(run, step_);
        if (frames.size() != 1) throw UserError(fmt::format("--step {}: a scan has one frame", step_));
        const FrameGeometry geometry = run.geometry(*frames.front());
        const study::ScannedPlants plants(geometry, sides_, no_ground_ ? std::nullopt : std::optional(ground_));
        const InterruptibleRun interruptible(quiet_);
        const std::vector<study::ScanPoint> points =
            scan(plants, beams, scan_, [](std::size_t) { return InterruptibleRun::interrupted(); });
        if (InterruptibleRun::interrupted()) return exit_code::interrupted;
        study::PointNames names{{}, geometry.symbol_names, frames.front()->step};
        for (const RecordedPlant& plant : run.plants()) names.plants.push_back(plant.name);
        if (output.has_parent_path()) make_folder(output.parent_path());
        write_points(points, plants, names, points_, output);
        std::optional<study::DensityResult> density;
        if (voxel_ > 0) {
            density = leaf_density(plants, beams, scan_.range, voxel_, projection_);
            write_text(fs::path(output).replace_extension() += "-density.csv", table_of(*density));
        }
        print(beams.size(), points, output, density);
        return exit_code::done;
    }

private:
    void add_instruments() {
        const char* const tripod = "A scanner on a tripod";
        app()
            .add_option("--at", places_, "X,Y,Z of a scanner, m; may be repeated")
            ->group(tripod)
            ->allow_extra_args(false);
        app()
            .add_option("--angle", tripod_.step, "degrees between beams")
            ->check(CLI::Range(0.001, 30.0))
            ->capture_default_str()
            ->group(tripod);
        app().add_option("--elevations", elevations_, "LOW:HIGH, degrees; default: -60:90")->group(tripod);
        app()
            .add_option("--azimuths", azimuths_, "FROM:TO, degrees from -z towards +x; default: -180:180")
            ->group(tripod);
        const char* const flying = "One that flies";
        app().add_option("--fly", path_, "X,Y,Z:X,Y,Z from where to where, m, in a straight line")->group(flying);
        app()
            .add_option("--pulses", flying_.density, "beams in a square metre of level ground at height 0")
            ->check(CLI::Range(1e-4, 1e6))
            ->capture_default_str()
            ->group(flying);
        app()
            .add_option("--swing", flying_.half_angle, "degrees to each side")
            ->check(CLI::Range(0.01, 85.0))
            ->capture_default_str()
            ->group(flying);
        const char* const camera = "A depth camera";
        app().add_option("--eye", eye_, "X,Y,Z of the camera, m")->group(camera);
        app().add_option("--target", target_, "X,Y,Z that it looks at, m")->capture_default_str()->group(camera);
        app()
            .add_option("--field-of-view", camera_.angle, "degrees, of the picture's height")
            ->check(CLI::Range(1.0, 170.0))
            ->capture_default_str()
            ->group(camera);
        app().add_option("--size", size_, "WIDTHxHEIGHT of its picture")->capture_default_str()->group(camera);
    }

    void add_beams() {
        const char* const beams = "Beams";
        const auto add = [&](const char* name, double& value, const char* help, double high) {
            app().add_option(name, value, help)->check(CLI::Range(0.0, high))->capture_default_str()->group(beams);
        };
        add("--range", scan_.range, "greatest distance, m", 1e6);
        add("--divergence", scan_.divergence, "full angle of a beam's cone, degrees", 10);
        app()
            .add_option("--rays", scan_.rays, "rays by which a cone is sampled; several may return several points")
            ->check(CLI::Range(1, 1000))
            ->capture_default_str()
            ->group(beams);
        add("--resolution", scan_.resolution, "distance below which two returns of a beam are one, m", 100);
        add("--distance-noise", scan_.distance_noise, "standard deviation of distances, m", 100);
        add("--angle-noise", scan_.angle_noise, "standard deviation of angles, degrees", 10);
        app()
            .add_option("--pulse-rate", scan_.pulse_rate, "beams a second, for the column time")
            ->check(CLI::Range(1.0, 1e9))
            ->capture_default_str()
            ->group(beams);
        app().add_option("--seed", scan_.seed, "seed of the noise")->capture_default_str()->group(beams);
        app()
            .add_option("--sides", sides_, "corners around an internode")
            ->check(CLI::Range(3, 64))
            ->capture_default_str()
            ->group(beams);
        app().add_option("--ground", ground_, "height of the level ground, m")->capture_default_str()->group(beams);
        app().add_flag("--no-ground", no_ground_, "without a ground")->group(beams);
    }

    static std::array<double, 2> range_of(const std::string& option, const std::string& text) {
        if (const auto range = low_and_high(text)) return *range;
        throw UserError(fmt::format("{} {}: expected LOW:HIGH, degrees", option, text));
    }

    std::vector<study::Beam> beams_of() {
        const int instruments = (places_.empty() ? 0 : 1) + (path_.empty() ? 0 : 1) + (eye_.empty() ? 0 : 1);
        if (instruments != 1) throw UserError("a scan needs one instrument: --at, --fly or --eye");
        if (!elevations_.empty()) {
            const auto [low, high] = range_of("--elevations", elevations_);
            tripod_.lowest = std::max(-90.0, low), tripod_.highest = std::min(90.0, high);
        }
        if (!azimuths_.empty()) {
            const auto [from, to] = range_of("--azimuths", azimuths_);
            tripod_.first_azimuth = from, tripod_.last_azimuth = std::min(to, from + 360);
        }
        if (!path_.empty()) return flying_beams();
        if (!eye_.empty()) return camera_beams();
        study::require_few_beams(static_cast<double>(places_.size()) * tripod_.expected_beams());
        std::vector<study::Beam> all;
        for (const std::string& place : places_) {
            tripod_.place = place_of("--at", place);
            const std::vector<study::Beam> beams = tripod_.beams();
            all.insert(all.end(), beams.begin(), beams.end());
        }
        return all;
    }

    std::vector<study::Beam> flying_beams() {
        const std::size_t colon = path_.find(':');
        if (colon == path_.npos) throw UserError(fmt::format("--fly {}: expected X,Y,Z:X,Y,Z", path_));
        flying_.from = place_of("--fly", path_.substr(0, colon));
        flying_.to = place_of("--fly", path_.substr(colon + 1));
        if (std::min(flying_.from.y, flying_.to.y) <= 0)
            throw UserError("--fly: a scanner that flies is above height 0");
        study::require_few_beams(flying_.expected_beams());
        return flying_.beams();
    }

    std::vector<study::Beam> camera_beams() {
        const PictureSize size = picture_size("--size", size_);
        camera_.eye = place_of("--eye", eye_);
        camera_.target = place_of("--target", target_);
        if (camera_.eye == camera_.target) throw UserError("--eye and --target are one place");
        camera_.width = static_cast<std::size_t>(size.width);
        camera_.height = static_cast<std::size_t>(size.height);
        study::require_few_beams(static_cast<double>(size.width) * size.height);
        return camera_.beams();
    }

    static std::string table_of(const study::DensityResult& density) {
        std::string text = "x,y,z,beams,contacts,path,estimated,true\n";
        for (const study::VoxelDensity& one : density.voxels) {
            text += fmt::format("{},{},{},{},{},{},{},{}\n", csv_number(one.middle.x), csv_number(one.middle.y),
                                csv_number(one.middle.z), one.entered, one.met, csv_number(one.path),
                                csv_number(one.estimated), csv_number(one.real));
        }
        return text;
    }

    void print(std::size_t beams, const std::vector<study::ScanPoint>& points, const fs::path& output,
               const std::optional<study::DensityResult>& density) const {
        std::size_t ground = 0;
        for (const study::ScanPoint& point : points) ground += point.organ ? 0 : 1;
        if (wants_json()) {
            nlohmann::ordered_json json{
                {"beams", beams}, {"points", points.size()}, {"ground", ground}, {"file", output.string()}};
            if (density) {
                json["leaf_area"] = {{"estimated", density->estimated_area},
                                     {"true", density->real_area},
                                     {"unseen", density->unseen_area},
                                     {"gap_fraction", density->gap_fraction}};
            }
            return fmt::print("{}\n", json_text(json));
        }
        if (quiet_) return;
        fmt::print("{}: {} points of {} beams, {} of them on the ground\n", output.string(), grouped(points.size()),
                   grouped(beams), grouped(ground));
        if (!density) return;
        fmt::print(
            "leaf area {:.4g} m2 by contacts, {:.4g} m2 in truth ({:+.1f} %); {:.4g} m2 where no beam came; gap "
            "fraction "
            "{:.3g}\n",
            density->estimated_area, density->real_area, 100 * (density->estimated_area / density->real_area - 1),
            density->unseen_area, density->gap_fraction);
    }

    fs::path run_, output_;
    std::string step_ = "last", up_ = "y", path_, eye_, target_ = "0,1,0", size_ = "640x480", elevations_, azimuths_;
    std::vector<std::string> places_;
    study::PointFileOptions points_;
    study::ScanOptions scan_;
    study::TripodScanner tripod_;
    study::FlyingScanner flying_;
    study::DepthCamera camera_;
    double voxel_ = 0, projection_ = 0.5, ground_ = 0;
    int sides_ = 12;
    bool no_ground_ = false, quiet_ = false;
};

const RegisteredCommand<Scan> scan_entry{44};

}  // namespace
}  // namespace espalier::app
