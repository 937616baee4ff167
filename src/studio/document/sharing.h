// A document as a link carries it: the texts that are not those of the library, and the names of those that are. What
// comes by a link lies in a folder of its own and reads nothing but that and the library.
#pragma once

#include "espalier/base/read_log.h"

#include "studio/protocol/shared_model.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace espalier::studio {

/// The folder below which a document and all files that it reads lie: its own or one above.
/// Throws UserError if they lie too far from each other, or are too many.
std::filesystem::path common_folder(const std::filesystem::path& main,
                                    const std::map<std::filesystem::path, std::string>& files);

/// `files`: what the document reads, by absolute paths, as it is now. `library`: the folder of the models that come
/// with the program; may be empty. Seed and steps are left to the caller.
/// Throws UserError for files that a link cannot carry.
SharedModel shared_files(const std::filesystem::path& main, const std::map<std::filesystem::path, std::string>& files,
                         const std::filesystem::path& library);

/// What came by a link, read and checked.
struct SharedDocument {
    std::filesystem::path main;                          ///< one of the files
    std::map<std::filesystem::path, std::string> files;  ///< their bytes, by plain names below one folder
    std::map<std::filesystem::path, std::filesystem::path> of_library;  ///< the library's names of those that it has
};

/// Throws UserError for what `shared_files` did not tell, for names that the studio does not write (plain_name.h), and
/// for files that this library does not have.
SharedDocument read_shared(const SharedModel& shared, const std::filesystem::path& library);

/// Where `write_shared` will write: `shared/NAME` below the folder, which is not there yet.
std::filesystem::path place_of_shared(const SharedDocument& shared, const std::filesystem::path& folder);

/// Writes the files there. Returns the one to open.
std::filesystem::path write_shared(const SharedDocument& shared, const std::filesystem::path& folder);

/// What a document may read: everything, or if it lies where `write_shared` wrote it, its own folder and the library.
std::optional<ReadPermission> permission_of(const std::filesystem::path& document,
                                            const std::filesystem::path& library);

}  // namespace espalier::studio
