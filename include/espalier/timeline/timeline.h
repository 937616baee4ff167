// The timeline of a run: a folder, its recorders, and which steps they see.
#pragma once

#include "espalier/base/file.h"
#include "espalier/base/stations.h"
#include "espalier/timeline/frame_selection.h"
#include "espalier/timeline/recorder.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace espalier::timeline {

class FrameWriter;

/// Frames are written by a thread of their own, in order, while the run goes on; a few may wait. It is a recorder made
/// of others: attach it to a World.
class Timeline final : public Recorder {
public:
    /// Locks the folder (two runs into one are refused) and makes the recorders `table` asks for.
    /// A folder that already holds a timeline is refused, unless `overwrite`: then that timeline's files are there
    /// until remove_old(). Throws UserError for settings that mean nothing.
    Timeline(const std::filesystem::path& folder, Settings table, int last_step, bool overwrite = false);
    /// Goes on with the timeline in the folder where save() left it; frames that came behind are written over. After
    /// choose(), if that is called. Throws RunError if the files are not those of the checkpoint.
    Timeline(const std::filesystem::path& folder, Settings table, int last_step, const std::string& checkpoint);
    ~Timeline() override;

    /// Removes the timeline that this one replaces: `complete` first, run.json not at all, which tells until it is
    /// written anew which files are the old run's. Throws RunError.
    void remove_old() const;

    const std::filesystem::path& folder() const { return folder_; }
    /// One of its recorders does.
    bool reads_plants() const override;
    bool reads_plants_at(int step, bool may_end) const override;
    /// That of the only recorder that reads plants; 0 if there are several.
    std::size_t points_per_file() const override;
    std::vector<std::string> fields() const override { return fields_; }
    /// All its recorders find the fields that they read.
    void require(const Fields& fields) const override;
    /// Exactly these steps become frames, instead of those that the table's `first` and `every` choose.
    void choose(FrameSelection frames);
    /// Frames come in the order of their steps. Recorders see those chosen; by `first` and `every` the run's last one
    /// too, by `choose` only if it would be the only one, or if the run ends before its time.
    /// The first frame chosen is on disk when this returns, so that a mistake in the table is reported at once. What
    /// goes wrong with a later one is thrown by the next call, of this or of another; nothing is recorded after it.
    void record(const Frame& frame) override;
    /// The sum over its recorders.
    RecordedMemory memory(int step, const ModuleString& string, const Interpretation& interpretation) const override;
    /// Frames that wait to be written take no more than so many bytes, or 256 MiB, from now on; one frame always may.
    void keep_at_most(std::size_t bytes);
    /// Returns when every frame recorded is on disk.
    void wait();
    /// Waits; then what the frames to come depend on.
    void save(std::ostream& out) const override;
    /// Waits, then every recorder finishes, whatever becomes of the others; then the first failure is thrown.
    void finish() override;

    /// Writes run.json (complete or not at all). `json` is what the run says of itself.
    void write_run(const std::string& json) const;

private:
    void make_recorders(Settings& table);
    bool is_due(int step, bool is_last) const;
    void restore(std::istream& in) override;

    std::filesystem::path folder_;
    FolderLock lock_;
    FrameSelection frames_;
    bool exactly_ = false;  // the last step is no frame unless chosen
    bool recorded_ = false;
    bool is_due_ = false;  ///< the frame at hand
    bool resumed_ = false;
    int next_ = 0;
    int last_step_ = 0;
    std::vector<std::unique_ptr<Recorder>> recorders_;
    std::vector<std::string> fields_;  // that one of them reads
    bool sees_every_step_ = false;     // one of them
    std::unique_ptr<FrameWriter> writer_;
};

/// Writes the last file of a run that ended by itself, `complete`: the names of the others that have no number, a line
/// each. A run that begins or goes on has none. For make and its like. Throws RunError.
void write_complete(const std::filesystem::path& folder);
/// The first file named by `complete` in a run's folder that is not there; empty if all are, or if there is no
/// `complete`.
std::filesystem::path missing_of_complete(const std::filesystem::path& folder);

/// For a process that helps another one, which has the Timeline, to write large frames: what records their pieces into
/// the same folder. Null if that table's Timeline reads all plants in one process.
std::unique_ptr<Recorder> recorder_of_pieces(const std::filesystem::path& folder, Settings table, int last_step);

}  // namespace espalier::timeline
