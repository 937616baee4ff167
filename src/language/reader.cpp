#include "espalier/language/reader.h"

#include "espalier/base/file.h"
#include "espalier/language/notation.h"

#include "language/definitions.h"
#include "language/parser/model.h"
#include "language/preprocessor/preprocessor.h"
#include "language/text/other_language.h"
#include "language/text/plain_text.h"
#include "language/text/source.h"

#include <fmt/format.h>

#include <optional>

namespace espalier::language {
namespace {

std::shared_ptr<const Model> read(TranslatedText text, const std::string& name, const std::filesystem::path& path,
                                  const std::filesystem::path& folder, const ReadOptions& options) {
    require_text(text.text, name);
    const std::optional<std::string> other = language::other_language(text.text, path);
    language::Sources sources;
    language::Mistakes mistakes(sources);
    const auto model = std::make_shared<Model>();
    model->name = path.empty() ? name : path.filename().string();
    model->path = path;
    model->arithmetic = options.arithmetic;
    model->resources = options.resources;
    if (options.warnings) options.warnings->insert(options.warnings->end(), text.warnings.begin(), text.warnings.end());
    try {
        const std::uint32_t file = sources.add(name, std::move(text));
        const language::Preprocessed source = language::preprocess(sources, file, folder, options, mistakes);
        language::settings_of(source, sources, mistakes, options.in_time);
        language::parse_model(source, sources, mistakes, *model);
    } catch (const language::TooManyMistakes&) {
        // Those found so far are reported.
    }
    if (options.warnings) {
        const std::vector<Diagnostic> found = mistakes.warnings();
        options.warnings->insert(options.warnings->end(), found.begin(), found.end());
    }
    std::vector<Diagnostic> errors = mistakes.errors();
    if (!errors.empty() && other) throw UserError(fmt::format("{}: {}", name, *other));
    if (!errors.empty()) throw UserError(std::move(errors));
    return model;
}

}  // namespace

std::shared_ptr<const Model> read_model(const std::filesystem::path& path, const ReadOptions& options) {
    const NotationType* const notation = notation_of(path);
    if (notation && notation->measure) {
        const MeasuredPlants plants = read_measured_plants(path);
        if (options.warnings) {
            options.warnings->insert(options.warnings->end(), plants.warnings.begin(), plants.warnings.end());
        }
        return measured_model(plants, std::nullopt, options);
    }
    if (notation) {
        return read(translated(path), path.string(), path, path.parent_path(), options);
    }
    return read({read_text(path)}, path.string(), path, path.parent_path(), options);
}

std::shared_ptr<const Model> read_model_text(std::string_view text, const std::string& name,
                                             const std::filesystem::path& folder, const ReadOptions& options) {
    return read({std::string(text)}, name, {}, folder, options);
}

}  // namespace espalier::language
