#include "espalier/language/model_settings.h"

#include "espalier/base/file.h"
#include "espalier/language/notation.h"

#include "base/text.h"
#include "language/definitions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::language {

struct ModelSettings::Contents {
    Preprocessed source;
    std::vector<ModelSetting> settings;
};

std::string ModelSetting::range() const {
    return fmt::format("{}..{}{}", std::isfinite(lowest) ? format_general(lowest) : "",
                       std::isfinite(highest) ? format_general(highest) : "", whole ? " whole" : "");
}

std::string ModelSetting::what_is_allowed() const {
    const std::string low = format_general(lowest), high = format_general(highest);
    const std::string range = !std::isfinite(lowest)    ? "of at most " + high
                              : !std::isfinite(highest) ? "of at least " + low
                                                        : fmt::format("between {} and {}", low, high);
    return fmt::format("a {}number {}{}{}", whole ? "whole " : "", range, unit.empty() ? "" : " ", unit);
}

ModelSettings ModelSettings::read(const std::filesystem::path& model, const Defines& defines) {
    if (notation_of(model)) {
        return read_text(translated(model), model.string(), model.parent_path(), defines);
    }
    return read_text({espalier::read_text(model)}, model.string(), model.parent_path(), defines);
}

ModelSettings ModelSettings::parse(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                                   const Defines& defines) {
    return read_text({std::string(text)}, name, folder, defines);
}

ModelSettings ModelSettings::read_text(TranslatedText text, const std::string& name,
                                       const std::filesystem::path& folder, const Defines& defines) {
    Sources sources;
    Mistakes mistakes(sources);
    const auto contents = std::make_shared<Contents>();
    try {
        const std::uint32_t file = sources.add(name, std::move(text));
        contents->source = preprocess(sources, file, folder, {.defines = defines}, mistakes);
        contents->settings = settings_of(contents->source, sources, mistakes);
    } catch (const TooManyMistakes&) {
        // Those found so far are reported.
    }
    if (!mistakes.none()) throw UserError(mistakes.errors());
    return ModelSettings(contents);
}

const std::vector<ModelSetting>& ModelSettings::list() const {
    return contents_->settings;
}

double ModelSettings::value(std::string_view expression) const {
    try {
        return value_of(expression, contents_->source);
    } catch (const SyntaxError& mistake) {
        throw UserError(mistake.message);
    }
}

std::vector<std::string> ModelSettings::read_by(std::string_view expression) const {
    std::vector<std::string> names = macros_read_by(expression, contents_->source);
    std::erase_if(names, [&](const std::string& name) {
        const auto is_it = [&](const ModelSetting& setting) { return setting.name == name; };
        return std::none_of(list().begin(), list().end(), is_it);
    });
    return names;
}

}  // namespace espalier::language
