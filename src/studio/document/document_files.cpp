#include "studio/document/document_files.h"

#include "espalier/base/file.h"
#include "espalier/language/notation.h"

#include "base/base64.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <vector>

namespace espalier::studio {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool is_text(std::string_view bytes) {
    return bytes.size() <= most_text && bytes.find('\0') == std::string_view::npos &&
           Json(bytes).dump(-1, ' ', false, Json::error_handler_t::ignore) ==
               Json(bytes).dump(-1, ' ', false, Json::error_handler_t::replace);
}

bool is_palette(const fs::path& file) {
    return file.extension() == ".map" || file.extension() == ".mat";
}

bool is_mesh(const fs::path& file) {
    const std::string extension = file.extension().string();
    return extension == ".obj" || extension == ".ply" || extension == ".stl";
}

std::string content_of(const fs::path& file, const std::string& bytes) {
    return is_palette(file) ? base64(bytes) : bytes;
}

std::string bytes_of(const fs::path& file, const std::string& content) {
    std::vector<char> bytes;
    if (!is_palette(file)) return content;
    if (!decode_base64(content, bytes)) throw UserError(fmt::format("{} is not in base64", file.string()));
    return {bytes.begin(), bytes.end()};
}

std::string language_of(const fs::path& file) {
    if (is_palette(file)) return file.extension() == ".map" ? "map" : "materials";
    if (file.extension() == ".v") return "view";
    if (const NotationType* notation = notation_of(file)) return notation->name;
    const std::string extension = file.extension().string();
    return extension == ".l" || extension == ".h"          ? "cpfg"
           : extension == ".toml" || extension == ".panel" ? "toml"
                                                           : "plain";
}

std::string role_of(const fs::path& file, const fs::path& main) {
    const std::string extension = file.extension().string();
    if (file == main) return "main";
    if (extension == ".l" || notation_of(file)) return "model";
    return extension == ".v" ? "view" : "side";
}

bool is_run(const fs::path& folder) {
    std::error_code ignored;
    return fs::is_regular_file(folder / "run.json", ignored);
}

std::string kind_of(const fs::path& path) {
    if (!fs::is_directory(path)) return path.extension() == ".toml" ? "scene" : "model";
    return is_run(path) ? "run" : "object";
}

std::optional<std::string> text_on_disk(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return std::nullopt;
    return read_text(file);
}

}  // namespace espalier::studio
