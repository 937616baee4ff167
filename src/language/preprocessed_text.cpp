#include "espalier/base/file.h"
#include "espalier/language/preprocessor.h"

#include "language/preprocessor.h"
#include "language/source.h"

namespace espalier {

struct PreprocessedText::Origin {
    language::Sources sources;
    language::MappedText text;
};

const std::string& PreprocessedText::text() const {
    return origin_->text.text();
}

Place PreprocessedText::place(std::size_t offset) const {
    return origin_->sources.place(origin_->text.location(offset));
}

std::string PreprocessedText::source_line(std::size_t offset) const {
    return origin_->sources.line(origin_->text.location(offset));
}

PreprocessedText preprocess_text(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                                 const ReadOptions& options) {
    const auto origin = std::make_shared<PreprocessedText::Origin>();
    language::Mistakes mistakes(origin->sources);
    try {
        const std::uint32_t file = origin->sources.add(name, std::string(text));
        origin->text =
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
    return PreprocessedText(origin);
}

PreprocessedText preprocess_file(const std::filesystem::path& path, const ReadOptions& options) {
    return preprocess_text(read_text(path), path.string(), path.parent_path(), options);
}

}  // namespace espalier
