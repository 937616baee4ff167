#include "language/preprocessor/preprocessed_text.h"

#include "espalier/base/file.h"

#include "language/preprocessor/preprocessor.h"
#include "language/text/source.h"

namespace espalier::language {
namespace {

struct MappedSource : SourceText {
    language::Sources sources;
    language::MappedText mapped;

    const std::string& text() const override { return mapped.text(); }
    Place place(std::size_t offset) const override { return sources.place(mapped.location(offset)); }
    std::string source_line(std::size_t offset) const override { return sources.line(mapped.location(offset)); }
};

}  // namespace

std::shared_ptr<const SourceText> preprocess_text(std::string_view text, const std::string& name,
                                                  const std::filesystem::path& folder, const ReadOptions& options) {
    const auto origin = std::make_shared<MappedSource>();
    language::Mistakes mistakes(origin->sources);
    try {
        const std::uint32_t file = origin->sources.add(name, std::string(text));
        origin->mapped =
            language::preprocess(origin->sources, file, folder, options, mistakes, language::Overrides::may_be_unknown)
                .text;
    } catch (const language::TooManyMistakes&) {
        // Those found so far are reported.
    }
    if (options.warnings) {
        const std::vector<Diagnostic> found = mistakes.warnings();
        options.warnings->insert(options.warnings->end(), found.begin(), found.end());
    }
    if (std::vector<Diagnostic> errors = mistakes.errors(); !errors.empty()) throw UserError(std::move(errors));
    return origin;
}

std::shared_ptr<const SourceText> preprocess_file(const std::filesystem::path& path, const ReadOptions& options) {
    return preprocess_text(read_text(path), path.string(), path.parent_path(), options);
}

}  // namespace espalier::language
