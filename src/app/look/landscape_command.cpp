// landscape: many recorded plants on a terrain, drawn and exported.
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/picture/render.h"

#include "app/command.h"
#include "app/options.h"
#include "app/progress.h"
#include "base/folder.h"
#include "base/json_text.h"
#include "formats/landscape_file.h"
#include "picture_options.h"
#include "study/landscape/landscape_scene.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Throws RunError when the time is over.
class Deadline {
public:
    explicit Deadline(double seconds) : seconds_(seconds) {}

    void check(const char* doing) const {
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
        if (seconds_ <= 0 || passed.count() <= seconds_) return;
        throw RunError(fmt::format("--timeout {:.6g}: the time was over while {}", seconds_, doing));
    }

private:
    double seconds_;  ///< 0: any
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class LandscapeCommand final : public Command {
public:
    explicit LandscapeCommand(CLI::App& program)
        : Command(program, "landscape", "draw or export a landscape of many recorded plants"), sets_(app()) {
        app().add_option("file", file_, "the landscape, a .toml file")->required();
        app()
            .add_option("--output", output_,
                        "the picture, a .png file, or the landscape as a .glb or .usda file; may be repeated")
            ->required()
            ->allow_extra_args(false);
        app().add_option("--size", size_, "WIDTHxHEIGHT of the picture in pixels")->capture_default_str();
        app().add_option("--cards", cards_, "a folder for the pictures of the cards");
        app().add_option("--memory", memory_, "memory that the meshes may take, such as 2G; default: any");
        app()
            .add_option("--timeout", timeout_, "seconds after which the command gives up; default: never")
            ->check(above_zero());
        app().add_flag("--quiet", quiet_, "print errors only");
        add_json_flag("print the numbers of plants and triangles as JSON");
        app().footer(R"(Near plants are drawn with all their detail, farther ones with less, the farthest as cards.
Examples:
  espalier landscape environments/landscapes/hills.toml --output landscape.png
  espalier landscape environments/landscapes/hills.toml --output landscape.glb --cards cards
  espalier landscape environments/landscapes/hills.toml --output landscape.usda
  espalier landscape environments/landscapes/hills.toml --output near.png --set camera.eye=[0,2,40] --size 800x600)");
    }

    int run() override {
        for (const fs::path& output : outputs()) require_extension(output);
        const PictureSize size = picture_size("--size", size_);
        const Deadline deadline(timeout_);
        study::LandscapeScene scene = study::read_landscape(file_, sets_.overrides());
        scene.look.size = size;
        if (!memory_.empty()) scene.look.memory = size_in_bytes(memory_, "--memory");
        deadline.check("reading the plants");
        const auto cards = cards_of(scene, deadline);
        for (const fs::path& output : outputs()) write(scene, cards, output, deadline);
        if (!cards_.empty()) write_cards(scene, cards);
        print(scene.landscape);
        return exit_code::done;
    }

private:
    using Cards = std::vector<std::vector<CardPicture>>;

    std::vector<fs::path> outputs() const { return {output_.begin(), output_.end()}; }

    static void require_extension(const fs::path& output) {
        if (output.extension() == ".png" || is_landscape_file(output)) return;
        throw UserError(fmt::format("--output {}: expected the name of a .png, .glb or .usda file", output.string()));
    }

    /// Makes the cards of the species that have any: as they look from the eye, from the middle of the terrain.
    Cards cards_of(const study::LandscapeScene& scene, const Deadline& deadline) const {
        const PlantedLandscape& landscape = scene.landscape;
        const glm::dvec3 towards = scene.view.eye - scene.view.target;
        Cards cards(landscape.species.size());
        for (std::size_t i = 0; i < cards.size(); ++i) {
            if (landscape.count(i, PlantedPlant::card_level) == 0) continue;
            cards[i] =
                card_pictures(landscape.species[i], towards, scene.light, scene.card_pixels, scene.look.texture_of);
            deadline.check("drawing the cards");
        }
        return cards;
    }

    static void write(const study::LandscapeScene& scene, const Cards& cards, const fs::path& output,
                      const Deadline& deadline) {
        if (output.has_parent_path()) make_folder(output.parent_path());
        if (output.extension() == ".png") {
            const OpacityPicture picture =
                landscape_picture(scene.landscape, cards, scene.view, scene.light, scene.look,
                                  [&](double) { deadline.check("drawing the landscape"); });
            write_text(output, png_bytes(picture));
            return;
        }
        std::vector<std::vector<CardImage>> images;
        for (const auto& of_species : cards) {
            auto& to = images.emplace_back();
            for (const CardPicture& card : of_species) to.push_back({png_bytes(*card.picture), card.frame});
        }
        write_landscape({scene.landscape, images, scene.view.eye, scene.look.ground, scene.first_species}, output);
    }

    void write_cards(const study::LandscapeScene& scene, const Cards& cards) const {
        make_folder(cards_);
        for (std::size_t i = 0; i < cards.size(); ++i) {
            for (std::size_t turn = 0; turn < cards[i].size(); ++turn) {
                const std::string name = fmt::format("{}-{}.png", scene.landscape.species[i].name, turn);
                write_text(cards_ / name, png_bytes(*cards[i][turn].picture));
            }
        }
    }

    void print(const PlantedLandscape& landscape) const {
        Json rows = Json::array();
        for (std::size_t i = 0; i < landscape.species.size(); ++i) {
            const LandscapeSpecies& species = landscape.species[i];
            Json levels = Json::array();
            for (std::size_t level = 0; level < species.levels.size(); ++level) {
                levels.push_back({{"plants", landscape.count(i, static_cast<std::uint16_t>(level))},
                                  {"triangles", species.levels[level].triangles.size()}});
            }
            levels.push_back({{"plants", landscape.count(i, PlantedPlant::card_level)}, {"triangles", 2}});
            rows.push_back({{"species", species.name}, {"levels", levels}});
        }
        if (wants_json()) {
            const Json json{{"plants", landscape.plants.size()},
                            {"outside", landscape.outside},
                            {"triangles", landscape.triangles()},
                            {"triangles_in_full", landscape.triangles_in_full()},
                            {"species", rows}};
            fmt::print("{}\n", json_text(json));
            return;
        }
        if (quiet_) return;
        for (const Json& row : rows) {
            std::string line = row["species"].get<std::string>() + ":";
            for (const Json& level : row["levels"]) {
                line += fmt::format(" {} x {}", grouped(level["plants"]), grouped(level["triangles"]));
            }
            fmt::print("{} triangles\n", line);
        }
        fmt::print("{} plants, {} triangles; with all their detail {}\n", grouped(landscape.plants.size()),
                   grouped(landscape.triangles()), grouped(landscape.triangles_in_full()));
        if (landscape.outside > 0) {
            fmt::print(stderr, "{} plants of the stand lie outside the terrain and were left out\n",
                       grouped(landscape.outside));
        }
    }

    SetOptions sets_;
    fs::path file_, cards_;
    std::vector<std::string> output_;
    std::string memory_, size_ = "1200x675";
    double timeout_ = 0;
    bool quiet_ = false;
};

const RegisteredCommand<LandscapeCommand> landscape_entry{33};

}  // namespace
}  // namespace espalier::app
