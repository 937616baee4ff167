#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "app/command.h"
#include "base/folder.h"
#include "base/json_text.h"
#include "formats/leaf_texture.h"
#include "picture/palette.h"
#include "picture_options.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace espalier::app {
namespace {

class LeafTextureCommand final : public Command {
public:
    explicit LeafTextureCommand(CLI::App& program)
        : Command(program, "leaf-texture", "draw a picture of many leaves for the texture of a card") {
        app().add_option("--output", output_, "the picture, a .png file")->required();
        app()
            .add_option("--form", form_, "blobs or twig: ellipses, or leaves with veins on a twig")
            ->capture_default_str();
        app().add_option("--blobs", blobs_, "number of leaves; default: 60, of a twig 13")->check(CLI::Range(1, 10000));
        app().add_option("--colour", colour_, "colour of the leaves, as #rrggbb")->capture_default_str();
        app()
            .add_option("--variation", texture_.variation, "largest change of the brightness of a leaf, as a share")
            ->check(CLI::Range(0.0, 1.0))
            ->capture_default_str();
        app()
            .add_option("--coverage", coverage_,
                        "share of the picture that the leaves would cover side by side; default: 0.25, of a twig 0.5")
            ->check(CLI::Range(0.01, 0.95));
        app()
            .add_option("--size", texture_.size, "width and height in pixels")
            ->check(CLI::Range(16, 8192))
            ->capture_default_str();
        app()
            .add_option("--seed", texture_.seed, "seed of the random numbers: another one draws another picture")
            ->capture_default_str();
        add_json_flag("print what was drawn as JSON");
        app().footer(
            R"(Leaves are ellipses over a transparent ground, which lie apart while there is room for them; or they stand on a twig, whose
foot is the middle of the lower edge, where a card is fixed to its branch.
Examples:
  espalier leaf-texture --output leaves.png
  espalier leaf-texture --form twig --colour "#ffffff" --output twig.png
  espalier leaf-texture --blobs 200 --coverage 0.7 --colour "#8a5a20" --seed 3 --output autumn.png)");
    }

    int run() override {
        if (output_.extension() != ".png") {
            throw UserError(fmt::format("--output {}: expected the name of a .png file", output_.string()));
        }
        const auto rgb = picture::hex_colour(colour_);
        if (!rgb) throw UserError(fmt::format("--colour {}: expected #rrggbb, such as #4a7a2a", colour_));
        texture_.rgb = *rgb;
        if (form_ != "blobs" && form_ != "twig") {
            throw UserError(fmt::format("--form {}: expected blobs or twig", form_));
        }
        const bool is_twig = form_ == "twig";
        texture_.form = is_twig ? LeafTexture::Form::twig : LeafTexture::Form::blobs;
        texture_.blobs = blobs_.value_or(is_twig ? 13 : 60);
        texture_.coverage = coverage_.value_or(is_twig ? 0.5 : 0.25);
        const LeafPicture leaves = leaf_picture(texture_);
        if (output_.has_parent_path()) make_folder(output_.parent_path());
        write_text(output_, png_bytes(leaves.picture));
        if (wants_json()) {
            const nlohmann::ordered_json json{
                {"path", output_.string()}, {"blobs", texture_.blobs}, {"overlapping", leaves.overlapping}};
            fmt::print("{}\n", json_text(json));
        } else {
            fmt::print("{}: {} leaves, {} of them over others\n", output_.string(), texture_.blobs, leaves.overlapping);
        }
        return exit_code::done;
    }

private:
    std::filesystem::path output_;
    std::string colour_ = "#4a7a2a", form_ = "blobs";
    std::optional<std::size_t> blobs_;
    std::optional<double> coverage_;
    LeafTexture texture_;
};

const RegisteredCommand<LeafTextureCommand> leaf_texture_entry{43};

}  // namespace
}  // namespace espalier::app
