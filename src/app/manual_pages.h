// The pages of the manual that are made from the parts' own help: docs/reference/ and docs/models.md.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace espalier::app {

/// Texts by their place in the folder of the manual: "reference/processes/voxel-shade.md".
using ManualPages = std::map<std::filesystem::path, std::string>;

/// The first line of each page.
inline constexpr const char* made_by = "<!-- Made by `espalier list --markdown docs`: edit the help of the part. -->\n";

/// A page for every process, group of symbols, stage, recorder and notation, for the scene file and the solids, an
/// index of them, and the pages of models. Pictures and hand-written pages are looked for in `manual`, scenes in
/// `environments` and in `manual`, models in the library (`models`, as for model_library()).
ManualPages manual_pages(const std::filesystem::path& manual, const std::filesystem::path& models);

/// The pages of models: an index, and a page for each folder.
ManualPages model_pages(const std::filesystem::path& manual, const std::filesystem::path& models);

/// Writes them below the folder, and removes those that were made of parts that are gone.
void write_manual(const ManualPages& pages, const std::filesystem::path& manual);

/// Throws UserError that names every page which differs from what the parts say, is missing or was made of a part that
/// is gone, and the command that mends it.
void check_manual(const ManualPages& pages, const std::filesystem::path& manual);

/// A picture as a paragraph, seen from a page in `from`; nothing if the manual has none of this name.
std::string picture_of(const std::filesystem::path& manual, const std::string& name, const std::string& title,
                       const std::filesystem::path& from);

/// "environments-course-light": what the pictures of a scene or of a model are called.
std::string picture_name(const std::filesystem::path& file);

/// A file of the repository, whose root is above the manual, as a link from a page in the folder `from` of the manual.
std::string link_from(const std::filesystem::path& from, const std::filesystem::path& file);

}  // namespace espalier::app
