#include "espalier/language/reader.h"

#include "espalier/base/file.h"

#include "language/parser/model.h"
#include "language/preprocessor/preprocessor.h"
#include "language/source.h"

namespace espalier {
namespace {

std::shared_ptr<const Model> read(std::string text, const std::string& name, const std::filesystem::path& path,
                                  const std::filesystem::path& folder, const ReadOptions& options) {
    language::Sources sources;
    language::Mistakes mistakes(sources);
    const auto model = std::make_shared<Model>();
    model->name = path.empty() ? name : path.filename().string();
    model->path = path;
    model->quirks = options.quirks;
    model->resources = options.resources;
    try {
        const std::uint32_t file = sources.add(name, std::move(text));
        const language::Preprocessed source = language::preprocess(sources, file, folder, options, mistakes);
        language::parse_model(source, sources, mistakes, *model);
    } catch (const language::TooManyMistakes&) {
        // Those found so far are reported.
    }
    if (options.warnings) {
        const std::vector<Diagnostic> found = mistakes.warnings();
        options.warnings->insert(options.warnings->end(), found.begin(), found.end());
    }
    if (std::vector<Diagnostic> errors = mistakes.errors(); !errors.empty()) throw UserError(std::move(errors));
    return model;
}

}  // namespace

std::shared_ptr<const Model> read_model(const std::filesystem::path& path, const ReadOptions& options) {
    return read(read_text(path), path.string(), path, path.parent_path(), options);
}

std::shared_ptr<const Model> read_model_text(std::string_view text, const std::string& name,
                                             const std::filesystem::path& folder, const ReadOptions& options) {
    return read(std::string(text), name, {}, folder, options);
}

}  // namespace espalier
