// A recorder turns frames into files. One file in src/timeline/recorders/ per recorder.
#pragma once

#include "espalier/base/registry.h"
#include "espalier/base/settings.h"
#include "espalier/timeline/frame.h"

#include <filesystem>
#include <memory>

namespace espalier {

struct RecorderContext {
    std::filesystem::path folder;  ///< where the timeline goes; exists
    int last_step = 0;             ///< of the run as planned
};

/// Constructors take (Settings& timeline table, const RecorderContext&). Every file appears complete or not at all;
/// what is on disk after `record` returns is a whole timeline up to that frame, whatever happens next.
class Recorder {
public:
    virtual ~Recorder() = default;
    /// True for recorders that must see every step, whatever `every` says.
    virtual bool sees_every_step() const { return false; }
    virtual void record(const Frame& frame) = 0;
    /// After the last frame, also of an interrupted or failed run.
    virtual void finish() = 0;
};

using RecorderRegistry = Registry<Recorder, Settings&, const RecorderContext&>;

/// Defining one registers a recorder. Its factory may return null: not asked for in this scene.
struct RegisteredRecorder {
    RegisteredRecorder(PartDescription description, RecorderRegistry::Factory make) {
        const std::string name = description.name;
        RecorderRegistry::entries()[name] = {std::move(description), std::move(make)};
    }
};

}  // namespace espalier
