#include "lsystem/programs/files.h"

#include "espalier/base/file.h"
#include "espalier/base/stop.h"

#include "base/bytes.h"
#include "base/folder.h"
#include "lsystem/programs/functions.h"
#include "lsystem/programs/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>

namespace espalier::lsystem {
namespace {

namespace fs = std::filesystem;

constexpr int first_handle = 3;  // as C's descriptors: 0 is no file, 1 and 2 are the terminal

/// Where a file lies below a folder; nothing if there is no such folder. Throws EvaluationError for links that lead
/// out.
std::optional<fs::path> path_below(const fs::path& folder, const std::string& name, const Place& place) {
    if (folder.empty()) return std::nullopt;
    std::error_code error;
    fs::path path = resolved_below(folder / name, folder, error);
    if (error) return std::nullopt;
    if (path.empty()) {
        throw EvaluationError(place, fmt::format("fopen: '{}' is a link that leads out of the model's folder", name));
    }
    return path;
}

/// The text of a regular file; nothing if there is none.
std::optional<std::string> text_of(const fs::path& path, const Place& place) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return std::nullopt;
    if (fs::file_size(path, error) > most_file_bytes) {
        throw EvaluationError(place, fmt::format("fopen: {} is larger than {} bytes", path.string(), most_file_bytes));
    }
    try {
        return read_text(path);
    } catch (const UserError&) {
        return std::nullopt;
    }
}

}  // namespace

ModelFiles::ModelFiles(const fs::path& input_folder, const fs::path& output_folder)
    : input_(input_folder), output_(output_folder) {}

ModelFiles::~ModelFiles() {
    const StopRequest* const request = StopRequest::current();
    if (request && request->is_asked()) return;  // what a dropped step has printed is dropped with it
    try {
        flush_all();
    } catch (const RunError&) {
        // Whoever must know has flushed before.
    }
}

std::string ModelFiles::checked_name(const std::string& name, const Place& place) {
    const fs::path path(name);
    const bool climbs = std::any_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
    if (path.is_absolute() || climbs) {
        throw EvaluationError(place, fmt::format("fopen: '{}' lies outside the model's own folders: give a name "
                                                 "without a leading '/' and without '..'",
                                                 name));
    }
    const bool nameless = !path.has_filename() || name.find('\0') != std::string::npos;
    if (nameless) throw EvaluationError(place, fmt::format("fopen: '{}' is not the name of a file", name));
    return path.lexically_normal().string();
}

std::shared_ptr<ModelFiles::Contents> ModelFiles::find(const std::string& name, const Place& place) {
    if (const auto known = written_.find(name); known != written_.end()) return known->second;
    for (const fs::path* folder : {&output_, &input_}) {
        if (folder == &output_ && fs::is_symlink(output_)) continue;
        const std::optional<fs::path> path = path_below(*folder, name, place);
        std::optional<std::string> text = path ? text_of(*path, place) : std::nullopt;
        if (!text) continue;
        auto contents = std::make_shared<Contents>();
        contents->on_disk = folder == &output_;
        contents->clean = contents->on_disk ? text->size() : 0;
        contents->text = std::move(*text);
        take_room(contents->text.size(), "fopen", place);
        return contents;
    }
    return nullptr;
}

void ModelFiles::take_room(std::size_t bytes, const char* function, const Place& place) {
    if (bytes > room_) {
        throw EvaluationError(place,
                              fmt::format("{}: {} bytes more take more than the memory that is left", function, bytes));
    }
    room_ -= bytes;
}

void ModelFiles::leave(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    room_ = bytes;
}

std::size_t ModelFiles::bytes() const {
    const std::lock_guard lock(mutex_);
    std::size_t bytes = bytes_;
    for (const auto& [handle, file] : open_) bytes += file.contents->written ? 0 : file.contents->text.size();
    return bytes;
}

double ModelFiles::open(const std::string& name, const std::string& mode, const Place& place) {
    const std::lock_guard lock(mutex_);
    Open file;
    file.name = checked_name(name, place);
    std::string kind = mode;
    std::erase_if(kind, [](char c) { return c == 'b' || c == 't'; });
    const bool updates = kind.ends_with('+');
    if (updates) kind.pop_back();
    if (kind != "r" && kind != "w" && kind != "a") {
        throw EvaluationError(place, fmt::format("fopen: there is no mode '{}': r, w, a, r+, w+ or a+", mode));
    }
    file.reads = kind == "r" || updates;
    file.writes = kind != "r" || updates;
    file.appends = kind == "a";
    if (open_.size() >= most_open_files) return 0;
    if (file.writes) path_below(output_, file.name, place);
    if (kind != "w") file.contents = find(file.name, place);
    if (!file.contents && kind == "r") return 0;
    if (file.writes) {
        std::shared_ptr<Contents>& kept = written_[file.name];
        if (!kept) kept = file.contents ? file.contents : std::make_shared<Contents>();
        if (kind == "w") {
            bytes_ -= kept->written ? kept->text.size() : 0;
            *kept = {};
        }
        if (!kept->written) bytes_ += kept->text.size();
        kept->written = true;
        file.contents = kept;
    }
    int handle = first_handle;
    while (open_.contains(handle)) ++handle;
    open_.emplace(handle, std::move(file));
    return handle;
}

ModelFiles::Open* ModelFiles::opened(double handle) {
    const bool whole = handle >= first_handle && handle < first_handle + double(most_open_files);
    const auto found = whole ? open_.find(static_cast<int>(handle)) : open_.end();
    return found == open_.end() ? nullptr : &found->second;
}

bool ModelFiles::close(double handle) {
    const std::lock_guard lock(mutex_);
    Open* const file = opened(handle);
    if (!file) return false;
    if (file->writes) write_out(file->name, *file->contents);
    if (!file->contents->written) room_ += file->contents->text.size();
    open_.erase(static_cast<int>(handle));
    return true;
}

bool ModelFiles::flush(double handle) {
    const std::lock_guard lock(mutex_);
    Open* const file = opened(handle);
    if (file && file->writes) write_out(file->name, *file->contents);
    return file != nullptr;
}

bool ModelFiles::print(double handle, const std::string& text, const Place& place) {
    const std::lock_guard lock(mutex_);
    Open* const file = opened(handle);
    if (!file || !file->writes) return false;
    if (bytes_ + text.size() > most_file_bytes) {
        throw EvaluationError(place, fmt::format("fprintf: the model has written more than {} bytes", most_file_bytes));
    }
    take_room(text.size(), "fprintf", place);
    Contents& contents = *file->contents;
    if (file->appends) file->position = contents.text.size();
    const std::size_t before = contents.text.size();
    file->position = std::min(file->position, before);  // another handle may have emptied the file
    contents.clean = std::min(contents.clean, file->position);
    contents.text.replace(file->position, text.size(), text);
    file->position += text.size();
    bytes_ += contents.text.size() - before;
    return true;
}

int ModelFiles::scan(double handle, const ScanFormat& format, double* values) {
    const std::lock_guard lock(mutex_);
    Open* const file = opened(handle);
    if (!file || !file->reads) return -2;
    file->position = std::min(file->position, file->contents->text.size());
    return format.scan(file->contents->text, file->position, values);
}

// What is on disk already is not written a second time: a log that grows at every step stays linear.
void ModelFiles::write_out(const std::string& name, Contents& contents) {
    if (!contents.written || output_.empty()) return;
    if (contents.on_disk && contents.clean == contents.text.size()) return;
    const fs::path path = output_ / name;
    make_folder_below(output_.parent_path(), (output_.filename() / name).parent_path());
    std::error_code error;
    const bool appends = contents.on_disk && contents.clean > 0 && fs::file_size(path, error) == contents.clean;
    if (appends) {
        append_text(path, std::string_view(contents.text).substr(contents.clean));
    } else {
        write_text(path, contents.text);
    }
    contents.on_disk = true;
    contents.clean = contents.text.size();
}

void ModelFiles::flush_all() {
    if (written_.empty()) return;  // no program opens files while a step ends
    const std::lock_guard lock(mutex_);
    for (const auto& [name, contents] : written_) write_out(name, *contents);
}

void ModelFiles::reset() {
    flush_all();
    const std::lock_guard lock(mutex_);
    open_.clear();
    written_.clear();
    bytes_ = 0;
}

void ModelFiles::save(std::ostream& out) const {
    const std::lock_guard lock(mutex_);
    put(out, static_cast<std::uint64_t>(written_.size()));
    for (const auto& [name, contents] : written_) {
        put_text(out, name);
        put_text(out, contents->text);
    }
    put(out, static_cast<std::uint64_t>(open_.size()));
    for (const auto& [handle, file] : open_) {
        put(out, static_cast<std::int32_t>(handle));
        put_text(out, file.name);
        put(out, static_cast<std::uint64_t>(file.position));
        put(out, static_cast<std::uint8_t>(file.reads | file.writes << 1 | file.appends << 2));
    }
}

void ModelFiles::restore(std::istream& in) {
    constexpr std::uint64_t longest_name = 1 << 16;
    const std::lock_guard lock(mutex_);
    open_.clear();
    written_.clear();
    bytes_ = 0;
    // A checkpoint may come from elsewhere: its names are those of a model.
    const auto name_of_file = [&in] {
        try {
            return checked_name(get_text(in, longest_name), {});
        } catch (const EvaluationError& refused) {
            throw RunError(fmt::format("the checkpoint is damaged: {}", refused.what()));
        }
    };
    for (auto files = get<std::uint64_t>(in); files > 0; --files) {
        const std::string name = name_of_file();
        auto contents = std::make_shared<Contents>();
        contents->text = get_text(in, most_file_bytes);
        contents->written = true;
        bytes_ += contents->text.size();
        written_[name] = std::move(contents);
    }
    for (auto files = get<std::uint64_t>(in); files > 0; --files) {
        const auto handle = get<std::int32_t>(in);
        Open file;
        file.name = name_of_file();
        file.position = get<std::uint64_t>(in);
        const auto flags = get<std::uint8_t>(in);
        file.reads = flags & 1;
        file.writes = flags & 2;
        file.appends = flags & 4;
        try {
            file.contents = find(file.name, {});
        } catch (const EvaluationError& refused) {
            throw RunError(refused.what());
        }
        if (!file.contents) throw RunError(fmt::format("the checkpoint reads the file '{}', which is gone", file.name));
        open_[handle] = std::move(file);
    }
}

}  // namespace espalier::lsystem
