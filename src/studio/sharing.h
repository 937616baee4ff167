// A document as a link carries it: the texts that are not those of the library, and the names of those that are.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <map>
#include <string>

namespace espalier::studio {

/// `files`: what the document reads, by absolute paths, as it is now. `library`: the folder of the models that come
/// with the program; may be empty. The part of `open-text` in docs/studio-protocol.md that tells the files. Throws
/// UserError for files that a link cannot carry.
nlohmann::ordered_json shared_files(const std::filesystem::path& main,
                                    const std::map<std::filesystem::path, std::string>& files,
                                    const std::filesystem::path& library);

/// Writes what `shared_files` told into the folder: one file there, or several in a new folder below it. Returns the
/// file to open. Throws UserError for what it did not tell, and for files that this library does not have.
std::filesystem::path write_shared(const nlohmann::ordered_json& shared, const std::filesystem::path& folder,
                                   const std::filesystem::path& library);

}  // namespace espalier::studio
