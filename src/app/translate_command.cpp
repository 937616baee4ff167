#include "espalier/base/file.h"
#include "espalier/language/notation.h"

#include "command.h"

#include <fmt/format.h>

namespace espalier::app {
namespace {

class Translate final : public Command {
public:
    explicit Translate(CLI::App& program)
        : Command(program, "translate", "print the model that a file in another notation stands for") {
        app().add_option("file", file_, "a file in a notation of `espalier list notations`")->required();
        app().add_option("--output", output_, "write the model to this file instead");
        app().footer("The text is a model that every command takes. The commands take the file itself, too.");
    }

    int run() override {
        const auto [model, origins, warnings] = language::translated(file_);
        for (const Diagnostic& warning : warnings) fmt::print(stderr, "{}\n", to_string(warning));
        if (output_.empty()) {
            fmt::print("{}", model);
        } else {
            write_text(output_, model);
        }
        return exit_code::done;
    }

private:
    std::filesystem::path file_, output_;
};

const RegisteredCommand<Translate> translate_entry{31};

}  // namespace
}  // namespace espalier::app
