// What a studio opens and offers, on a machine and in a page.
#pragma once

#include "espalier/studio/studio.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace espalier::app {

/// Reads as `espalier run` does, with `--view` of a view file beside a model. Throws UserError.
Scene read_opened(const studio::Opened& opened);

/// Who can write documents must not start programs. Throws UserError at the first that the scene names.
void require_no_programs(const Scene& scene);

/// Names and types of processes that stand on libraries which pages do not have, or on programs.
std::vector<std::pair<std::string, std::string>> processes_without_a_page(const Scene& scene);

/// The models and scenes that come with the program, and those of a folder.
class StudioLibrary {
public:
    /// Throws UserError if there is no library.
    explicit StudioLibrary(std::filesystem::path folder);

    std::vector<studio::LibraryEntry> entries() const;

private:
    const std::filesystem::path folder_, models_;
};

}  // namespace espalier::app
