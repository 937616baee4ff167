// A recorder turns frames into files. One file in src/timeline/recorders/ per recorder.
#pragma once

#include "espalier/base/registry.h"
#include "espalier/base/settings.h"
#include "espalier/base/stations.h"
#include "espalier/timeline/compression.h"
#include "espalier/timeline/frame.h"

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace espalier::timeline {

struct RecorderContext {
    std::filesystem::path folder;  ///< where the timeline goes; exists
    int last_step = 0;             ///< last step of the run as planned
    Compression compression = Compression::lz4;
};

/// Bytes that recording takes, besides the frame itself.
struct RecordedMemory {
    std::size_t frame = 0;   ///< while the frame is written, and until the next is
    std::size_t kept = 0;    ///< from this frame on to the end of the run
    std::size_t finish = 0;  ///< for this frame's sake at the end of the run, when what `frame` counts is gone

    RecordedMemory& operator+=(const RecordedMemory& other) {
        frame += other.frame;
        kept += other.kept;
        finish += other.finish;
        return *this;
    }
};

/// Constructors take (Settings& timeline table, const RecorderContext&). Every file appears complete or not at all;
/// what is on disk after `record` returns is a whole timeline up to that frame, whatever happens next. The run itself
/// is ahead of that by a few frames: recorders work beside it, one after the other, on a thread of their own.
class Recorder {
public:
    virtual ~Recorder() = default;
    /// True for recorders that must see every step, whatever `every` says.
    virtual bool sees_every_step() const { return false; }
    /// False for recorders that read neither the strings of plants nor what is drawn of them: a run without others
    /// keeps no lineages and draws nothing.
    virtual bool reads_plants() const { return true; }
    /// False for steps of which it reads no plants, though it does of others. `may_end`: the run may end there.
    virtual bool reads_plants_at(int /*step*/, bool /*may_end*/) const { return reads_plants(); }
    /// How many points a file of plants has at most, for recorders that read plants for these files alone: several
    /// processes may then write a frame, some of its pieces each (Frame::piece). 0: one process reads all plants.
    virtual std::size_t points_per_file() const { return 0; }
    /// The fields it reads, asked for once, before the first frame; {"all"} for every one. Frames of a timeline hold no
    /// others: to make a field that is not read would cost a step as much as the field itself.
    virtual std::vector<std::string> fields() const { return {}; }
    /// What it reads of organs, as processes call it: "light.absorbed". Asked for once, as fields().
    virtual std::vector<std::string> organs() const { return {}; }
    /// Throws UserError if `fields` lacks one that it reads. For those who want to know before the first frame.
    virtual void require(const Fields&) const {}
    /// The frame is gone when this returns. Copies of its plants keep their values, and grids of fields may be kept.
    virtual void record(const Frame& frame) = 0;
    /// After the last frame, also of an interrupted or failed run; frees what is not needed any more.
    virtual void finish() = 0;
    /// What recording a plant takes at this step, computed from the plant alone: how far the recorder is depends on the
    /// threads, where a run runs out of memory must not. Called in parallel, before the step is recorded.
    virtual RecordedMemory memory(int, const ModuleString&, const Interpretation&) const { return {}; }

    /// What the frames to come depend on, as bytes, when every frame so far is written; for a checkpoint.
    virtual void save(std::ostream&) const {}
    /// Before the first frame, in the folder that the saved recorder wrote: what it wrote after the save is gone or
    /// will be written over.
    virtual void restore(std::istream&) {}
};

/// What a file of src/timeline/recorders/ registers.
struct RecorderType {
    std::string name;
    std::string summary;  ///< the files it writes, in a line
    std::string help;     ///< its settings in [timeline], with types and defaults
    /// Null if the scene does not want it.
    std::function<std::unique_ptr<Recorder>(Settings&, const RecorderContext&)> make;
};

}  // namespace espalier::timeline
