// docs/gallery.md: the shelves of the library, as pages and the studio show them.
#pragma once

#include <filesystem>
#include <vector>

namespace espalier::app {

/// A model or a scene on its shelf.
struct GalleryEntry {
    std::filesystem::path file;  ///< absolute, as `picture`
    std::string shelf, title;
    std::string source;  ///< the publication, "Honda 1971"; may be empty
    std::filesystem::path picture;
};

/// In the order of the page that lies below the folder of the library's data; nothing if there is no such page.
std::vector<GalleryEntry> gallery_of(const std::filesystem::path& data);

}  // namespace espalier::app
