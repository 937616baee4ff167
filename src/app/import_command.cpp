// import: what a file of measured plants holds, and the scene in which they stand.
#include "espalier/base/file.h"
#include "espalier/language/measured_plants.h"

#include "app/measured_report.h"
#include "base/text.h"
#include "base/toml_text.h"
#include "command.h"
#include "language/measured/units.h"

#include <fmt/format.h>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

class Import final : public Command {
public:
    explicit Import(CLI::App& program)
        : Command(program, "import", "read measured plants, say what was read, and write a scene of them") {
        app().add_option("file", file_, "a file in a notation of measured plants: rsml, mtg, ...")->required();
        app()
            .add_option("--unit", options_.unit, "the unit of its lengths, whatever it says")
            ->check(CLI::IsMember(language::measured::length_units()));
        app()
            .add_option("--up", options_.up, "which of its axes points upwards, whatever it says")
            ->check(CLI::IsMember(language::measured::upward_axes()));
        app().add_option("--pixel", pixel_, "lengths are pixels of this width, mm")->check(CLI::PositiveNumber);
        app()
            .add_option("--plants", plants_,
                        "separate (default): each plant of the file is one of its own; or together")
            ->check(CLI::IsMember({"separate", "together"}));
        app().add_option("--output", output_, "write a scene (.toml) or a model (.l)");
        add_json_flag("print as JSON");
        app().footer(
            "What the file holds and is not used, and what was guessed, is named by warnings; the lengths and numbers "
            "are to be\ncompared with the program that wrote it. A scene takes the same options as keys of [[plant]].\n"
            "Examples:\n  espalier import root.rsml --unit cm --output root.toml\n  espalier run root.toml");
    }

    int run() override {
        if (pixel_) options_.pixel = 0.001 * *pixel_;
        if (pixel_ && !options_.unit.empty()) throw UserError("give either --pixel or --unit, not both");
        if (!plants_.empty()) options_.separate = plants_ == "separate";
        const MeasuredPlants plants = read_measured_plants(file_, options_);
        if (!output_.empty()) write(plants);
        report_measured(plants, wants_json());
        return exit_code::done;
    }

private:
    void write(const MeasuredPlants& plants) const {
        const std::string extension = output_.extension().string();
        if (extension == ".l") return write_text(output_, measured_model_text(plants));
        if (extension == ".toml") return write_text(output_, scene());
        throw UserError(fmt::format("--output {}: write a scene, .toml, or a model, .l", output_.string()));
    }

    /// The file's name is as the scene sees it.
    std::string scene() const {
        const fs::path folder = fs::absolute(output_).parent_path();
        std::string text = fmt::format("[[plant]]\nmodel = {}\n", toml_text(fs::proximate(file_, folder).string()));
        if (!options_.unit.empty()) text += fmt::format("unit = \"{}\"\n", options_.unit);
        if (!options_.up.empty()) text += fmt::format("up = \"{}\"\n", options_.up);
        if (pixel_) text += fmt::format("pixel = {}\n", format_exact(*pixel_));
        if (!plants_.empty()) text += fmt::format("plants = \"{}\"\n", plants_);
        return text;
    }

    fs::path file_, output_;
    MeasuredOptions options_;
    std::optional<double> pixel_;
    std::string plants_;
};

const RegisteredCommand<Import> import_entry{32};

}  // namespace
}  // namespace espalier::app
