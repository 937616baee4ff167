#include "espalier/language/notation.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "language/plain_text.h"

#include <fmt/format.h>

namespace espalier::language {

const NotationType* notation_of(const std::filesystem::path& path) {
    for (const auto& [name, notation] : registered<NotationType>()) {
        if (path.extension() == notation->extension) return notation;
    }
    return nullptr;
}

TranslatedText translated(const NotationType& notation, const std::string& text, const std::filesystem::path& path) {
    require_text(text, path.string());
    return notation.translate(with_plain_lines(text), path);
}

TranslatedText translated(const std::filesystem::path& path) {
    if (const NotationType* notation = notation_of(path)) return translated(*notation, read_text(path), path);
    std::string extensions;
    for (const auto& [name, known] : registered<NotationType>()) extensions += " " + known->extension;
    throw UserError(fmt::format("{} is in no notation that can be translated; their extensions are{}", path.string(),
                                extensions.empty() ? " none" : extensions));
}

}  // namespace espalier::language
