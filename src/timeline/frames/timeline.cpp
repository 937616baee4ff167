#include "espalier/timeline/timeline.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "base/bytes.h"
#include "base/folder.h"
#include "timeline/frames/frame_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <exception>
#include <sstream>
#include <string_view>

namespace espalier::timeline {
namespace {

namespace fs = std::filesystem;

constexpr std::array indices{"plants.pvd", "fields.pvd", "lifespans.vtp", "statistics.csv", "background.vtp"};
constexpr std::array reports{"run.json", "timings.csv"};
constexpr const char* complete = "complete";

bool holds_timeline(const fs::path& folder) {
    const auto is_there = [&](const char* name) { return fs::exists(folder / name); };
    return std::any_of(indices.begin(), indices.end(), is_there) ||
           std::any_of(reports.begin(), reports.end(), is_there);
}

bool is_number(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

// "0012.vtp" or "0012-3.vtp": named by a step's number, and that of a piece.
bool is_frame_file(const fs::path& path) {
    const std::string extension = path.extension().string(), name = path.stem().string();
    const std::size_t dash = std::min(name.find('-'), name.size());
    const bool is_piece = dash == name.size() || is_number(std::string_view(name).substr(dash + 1));
    return is_number(std::string_view(name).substr(0, dash)) && is_piece &&
           (extension == ".vtp" || extension == ".vti" || extension == ".vdb");
}

// ".plants.4711.part.pvd", named by the process: what a killed run was writing.
bool is_half_written(const fs::path& path) {
    const fs::path name = path.extension() == ".part" ? path.filename() : path.stem();
    const std::string process = name.stem().extension().string();
    return name.extension() == ".part" && name.string().starts_with('.') && !process.empty() &&
           is_number(process.substr(1));
}

// Folders that then hold nothing go, too. No link is followed.
void remove_frame_files(const fs::path& folder) {
    if (!is_folder_itself(folder)) return;
    std::vector<fs::path> folders{folder};
    std::vector<fs::path> files;
    for (const auto& item : fs::recursive_directory_iterator(folder)) {
        if (is_folder_itself(item.path())) folders.push_back(item.path());
        const bool is_ours = is_frame_file(item.path()) || is_half_written(item.path());
        if (is_ours && item.is_regular_file()) files.push_back(item.path());
    }
    for (const fs::path& file : files) fs::remove(file);
    std::error_code holds_something;
    for (; !folders.empty(); folders.pop_back()) fs::remove(folders.back(), holds_something);
}

template <class Items>
void remove_half_written(const Items& items) {
    std::vector<fs::path> halves;
    for (const auto& item : items) {
        if (is_half_written(item.path())) halves.push_back(item.path());
    }
    for (const fs::path& path : halves) fs::remove(path);
}

// Indices first: what they no longer name is not part of a timeline.
void remove_timeline(const fs::path& folder) {
    try {
        fs::remove(folder / complete);
        for (const char* name : indices) fs::remove(folder / name);
        fs::remove(folder / "timings.csv");
        remove_half_written(fs::directory_iterator(folder));
        remove_frame_files(folder / "plants");
        remove_frame_files(folder / "fields");
    } catch (const fs::filesystem_error& error) {
        throw RunError(
            fmt::format("cannot remove the old timeline in {}: {}", folder.string(), error.code().message()));
    }
}

// Keyframes alone, unless `first` or `every` says that there are others.
FrameSelection frames_of(const Settings& table) {
    FrameSelection frames;
    constexpr double most = 1e9;
    for (const double step : table.numbers_or("keyframes", {})) {
        if (!(step >= 0 && step <= most && step == std::floor(step))) {
            throw UserError(table.place("keyframes"),
                            fmt::format("'keyframes' are steps, whole numbers from 0 on, not {}", step));
        }
        frames.keyframes.push_back(static_cast<int>(step));
    }
    std::sort(frames.keyframes.begin(), frames.keyframes.end());
    const bool alone = !frames.keyframes.empty() && !table.has("first") && !table.has("every");
    if (alone) return {frames.keyframes.front(), FrameSelection::never, {}, frames.keyframes};
    frames.step = static_cast<int>(table.integer_or("every", 1, Range::between(1, most)));
    frames.first = static_cast<int>(table.integer_or("first", 0, Range::between(0, most)));
    return frames;
}

Compression compression_of(const Settings& table) {
    const std::string name = table.choice_or("compression", "lz4", {"lz4", "zlib"});
    return name == "zlib" ? Compression::zlib : Compression::lz4;
}

using Recorders = std::vector<std::unique_ptr<Recorder>>;

Recorders recorders_of(Settings& table, const RecorderContext& context) {
    Recorders recorders;
    for (const auto& [name, type] : registered<RecorderType>()) {
        if (auto recorder = type->make(table, context)) recorders.push_back(std::move(recorder));
    }
    return recorders;
}

}  // namespace

Timeline::Timeline(const fs::path& folder, Settings table, int last_step, bool overwrite)
    : folder_(folder), lock_(folder), last_step_(last_step) {
    if (!overwrite && holds_timeline(folder)) {
        throw UserError(
            fmt::format("{} already holds a timeline; choose another folder with --output, or replace it "
                        "with --overwrite",
                        folder.string()));
    }
    make_recorders(table);
}

Timeline::Timeline(const fs::path& folder, Settings table, int last_step, const std::string& checkpoint)
    : folder_(folder), lock_(folder), last_step_(last_step) {
    make_recorders(table);
    std::error_code ignored;
    fs::remove(folder / complete, ignored);
    remove_half_written(fs::recursive_directory_iterator(folder));
    std::istringstream in(checkpoint);
    restore(in);
}

void Timeline::make_recorders(Settings& table) {
    frames_ = frames_of(table);
    next_ = frames_.after(-1);
    recorders_ = recorders_of(table, {folder_, last_step_, compression_of(table)});
    table.reject_unread();
    std::vector<std::string> organs;
    for (const auto& recorder : recorders_) {
        sees_every_step_ = sees_every_step_ || recorder->sees_every_step();
        for (const std::string& name : recorder->fields()) fields_.push_back(name);
        for (const std::string& name : recorder->organs()) organs.push_back(name);
    }
    const auto write = [this](const Frame& frame, bool due) {
        for (const auto& recorder : recorders_) {
            if (due || recorder->sees_every_step()) recorder->record(frame);
        }
    };
    writer_ = std::make_unique<FrameWriter>(fields_, write, std::move(organs));
}

Timeline::~Timeline() = default;

void Timeline::remove_old() const {
    remove_timeline(folder_);
}

bool Timeline::reads_plants() const {
    return std::any_of(recorders_.begin(), recorders_.end(),
                       [](const auto& recorder) { return recorder->reads_plants(); });
}

bool Timeline::reads_plants_at(int step, bool may_end) const {
    return std::any_of(recorders_.begin(), recorders_.end(), [&](const auto& recorder) {
        return recorder->reads_plants() && (recorder->sees_every_step() || is_due(step, may_end));
    });
}

std::size_t Timeline::points_per_file() const {
    std::size_t readers = 0, points = 0;
    for (const auto& recorder : recorders_) {
        if (!recorder->reads_plants()) continue;
        ++readers;
        points = recorder->points_per_file();
    }
    return readers == 1 ? points : 0;
}

void Timeline::require(const Fields& fields) const {
    for (const auto& recorder : recorders_) recorder->require(fields);
}

void Timeline::choose(FrameSelection frames) {
    frames_ = std::move(frames);
    if (!resumed_) next_ = frames_.first;
    exactly_ = true;
}

void Timeline::record(const Frame& frame) {
    if (frame.begins) {
        is_due_ = is_due(frame.step, frame.is_last);
        if (frame.step >= next_) next_ = frames_.after(frame.step);
    }
    if (is_due_ || sees_every_step_)
        writer_->add(frame, is_due_);
    else
        writer_->release_written();
    if (frame.piece) writer_->wait();  // whoever writes the others waits, too
    if (!frame.ends) return;
    if (is_due_ && !recorded_) writer_->wait();
    recorded_ = recorded_ || is_due_;
}

bool Timeline::is_due(int step, bool is_last) const {
    const bool ends = is_last || (!exactly_ && step == last_step_);
    const bool stopped = is_last && step < last_step_;
    return step >= next_ || stopped || (ends && !(exactly_ && recorded_));
}

RecordedMemory Timeline::memory(int step, const ModuleString& string, const Interpretation& interpretation) const {
    RecordedMemory sum;
    for (const auto& recorder : recorders_) sum += recorder->memory(step, string, interpretation);
    return sum;
}

void Timeline::keep_at_most(std::size_t bytes) {
    writer_->keep_at_most(bytes);
}

void Timeline::wait() {
    writer_->wait();
}

void Timeline::save(std::ostream& out) const {
    writer_->wait();
    put(out, next_);
    put(out, static_cast<std::uint8_t>(recorded_));
    put(out, static_cast<std::uint64_t>(recorders_.size()));
    for (const auto& recorder : recorders_) recorder->save(out);
}

void Timeline::restore(std::istream& in) {
    resumed_ = true;
    next_ = get<int>(in);
    recorded_ = get<std::uint8_t>(in) != 0;
    if (get<std::uint64_t>(in) != recorders_.size()) throw RunError("the checkpoint is of another timeline");
    for (const auto& recorder : recorders_) recorder->restore(in);
}

void Timeline::finish() {
    std::exception_ptr first;
    const auto attempt = [&first](const auto& action) {
        try {
            action();
        } catch (...) {
            if (!first) first = std::current_exception();
        }
    };
    attempt([this] { writer_->wait(); });
    // Those that see every step may have to write what they gathered: they need the room that others give back.
    for (const bool sees_every_step : {false, true}) {
        for (const auto& recorder : recorders_) {
            if (recorder->sees_every_step() == sees_every_step) attempt([&recorder] { recorder->finish(); });
        }
    }
    if (first) std::rethrow_exception(first);
}

void Timeline::write_run(const std::string& json) const {
    write_text(folder_ / "run.json", json);
}

void write_complete(const fs::path& folder) {
    std::string names;
    for (const char* name : indices) {
        if (fs::exists(folder / name)) names.append(name).append("\n");
    }
    write_text(folder / complete, names);
}

fs::path missing_of_complete(const fs::path& folder) {
    if (!is_readable(folder / complete)) return {};
    std::istringstream names(read_text(folder / complete));
    for (std::string name; std::getline(names, name);) {
        std::error_code unknown;
        if (!fs::exists(folder / name, unknown)) return name;
    }
    return {};
}

std::unique_ptr<Recorder> recorder_of_pieces(const fs::path& folder, Settings table, int last_step) {
    Recorders recorders = recorders_of(table, {folder, last_step, compression_of(table)});
    std::erase_if(recorders, [](const auto& recorder) { return !recorder->reads_plants(); });
    const bool is_alone = recorders.size() == 1 && recorders.front()->points_per_file() > 0;
    return is_alone ? std::move(recorders.front()) : nullptr;
}

}  // namespace espalier::timeline
