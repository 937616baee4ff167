#include "environment/light/rays/ray_program.h"

#include "espalier/base/math.h"

#include "base/text.h"
#include "environment/exchange/parameter_file.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::environment {
namespace {

using std::numbers::pi;

constexpr double most_paths = 1U << 27;
constexpr std::size_t most_materials = 32;
const std::initializer_list<const char*> yes{"yes", "on", "true"}, no{"no", "off", "false"};

const std::vector<std::string> quasi_keys{"remove objects",
                                          "rays from objects",
                                          "spectrum samples",
                                          "local light model",
                                          "maximum depth",
                                          "number of runs",
                                          "one ray per spectrum",
                                          "ignore direct light",
                                          "return variance",
                                          "output file",
                                          "material parameter",
                                          "source spectrum",
                                          "leaf material (top)",
                                          "leaf material (bottom)",
                                          "material",
                                          "light source",
                                          "russian roulette",
                                          "grid size",
                                          "sampling method",
                                          "location",
                                          "weather",
                                          "growth period",
                                          "surface",
                                          "number of rays",
                                          "julian day",
                                          "sky file",
                                          "return type",
                                          "light source file",
                                          "visualization",
                                          "cylinder sides"};

const std::vector<std::string> older_keys{"domain size",
                                          "position",
                                          "grid size",
                                          "seed",
                                          "obstacles",
                                          "periodic canopy",
                                          "remove objects",
                                          "maximum depth",
                                          "ray density",
                                          "leaf material (top)",
                                          "leaf material (bottom)",
                                          "material",
                                          "Russian roulette",
                                          "reflectance model",
                                          "spectrum samples",
                                          "source spectrum",
                                          "sky file",
                                          "rays from objects",
                                          "one ray per spectrum",
                                          "material parameter",
                                          "stratified sampling",
                                          "number of runs",
                                          "no direct light",
                                          "version",
                                          "light source"};

[[noreturn]] void refuse(const ParameterFile& file, const std::string& key, const std::string& message) {
    throw UserError(file.place(key), fmt::format("'{}' {}", key, message));
}

/// Hits of a ray; below 0: as many as the programs know.
std::uint32_t depth_of(ParameterFile& file, std::int64_t fallback) {
    constexpr std::int64_t most = 1000;
    const std::int64_t depth = file.whole("maximum depth", fallback, Range::between(-1, 1e9));
    return static_cast<std::uint32_t>(depth < 0 ? most : std::min(depth, most));
}

/// The r and t of one side in each band, of lines `r nr t nt n`.
using Side = std::vector<SideOptics>;

Side side_of(const std::vector<double>& numbers) {
    Side side;
    for (std::size_t at = 0; at + 4 < numbers.size(); at += 5) {
        const double reflected = std::clamp(numbers[at], 0.0, 1.0);
        side.push_back({reflected, std::clamp(numbers[at + 2], 0.0, 1 - reflected)});
    }
    return side;
}

/// A table of `Optics` with a material for each pair of sides, whose colour counts them.
Optics optics_of(const std::vector<Side>& sides, std::size_t bands) {
    std::string text;
    for (std::size_t b = 0; b < bands; ++b) {
        text += fmt::format("bands.w{} = {{ leaf = [0, 0], stem = 0, soil = 0, share = 1 }}\n", b);
    }
    for (std::size_t top = 0; top < sides.size(); ++top) {
        for (std::size_t bottom = 0; bottom < sides.size(); ++bottom) {
            text += fmt::format("[[materials]]\nname = \"{}, {}\"\ncolours = [{}]\n", top, bottom,
                                top * sides.size() + bottom);
            for (std::size_t b = 0; b < bands; ++b) {
                const SideOptics &front = sides[top][b], &back = sides[bottom][b];
                text += fmt::format("w{0} = [{1}, {2}]\nw{0}_back = [{3}, {4}]\n", b, format_exact(front.reflectance),
                                    format_exact(front.transmittance), format_exact(back.reflectance),
                                    format_exact(back.transmittance));
            }
        }
    }
    return Optics(Settings::parse_toml(text, "materials"));
}

}  // namespace

RayProgram::RayProgram(const Settings& settings, const EnvironmentContext& context) : warnings_(context.warnings) {
    const std::string program = settings.choice_or("program", "QuasiMC", {"QuasiMC", "MonteCarlo", "radiosity"});
    const bool is_quasi = program == "QuasiMC";
    ParameterFile file(settings, context, is_quasi ? quasi_keys : older_keys, {is_quasi, is_quasi, true});
    read_common(file);
    if (is_quasi) {
        read_quasi(file);
    } else {
        read_older(file, program == "radiosity");
    }
}

void RayProgram::note(const ParameterFile& file, const std::string& key, const std::string& message) const {
    if (!warnings_ || !file.has(key)) return;
    warnings_->push_back({Diagnostic::Severity::warning, file.place(key), fmt::format("'{}' {}", key, message)});
}

void RayProgram::read_common(ParameterFile& file) {
    read_spectrum(file);
    returned_.assign(bands(), 'F');
    if (!file.flag("remove objects", true, yes, no)) {
        refuse(file, "remove objects",
               "keeps the objects of earlier steps, which is not done here: let them ask again");
    }
    const std::string from_objects = file.text("rays from objects", "no");
    if (!from_objects.starts_with("no") && !from_objects.starts_with("off")) {
        refuse(file, "rays from objects",
               "makes sensors of objects, which is not done here: see the sensors of ray-light");
    }
    if (!file.text("sky file", "").empty()) {
        refuse(file, "sky file", "is not read: give 'light source' lines, as many as the sky has directions");
    }
    file.flag("one ray per spectrum", true, yes, no);
    material_parameter_ = static_cast<std::size_t>(file.whole("material parameter", 0, Range::between(0, 100)));
    runs_ = file.number("number of runs", 1, Range::between(1, most_paths));
    file.numbers("grid size", {1, 1, 1}, Range::between(0, 1e9));  // rays are exact without one
}

void RayProgram::read_spectrum(ParameterFile& file) {
    const auto samples =
        static_cast<std::size_t>(file.whole("spectrum samples", 1, Range::between(1, static_cast<double>(most_bands))));
    weights_.assign(samples, 1);
    const auto spectra = file.repeated("source spectrum", 2 * samples, 2 * samples);
    if (spectra.empty()) return;
    for (std::size_t b = 0; b < samples; ++b) {
        weights_[b] = spectra.back()[2 * b + 1];
        if (!(weights_[b] >= 0 && std::isfinite(weights_[b]))) refuse(file, "source spectrum", "has a weight below 0");
    }
}

/// `usual`: a line of the program's own, for a leaf's top without one.
void RayProgram::read_materials(ParameterFile& file, const std::vector<double>& usual) {
    const std::size_t numbers = 5 * bands();
    std::vector<double> known;
    for (std::size_t b = 0; b < bands(); ++b) known.insert(known.end(), usual.begin(), usual.end());
    std::vector<Side> sides;
    const auto tops = file.repeated("leaf material (top)", numbers, numbers);
    const auto bottoms = file.repeated("leaf material (bottom)", numbers, numbers);
    sides.push_back(side_of(tops.empty() ? known : tops.back()));
    has_bottom_ = !bottoms.empty();
    if (has_bottom_) sides.push_back(side_of(bottoms.back()));
    for (const auto& more : file.repeated("material", numbers, numbers)) sides.push_back(side_of(more));
    if (sides.size() > most_materials) refuse(file, "material", fmt::format("lines are more than {}", most_materials));
    materials_ = sides.size();
    optics_.emplace(optics_of(sides, bands()));
}

/// `sense`: 1 where directions lead to the light, -1 where light travels along them.
void RayProgram::read_lights(ParameterFile& file, double sense) {
    double sum = 0;
    for (const std::vector<double>& source : file.repeated("light source", 3, 4)) {
        const glm::dvec3 given(source[0], source[1], source[2]);
        const double weight = source.size() > 3 ? source[3] : 1;
        if (!(glm::length(given) > 0 && std::isfinite(glm::length(given)) && weight >= 0)) {
            refuse(file, "light source", "needs a direction that is not 0 and a weight that is not negative");
        }
        light_.beams.push_back({sense * glm::normalize(given), weight});
        sum += weight;
    }
    if (!light_.beams.empty() && !(sum > 0)) refuse(file, "light source", "has no weight above 0");
    for (LightBeam& beam : light_.beams) beam.photons /= sum;
}

void RayProgram::read_quasi(ParameterFile& file) {
    read_materials(file, {0.25, 10, 0.25, 10, 1});
    depth_ = depth_of(file, 5);
    only_scattered_ = file.flag("ignore direct light", false, yes, no);
    rays_ = file.number("number of rays", 1, Range::between(1, most_paths));
    evenly_ = file.text("sampling method", "monte carlo") != "monte carlo";
    cylinder_sides_ = static_cast<int>(file.whole("cylinder sides", 4, Range::between(3, 128)));
    const std::vector<std::string> letters = words_of(file.text("return type", "F"), " \t,;");
    for (std::size_t b = 0; b < std::min(letters.size(), bands()); ++b) {
        const char letter = letters[b][0];
        if (letters[b].size() != 1 || std::string("FDUL").find(letter) == std::string::npos) {
            note(file, "return type", fmt::format("'{}' is none of F, D, U and L: F is answered", letters[b]));
        } else {
            returned_[b] = letter;
        }
    }
    if (!file.text("light source file", "").empty()) {
        refuse(file, "light source file", "is not read: give its lights as 'light source' lines");
    }
    file.text("russian roulette", "");
    file.text("visualization", "");
    if (file.text("local light model", "Lambertian") != "Lambertian") {
        note(file, "local light model", "has no effect: leaves scatter as Lambert's law says");
    }
    for (const char* key : {"return variance", "output file"}) {
        const std::string value = file.text(key, "no");
        if (!value.starts_with("no")) note(file, key, "has no effect: no table is written");
    }
    file.text("surface", "");
    note(file, "surface", "has no effect: modules S draw what the model's homomorphism or its view file says");
    read_lights(file, -1);
    read_sky(file);
    if (light_.beams.empty()) light_.beams.push_back({{0, 1, 0}, 1});
    light_.on_ground = 1;
}

void RayProgram::read_sky(ParameterFile& file) {
    QuasiSky sky;
    bool asks = false;
    for (const char* key : {"location", "weather", "growth period", "julian day"}) asks = asks || file.has(key);
    const std::vector<double> location = file.numbers("location", {0, 0}, Range::between(-180, 180)),
                              weather = file.numbers("weather", {1, 2.45}, Range::between(0, 100)),
                              hours = file.numbers("growth period", {0, 24}, Range::between(0, 24));
    sky.latitude = location[0];
    sky.longitude = location[1];
    sky.is_clear = weather[0] > 0;
    sky.turbidity = weather[1];
    sky.from = hours[0];
    sky.to = hours[1];
    sky.day = static_cast<double>(file.whole("julian day", 172, Range::between(1, 366)));
    if (!asks || !light_.beams.empty()) return;
    light_.beams = sky.beams();
    if (!light_.beams.empty()) return;
    refuse(file, "growth period", "has no hour in which the sun is above the horizon");
}

void RayProgram::read_older(ParameterFile& file, bool is_radiosity) {
    read_materials(file, {0.35, 0, 0.55, 0, 1.4});
    depth_ = depth_of(file, 3);
    density_ = file.number("ray density", 500, Range::between(0, 1e9));
    only_scattered_ = file.flag("no direct light", false, yes, no);
    const std::vector<double> size = file.numbers("domain size", {2, 2, 2}, Range::positive()),
                              corner = file.numbers("position", {-1, -1, -1});
    const glm::dvec3 lower(corner[0], corner[1], corner[2]);
    domain_ = Box{lower, lower + glm::dvec3(size[0], size[1], size[2])};
    periodic_ = file.flag("periodic canopy", false, yes, no);
    if (!file.text("obstacles", "").empty()) {
        refuse(file, "obstacles", "are not read: draw them by modules that ask with a first parameter below 0");
    }
    for (const char* key : {"seed", "Russian roulette", "stratified sampling", "version"}) file.text(key, "");
    const std::string model = file.text("reflectance model", "parcinopy");
    if (model != "parcinopy") note(file, "reflectance model", "has no effect: leaves scatter as Lambert's law says");
    if (is_radiosity || runs_ > 1)
        note(file, "number of runs", "has no effect but on the number of rays: no variance is answered");
    read_lights(file, 1);
    if (light_.beams.empty()) light_.beams.push_back({{0, 1, 0}, 1});
    if (periodic_ && std::any_of(light_.beams.begin(), light_.beams.end(),
                                 [](const LightBeam& beam) { return beam.photons > 0 && beam.towards.y < 1e-3; })) {
        refuse(file, "light source", "must come from above over a periodic canopy");
    }
    light_.on_ground = 1;
}

std::uint16_t RayProgram::material(double top, double bottom) const {
    const auto is_known = [&](double number) { return number >= 0 && number < static_cast<double>(materials_); };
    if (!is_known(top) || !is_known(bottom)) {
        throw RunError(
            fmt::format("a module names the materials {:g} and {:g}, but the parameter file has those from 0 "
                        "to {}",
                        top, bottom, materials_ - 1));
    }
    const std::size_t pair = static_cast<std::size_t>(top) * materials_ + static_cast<std::size_t>(bottom);
    return *optics_->material_of(LitKind::leaf, static_cast<std::uint16_t>(pair));
}

std::uint32_t RayProgram::paths(double square) const {
    constexpr double fewest = 1024;  // QuasiMC's own default is one ray
    const double rays = runs_ * (density_ > 0 ? density_ * square : rays_);
    return static_cast<std::uint32_t>(std::clamp(rays, fewest, most_paths));
}

std::vector<LightBeam> QuasiSky::beams() const {
    constexpr int cells = 32;
    const double declination = 0.4093 * math::sin(2 * pi * (day - 81) / 368);
    const auto [sine, cosine] = math::sine_and_cosine(glm::radians(latitude));
    const auto [sine_declination, cosine_declination] = math::sine_and_cosine(declination);
    std::vector<glm::dvec3> towards;
    for (int i = 0; i < cells * cells; ++i) {
        const auto [up, level] = math::sine_and_cosine(pi / 2 * (i / cells + 0.5) / cells);
        const auto [east, north] = math::sine_and_cosine(2 * pi * (i % cells + 0.5) / cells);
        towards.emplace_back(level * east, up, -level * north);
    }
    std::vector<double> intensities(towards.size(), 0);
    const int steps = static_cast<int>(std::ceil((to - from) / 0.1 - 1e-9));
    for (int step = 0; step < steps; ++step) {
        const double solar = from + 0.1 * step + (longitude - 12 * std::round(longitude / 12)) / 15;
        const auto [sine_hour, cosine_hour] = math::sine_and_cosine(pi / 12 * (solar - 12));
        const glm::dvec3 sun(-cosine_declination * sine_hour,
                             sine * sine_declination + cosine * cosine_declination * cosine_hour,
                             -(cosine * sine_declination - sine * cosine_declination * cosine_hour));
        if (sun.y <= 0) continue;
        const double zenith = math::acos(std::min(1.0, sun.y));
        const auto circumsolar = [](double angle, double cosine_of_angle) {
            return 0.91 + 10 * math::exp(-3 * angle) + 0.45 * cosine_of_angle * cosine_of_angle;
        };
        const double luminance =
            (1.376 * turbidity - 1.81) * sun.y / std::sqrt(std::max(1e-12, 1 - sun.y * sun.y)) + 0.38;
        for (std::size_t i = 0; i < towards.size(); ++i) {
            const double along = std::clamp(glm::dot(towards[i], sun), -1.0, 1.0), up = towards[i].y;
            intensities[i] += !is_clear ? (1 + 2 * up) / 3
                                        : std::max(0.0, luminance) * circumsolar(math::acos(along), along) *
                                              (1 - math::exp(-0.32 / up)) /
                                              (circumsolar(zenith, sun.y) * (1 - math::exp(-0.32)));
        }
    }
    double sum = 0;
    for (const double intensity : intensities) sum += intensity * intensity;
    std::vector<LightBeam> beams;
    for (std::size_t i = 0; i < towards.size() && sum > 0; ++i) {
        beams.push_back({towards[i], intensities[i] * intensities[i] / sum});
    }
    return beams;
}

}  // namespace espalier::environment
