#include "studio/document/plain_name.h"

#include "espalier/base/error.h"
#include "espalier/language/notation.h"

#include "base/excerpt.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string_view>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes_of_part = 128, most_parts = 8;

/// Extensions of models, scenes and side files. Those of other notations register themselves.
const std::set<std::string>& extensions() {
    static const std::set<std::string> all{
        ".l",    ".h",   ".inc",  ".toml", ".v",   ".a",   ".e",    ".s",     ".ray",  ".bez", ".con", ".cur", ".crv",
        ".func", ".fun", ".fset", ".map",  ".mat", ".bg",  ".bark", ".panel", ".obj",  ".ply", ".stl", ".csv", ".txt",
        ".svg",  ".png", ".rgb",  ".tga",  ".vdb", ".jpg", ".jpeg", ".tif",   ".tiff", ".ies", ".epw"};
    return all;
}

bool is_known(const fs::path& file) {
    return extensions().contains(file.extension().string()) || notation_of(file) || file.filename() == "specifications";
}

bool is_shown_as_written(const std::string& part) {
    return printable(part) == part && part.find_first_of("\t\n") == std::string::npos;
}

/// NUL, COM1 and the others are devices in every folder of Windows, with any extension.
bool is_device(const std::string& part) {
    std::string stem = part.substr(0, part.find('.'));
    std::transform(stem.begin(), stem.end(), stem.begin(), [](unsigned char c) { return std::toupper(c); });
    constexpr std::array<std::string_view, 4> devices{"CON", "PRN", "AUX", "NUL"};
    if (std::find(devices.begin(), devices.end(), stem) != devices.end()) return true;
    return stem.size() == 4 && (stem.starts_with("COM") || stem.starts_with("LPT")) && std::isdigit(stem[3]);
}

std::optional<std::string> refusal_of_part(const std::string& part) {
    if (part.empty() || part.size() > most_bytes_of_part) {
        return fmt::format("a name has 1 to {} bytes", most_bytes_of_part);
    }
    if (!is_shown_as_written(part)) return "it holds characters that cannot be shown";
    if (part == "..") return "it leads out of the folder";
    if (part.starts_with('.')) return "names that begin with a dot are hidden files";
    if (part.find_first_of("\\:*?\"<>|") != std::string::npos)
        return "it holds one of the characters \\ : * ? \" < > |";
    if (part.ends_with('.') || part.ends_with(' ')) return "it ends in a dot or a space";
    if (is_device(part)) return "some systems take it for a device";
    return std::nullopt;
}

}  // namespace

std::optional<std::string> refusal_of_name(const fs::path& name) {
    if (name.is_absolute()) return "it leads out of the folder";
    if (std::distance(name.begin(), name.end()) > std::ptrdiff_t{most_parts}) {
        return fmt::format("it lies more than {} folders deep", most_parts);
    }
    for (const fs::path& part : name) {
        if (std::optional<std::string> refusal = refusal_of_part(part.string())) return refusal;
    }
    if (is_known(name)) return std::nullopt;
    return fmt::format("the studio writes models, scenes and side files: {}", fmt::join(extensions(), " "));
}

void require_plain_name(const fs::path& name) {
    const std::optional<std::string> refusal = refusal_of_name(name);
    if (refusal) throw UserError(fmt::format("'{}' cannot be written: {}", printable(name.string()), *refusal));
}

}  // namespace espalier::studio
