#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "app/command.h"
#include "base/folder.h"
#include "base/json_text.h"
#include "formats/leaf_texture.h"
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
            .add_option("--blobs", texture_.blobs, "number of leaves")
            ->check(CLI::Range(1, 10000))
            ->capture_default_str();
        app().add_option("--colour", colour_, "colour of the leaves, as #rrggbb")->capture_default_str();
        app()
            .add_option("--variation", texture_.variation, "largest change of the brightness of a leaf, as a share")
            ->check(CLI::Range(0.0, 1.0))
            ->capture_default_str();
        app()
            .add_option("--coverage", texture_.coverage,
                        "share of the picture that the leaves would cover side by side")
            ->check(CLI::Range(0.01, 0.95))
            ->capture_default_str();
        app()
            .add_option("--size", texture_.size, "width and height in pixels")
            ->check(CLI::Range(16, 8192))
            ->capture_default_str();
        app()
            .add_option("--seed", texture_.seed, "seed of the random numbers: another one draws another picture")
            ->capture_default_str();
        add_json_flag("print what was drawn as JSON");
        app().footer(R"(Leaves are ellipses over a transparent ground. They lie apart while there is room for them.
Examples:
  espalier leaf-texture --output leaves.png
  espalier leaf-texture --blobs 200 --coverage 0.7 --colour "#8a5a20" --seed 3 --output autumn.png)");
    }

    int run() override {
        if (output_.extension() != ".png") {
            throw UserError(fmt::format("--output {}: expected the name of a .png file", output_.string()));
        }
        const auto rgb = hex_colour(colour_);
        if (!rgb) throw UserError(fmt::format("--colour {}: expected #rrggbb, such as #4a7a2a", colour_));
        texture_.rgb = *rgb;
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
    std::string colour_ = "#4a7a2a";
    LeafTexture texture_;
};

const RegisteredCommand<LeafTextureCommand> leaf_texture_entry{43};

}  // namespace
}  // namespace espalier::app
