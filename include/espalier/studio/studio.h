// The studio: a server on this machine for a page in the browser, where one edits, watches and measures a growing
// plant.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/simulation/scene.h"
#include "espalier/studio/fitting.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace espalier::studio {

/// What a studio has open: a model, a scene or the folder of an object, and what replaces values of its files.
struct Opened {
    std::filesystem::path path;
    std::optional<int> steps;
    std::optional<std::uint64_t> seed;
};

/// A model or a scene that the studio offers.
struct LibraryEntry {
    std::filesystem::path path;
    std::string name, summary;
    std::string shelf = {};              ///< the heading under which people find it
    std::filesystem::path picture = {};  ///< empty: there is none
    bool is_own = false;                 ///< a file of the opened folder, not of the library
};

struct StudioOptions {
    std::filesystem::path folder;               ///< files are saved below it only
    std::filesystem::path library_folder = {};  ///< what comes with the program: links only name its files
    std::filesystem::path scratch;              ///< a folder for what is grown, emptied by the caller
    std::filesystem::path state;                ///< keeps unsaved work; empty: it is lost with the program
    Opened opened = {};                         ///< an empty path: the page begins with the library
    bool is_named = true;                       ///< the user named it: it is opened even where unsaved work is kept
    int port = 0;                               ///< 0: any that is free
    std::size_t memory = 0;                     ///< most bytes of one growth; 0: default_memory(), of a link 1 GiB
    /// Reads what is opened as `espalier run` does. Called on several threads. Throws UserError.
    std::function<Scene(const Opened&)> read;
    std::function<std::vector<LibraryEntry>()> library;
    Fitting fitting = {};                                   ///< none: the studio cannot
    std::function<void(const std::string& address)> ready;  ///< it listens; the address holds its token
    const std::atomic<bool>* interrupt = nullptr;           ///< ends it
};

/// Serves the page on 127.0.0.1 until it is interrupted. Throws RunError if the port is taken.
void serve(const StudioOptions& options);

}  // namespace espalier::studio
