#include "studio/document/sharing.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "base/folder.h"
#include "base/link_mark.h"
#include "studio/document/document_files.h"
#include "studio/document/plain_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <vector>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 200;
constexpr int most_of_one_name = 1000;
constexpr int most_above = 3;  ///< folders between a document and the files that it reads

constexpr const char* words_of_mark =
    "The files of this folder came by a link. The studio lets them read only this folder and the library.\n"
    "If you trust whoever sent the link, remove this file: they may then read what you may read.\n";

/// One file of a link, in bytes: a model that reads more does not come by a link.
constexpr std::size_t most_read = std::size_t(64) << 20;

/// The parts of the program's data folder that hold the library.
constexpr std::array<std::string_view, 2> parts_of_library{"models", "environments"};

bool is_of_library(const fs::path& relative) {
    const std::string first = relative.empty() ? "" : relative.begin()->string();
    return std::find(parts_of_library.begin(), parts_of_library.end(), first) != parts_of_library.end();
}

// How many folders up from `folder` the file lies.
int folders_above(const fs::path& file, const fs::path& folder) {
    const fs::path relative = file.lexically_relative(folder);
    return static_cast<int>(std::count(relative.begin(), relative.end(), ".."));
}

std::string digest_text(const std::string& bytes) {
    return fmt::format("{:016x}", digest(bytes));
}

SharedFile shared_file(const fs::path& file, const std::string& bytes, const fs::path& root, const fs::path& library) {
    SharedFile shared;
    shared.path = file.lexically_relative(root).generic_string();
    const fs::path known = library.empty() ? fs::path() : file.lexically_relative(library);
    if (is_of_library(known) && text_on_disk(file) == bytes) {
        shared.library = known.generic_string();
        shared.digest = digest_text(bytes);
    } else if (is_palette(file) || is_text(bytes)) {
        shared.content = content_of(file, bytes);
    } else {
        throw UserError(fmt::format("{} is no text: a link cannot carry it", file.string()));
    }
    return shared;
}

// What a link says is written nowhere before its name has been looked at.
fs::path checked(const std::string& text) {
    const fs::path path = fs::path(text).lexically_normal();
    require_plain_name(path);
    return path;
}

std::string bytes_of_content(const fs::path& path, const std::string& content) {
    if (content.size() > most_text) throw UserError(fmt::format("{} is too long", path.string()));
    return bytes_of(path, content);
}

std::string bytes_of_library(const fs::path& known, const std::string& wanted, const fs::path& library) {
    const bool is_there = !library.empty() && is_of_library(known);
    const std::optional<std::string> bytes = is_there ? text_on_disk(library / known) : std::nullopt;
    if (!bytes || digest_text(*bytes) != wanted) {
        throw UserError(
            fmt::format("the link needs {} of the library as another version of Espalier has it; ask for the files",
                        known.generic_string()));
    }
    return *bytes;
}

void read_file(const SharedFile& file, const fs::path& library, SharedDocument& shared) {
    const fs::path path = checked(file.path);
    if (file.content) {
        shared.files[path] = bytes_of_content(path, *file.content);
        return;
    }
    if (!file.library || !file.digest) throw UserError(fmt::format("the link does not hold {}", path.string()));
    const fs::path known = checked(*file.library);
    shared.files[path] = bytes_of_library(known, *file.digest, library);
    shared.of_library[path] = known;
}

}  // namespace

fs::path common_folder(const fs::path& main, const std::map<fs::path, std::string>& files) {
    fs::path folder = main.parent_path();
    int above = 0;
    for (const auto& [file, bytes] : files) above = std::max(above, folders_above(file, folder));
    if (above > most_above || files.size() > most_files) {
        throw UserError("the document reads files that lie too far from it, or too many: share the files themselves");
    }
    for (int i = 0; i < above; ++i) folder = folder.parent_path();
    return folder;
}

SharedModel shared_files(const fs::path& main, const std::map<fs::path, std::string>& files, const fs::path& library) {
    const fs::path root = common_folder(main, files);
    for (const auto& [file, bytes] : files) {
        std::error_code unknown;
        if (resolved_below(file, root, unknown).empty()) {
            throw UserError(fmt::format("{} is a link that leads out of {}: put the file itself there", file.string(),
                                        root.string()));
        }
    }
    SharedModel shared;
    shared.main = main.lexically_relative(root).generic_string();
    for (const auto& [file, bytes] : files) shared.files.push_back(shared_file(file, bytes, root, library));
    return shared;
}

SharedDocument read_shared(const SharedModel& shared, const fs::path& library) {
    SharedDocument document;
    document.main = checked(shared.main);
    if (shared.files.empty() || shared.files.size() > most_files) throw UserError("the link holds no model");
    for (const SharedFile& file : shared.files) read_file(file, library, document);
    if (!document.files.contains(document.main)) throw UserError("the link holds no model");
    return document;
}

fs::path place_of_shared(const SharedDocument& shared, const fs::path& folder) {
    const fs::path home = folder / "shared", name = shared.main.stem();
    for (int number = 1; number <= most_of_one_name; ++number) {
        const fs::path place = number == 1 ? home / name : home / fmt::format("{}-{}", name.string(), number);
        std::error_code error;
        if (fs::symlink_status(place, error).type() == fs::file_type::not_found) return place;
    }
    throw UserError(
        fmt::format("{} has {} folders called {}: remove some", home.string(), most_of_one_name, name.string()));
}

fs::path write_shared(const SharedDocument& shared, const fs::path& folder) {
    const fs::path place = place_of_shared(shared, folder);
    make_folder(place);
    write_text(place / link_mark, words_of_mark);
    for (const auto& [path, text] : shared.files) {
        make_folder((place / path).parent_path());
        write_text(place / path, text);
    }
    return place / shared.main;
}

std::optional<ReadPermission> permission_of(const fs::path& document, const fs::path& library) {
    const std::optional<fs::path> folder = folder_of_link(document);
    if (!folder) return std::nullopt;
    ReadPermission permission{{*folder}, most_read};
    for (const std::string_view part : parts_of_library) {
        if (!library.empty()) permission.folders.push_back(library / part);
    }
    return permission;
}

}  // namespace espalier::studio
