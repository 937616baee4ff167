// What the tests of the language's meaning share: the string that a few lines of text grow.
#pragma once

#include "espalier/language/reader.h"
#include "espalier/lsystem/derivation.h"

#include <algorithm>
#include <string>
#include <utility>

namespace espalier::test {

using namespace espalier::language;

/// A plant grown from text, with what it printed.
struct Grown {
    std::shared_ptr<const Model> model;
    std::shared_ptr<const CompiledModel> compiled;
    std::string said;
    Derivation derivation;
    ModuleString string;

    explicit Grown(const std::string& text, DerivationSettings settings = {})
        : model(read_model_text(text, "model.l")),
          compiled(compile(model)),
          derivation(compiled, with_print(std::move(settings))) {
        derivation.start(string);
    }
    Grown(const Grown&) = delete;

    Grown& steps(int count) {
        ModuleString next;
        for (int k = 0; k < count; ++k) {
            derivation.step(string, next);
            std::swap(string, next);
        }
        return *this;
    }
    std::string text() const { return to_text(string, model->alphabet); }

    /// The string as it is drawn: every module replaced by its picture.
    std::string drawn() const {
        BranchLinks links;
        link_branches(string, links);
        const std::vector<std::size_t> offsets = parameter_offsets(string, model->alphabet);
        ModuleString pictures;
        for (std::size_t i = 0; i < string.size();) {
            const std::size_t replaced = derivation.picture(string, &offsets, links, i, offsets[i], pictures);
            if (replaced == 0) {
                const std::size_t arity = offsets[i + 1] - offsets[i];
                pictures.append(string.letters[i], {string.parameters.data() + offsets[i], arity});
            }
            i += std::max<std::size_t>(replaced, 1);
        }
        return to_text(pictures, model->alphabet);
    }

private:
    DerivationSettings with_print(DerivationSettings settings) {
        settings.printout = std::make_shared<Printout>([this](const std::string& text) { said += text; });
        return settings;
    }
};

/// The string after some steps.
inline std::string grown(const std::string& text, int steps) {
    return Grown(text).steps(steps).text();
}

/// The message of the run that fails.
inline std::string failure(const std::string& text, int steps) {
    try {
        grown(text, steps);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

}  // namespace espalier::test
