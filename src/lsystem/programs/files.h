// The files of a growing plant: fopen() and related functions, confined to the folders that the derivation was given.
#pragma once

#include "espalier/base/error.h"

#include "lsystem/programs/scan_format.h"

#include <filesystem>
#include <iosfwd>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace espalier::lsystem {

/// Files are read whole when they are opened; what is written goes to disk when they are flushed or closed and after
/// every step. A name is looked for among what the model itself wrote, then in the output folder, then in the input
/// folder. All functions may be called by several threads.
class ModelFiles {
public:
    /// The folders outlive it: of many plants each has one of these.
    ModelFiles(const std::filesystem::path& input_folder, const std::filesystem::path& output_folder);
    ~ModelFiles();
    ModelFiles(const ModelFiles&) = delete;

    /// fopen: a handle, or 0 if there is no such file to read. Throws EvaluationError for a name that leads out of the
    /// folders and for a mode that does not exist.
    double open(const std::string& name, const std::string& mode, const Place& place);
    /// fclose, fflush: false if nothing is open by this handle.
    bool close(double handle);
    bool flush(double handle);
    /// fprintf: false if the file is not open for writing. Throws EvaluationError for more than a gigabyte.
    bool print(double handle, const std::string& text, const Place& place);
    /// fscanf: how many values were read, -1 at the end of the file; -2 if the file is not open for reading.
    int scan(double handle, const ScanFormat& format, double* values);

    /// How many bytes the files may take besides what they take now, those that are only read among them.
    void leave(std::size_t bytes);
    std::size_t bytes() const;

    void flush_all();
    /// Closes everything and forgets what was written in memory.
    void reset();
    /// What was written, and which files are open where.
    void save(std::ostream& out) const;
    void restore(std::istream& in);

private:
    /// A file's contents: those of the disk, and what the model wrote.
    struct Contents {
        std::string text;
        bool written = false;  ///< by this model
        bool on_disk = false;  ///< the first `clean` bytes are on disk, and no more
        std::size_t clean = 0;
    };
    struct Open {
        std::string name;
        std::shared_ptr<Contents> contents;
        bool reads = false, writes = false, appends = false;
        std::size_t position = 0;
    };

    static std::string checked_name(const std::string& name, const Place& place);
    std::shared_ptr<Contents> find(const std::string& name, const Place& place);
    void take_room(std::size_t bytes, const char* function, const Place& place);
    Open* opened(double handle);
    void write_out(const std::string& name, Contents& contents);

    const std::filesystem::path &input_, &output_;
    std::map<int, Open> open_;
    std::map<std::string, std::shared_ptr<Contents>> written_;  ///< by the model, open or closed
    std::size_t bytes_ = 0;                                     ///< bytes of all that was written
    std::size_t room_ = std::size_t(-1);                        ///< bytes that are left of the memory
    mutable std::mutex mutex_;
};

}  // namespace espalier::lsystem
