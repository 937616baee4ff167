// Where the files of a document go when it is saved under another name.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace espalier::studio {

/// The new place of each of `files` that does not stay where it is: the document `main` at `path`, and what it reads at
/// the same places beside that. Where those would lead out of `folder`, the document gets a folder of its own, named
/// after it. The view file that a model finds by its name follows the name.
/// `files`: what the document reads, itself among them, by absolute paths. Throws UserError for files that lie too far
/// from the document.
std::map<std::filesystem::path, std::filesystem::path> saved_places(
    const std::filesystem::path& main, const std::map<std::filesystem::path, std::string>& files,
    const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace espalier::studio
