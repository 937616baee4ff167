// The folder `files` of a run, in which its models write: which of its files are theirs.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

namespace espalier::simulation {

std::filesystem::path files_folder_of(const std::filesystem::path& output);

/// The files below a folder, by their names from there; none if there is no such folder.
std::set<std::filesystem::path> files_below(const std::filesystem::path& folder);

/// Files that lay in the folder when the run there began, as its run.json says; nothing if it says nothing.
std::optional<std::set<std::filesystem::path>> files_before_run(const std::filesystem::path& output);

/// Removes what models wrote: a run that replaces another must not read it. Throws RunError.
void remove_written_files(const std::filesystem::path& output, const std::set<std::filesystem::path>& kept);

}  // namespace espalier::simulation
