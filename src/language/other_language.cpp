#include "language/other_language.h"

#include "base/characters.h"

#include <algorithm>

namespace espalier::language {
namespace {

/// True if a line begins with the words, behind blanks.
bool has_line(std::string_view text, std::string_view words) {
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string_view line = text.substr(begin, end - begin);
        while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
        if (line.starts_with(words)) return true;
        begin = end + 1;
    }
    return false;
}

}  // namespace

std::optional<std::string> other_language(std::string_view text, const std::filesystem::path& path) {
    if (has_line(text, "#include <lpfgall.h>") || has_line(text, "#include \"lpfgall.h\"") ||
        (has_line(text, "produce ") && has_line(text, "module "))) {
        return "this is a model in L+C, the language of lpfg, which is C++ and needs that program; Espalier reads "
               "models "
               "of cpfg, which begin with 'lsystem:'";
    }
    if (path.extension() == ".lpy" || (has_line(text, "production:") && !has_line(text, "lsystem:"))) {
        return "this is a model of L-Py, which is Python and needs that program; Espalier reads models of cpfg, which "
               "begin with 'lsystem:'";
    }
    return std::nullopt;
}

}  // namespace espalier::language
