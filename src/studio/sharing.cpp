#include "studio/sharing.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/read_log.h"

#include "studio/document_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <system_error>
#include <vector>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_files = 200;
constexpr int most_above = 3;  ///< folders between a document and the files that it reads

bool is_below(const fs::path& relative) {
    return !relative.empty() && relative.is_relative() && *relative.begin() != ".." && relative != ".";
}

// How many folders up from `folder` the file lies.
int folders_above(const fs::path& file, const fs::path& folder) {
    const fs::path relative = file.lexically_relative(folder);
    return static_cast<int>(std::count(relative.begin(), relative.end(), ".."));
}

std::string digest_text(const std::string& bytes) {
    return fmt::format("{:016x}", digest(bytes));
}

Json file_json(const fs::path& file, const std::string& bytes, const fs::path& root, const fs::path& library) {
    Json json = {{"path", file.lexically_relative(root).generic_string()}};
    const fs::path known = library.empty() ? fs::path() : file.lexically_relative(library);
    if (is_below(known) && text_on_disk(file) == bytes) {
        json.update({{"library", known.generic_string()}, {"digest", digest_text(bytes)}});
    } else if (is_palette(file) || is_text(bytes)) {
        json["content"] = content_of(file, bytes);
    } else {
        throw UserError(fmt::format("{} is no text: a link cannot carry it", file.string()));
    }
    return json;
}

// The path of a shared file, which must not lead out of where it is written.
fs::path checked(const std::string& text) {
    const fs::path path = fs::path(text).lexically_normal();
    if (!is_below(path) || !path.has_filename()) throw UserError(fmt::format("the link names the file '{}'", text));
    return path;
}

std::string bytes_of_shared(const Json& file, const fs::path& path, const fs::path& library) {
    if (file.contains("content")) {
        const auto& content = file["content"].get_ref<const std::string&>();
        if (content.size() > most_text) throw UserError(fmt::format("{} is too long", path.string()));
        return bytes_of(path, content);
    }
    const fs::path known = checked(file.at("library").get<std::string>());
    const std::optional<std::string> bytes = library.empty() ? std::nullopt : text_on_disk(library / known);
    if (!bytes || digest_text(*bytes) != file.at("digest").get<std::string>()) {
        throw UserError(
            fmt::format("the link needs {} of the library as another version of Espalier has it; ask for the files",
                        known.generic_string()));
    }
    return *bytes;
}

fs::path free_place(const fs::path& folder, const fs::path& name) {
    fs::path place = folder / name;
    for (int number = 2; fs::exists(place); ++number) {
        place = folder / fmt::format("{}-{}{}", name.stem().string(), number, name.extension().string());
    }
    return place;
}

}  // namespace

Json shared_files(const fs::path& main, const std::map<fs::path, std::string>& files, const fs::path& library) {
    const fs::path folder = main.parent_path();
    int above = 0;
    for (const auto& [file, bytes] : files) above = std::max(above, folders_above(file, folder));
    if (above > most_above || files.size() > most_files) {
        throw UserError("the document reads files that lie too far from it, or too many: share the files themselves");
    }
    fs::path root = folder;
    for (int i = 0; i < above; ++i) root = root.parent_path();
    Json list = Json::array();
    for (const auto& [file, bytes] : files) list.push_back(file_json(file, bytes, root, library));
    return {{"main", main.lexically_relative(root).generic_string()}, {"files", list}};
}

fs::path write_shared(const Json& shared, const fs::path& folder, const fs::path& library) {
    if (!shared.contains("main") || !shared.contains("files")) throw UserError("the link holds no model");
    const fs::path main = checked(shared["main"].get<std::string>());
    const Json& files = shared["files"];
    if (!files.is_array() || files.empty() || files.size() > most_files) throw UserError("the link holds no model");
    std::map<fs::path, std::string> bytes;  // all, before any is written
    for (const Json& file : files) {
        const fs::path path = checked(file.at("path").get<std::string>());
        bytes[path] = bytes_of_shared(file, path, library);
    }
    if (!bytes.contains(main)) throw UserError("the link holds no model");
    const fs::path base = free_place(folder, bytes.size() == 1 ? main.filename() : main.stem());
    for (const auto& [path, text] : bytes) {
        const fs::path place = bytes.size() == 1 ? base : base / path;
        fs::create_directories(place.parent_path());
        write_text(place, text);
    }
    return bytes.size() == 1 ? base : base / main;
}

}  // namespace espalier::studio
