// What the pages of a studio share: one document, its growth, and the requests of docs/studio-protocol.md.
#pragma once

#include "espalier/studio/studio.h"

#include "studio/document/disk_watch.h"
#include "studio/document/document.h"
#include "studio/document/written_numbers.h"
#include "studio/growth/export_job.h"
#include "studio/growth/growth.h"
#include "studio/packets/limb_mesh.h"
#include "studio/session/handed_files.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace espalier::studio {

/// A page in a browser.
class Page {
public:
    virtual ~Page() = default;
    virtual void send_text(std::string text) = 0;
    virtual void send_bytes(std::string bytes) = 0;
    /// True while it has not yet taken what was sent: packets that only pass by are then left out.
    virtual bool is_behind() const = 0;
};

/// The settings of view files, for help and forms.
nlohmann::ordered_json view_settings_json();

/// Used on one thread. What other threads have to say comes by `post`.
class Session final : private GrowthListener {
public:
    using Json = nlohmann::ordered_json;
    using Post = std::function<void(std::function<void()>)>;

    Session(const StudioOptions& options, Post post);
    ~Session() override;

    void join(Page& page);
    void leave(Page& page);
    void receive(Page& page, const std::string& text);
    /// To be called several times a second.
    void tick();
    /// The file that a reply called by this number; none if there is none.
    std::optional<std::filesystem::path> file(std::uint32_t number) const { return files_.find(number); }

private:
    struct Viewer;
    using Request = Json (Session::*)(Viewer&, const Json&);
    static Request request_named(const std::string& name);

    // Requests.
    Json hello(Viewer& viewer, const Json& request);
    Json library(Viewer& viewer, const Json& request);
    Json help(Viewer& viewer, const Json& request);
    Json open(Viewer& viewer, const Json& request);
    Json read_link(Viewer& viewer, const Json& request);
    Json open_text(Viewer& viewer, const Json& request);
    Json share(Viewer& viewer, const Json& request);
    Json change(Viewer& viewer, const Json& request);
    Json graph(Viewer& viewer, const Json& request);
    Json undo(Viewer& viewer, const Json& request);
    Json redo(Viewer& viewer, const Json& request);
    Json grow(Viewer& viewer, const Json& request);
    Json stop(Viewer& viewer, const Json& request);
    Json look(Viewer& viewer, const Json& request);
    Json frame(Viewer& viewer, const Json& request);
    Json column(Viewer& viewer, const Json& request);
    Json pick(Viewer& viewer, const Json& request);
    Json field(Viewer& viewer, const Json& request);
    Json limbs(Viewer& viewer, const Json& request);
    Json new_file(Viewer& viewer, const Json& request);
    Json save(Viewer& viewer, const Json& request);
    Json settle(Viewer& viewer, const Json& request);
    Json export_run(Viewer& viewer, const Json& request);
    Json dismiss(Viewer& viewer, const Json& request);

    // The document.
    /// What a change begins with: of a run, what that grew from. Throws UserError if there is nothing to edit.
    const DocumentState& edited() const;
    void broadcast_document();
    void apply(DocumentState state, const std::string& label, bool transient);
    /// `before`: what was open. Pages that look at the last step see every one from `follow_from` on.
    void document_changed(const std::filesystem::path& before, std::optional<int> follow_from = {});
    std::string text_of(const std::filesystem::path& file, const DocumentState& state) const;
    /// Those that pages may edit: what was read, and what has unsaved changes.
    std::set<std::filesystem::path> texts() const;
    /// The numbers of the texts by the names that pages know them by.
    std::map<std::string, std::pair<std::filesystem::path, WrittenNumber>> numbers(const DocumentState& state) const;
    std::string default_of(const std::string& name, const std::filesystem::path& file) const;
    void set_numbers(const Json& values, DocumentState& state) const;
    /// Throws UserError for a path that leads out of the opened folder.
    std::filesystem::path below_folder(const std::filesystem::path& path) const;
    /// The same for what the studio does not write.
    std::filesystem::path writable(const std::filesystem::path& path) const;
    /// What the document reads, itself among it, as it is now; by absolute paths.
    std::map<std::filesystem::path, std::string> contents(const DocumentState& state) const;
    /// Both return the files that they have written.
    std::vector<std::filesystem::path> save_changes();
    std::vector<std::filesystem::path> save_as(const std::filesystem::path& path);
    // What other programs write.
    void watch(const std::map<std::filesystem::path, ReadLog::File>& files);
    void look_at_disk_sometimes();
    void look_at_disk();
    void read_again(const std::vector<std::filesystem::path>& files);
    void note_exported(const std::vector<std::filesystem::path>& files, const std::filesystem::path& folder,
                       const std::string& why);
    void guard(const std::function<void()>& work);
    void keep();
    void restore();

    // Growth.
    void begin_growth();
    void begin_next_growth();
    void started(std::uint32_t growth, GrowthStart start) override;
    void grown(std::uint32_t growth, GrownStep step) override;
    void drawn(std::uint32_t growth, int step, std::string statistics) override;
    void printed(std::uint32_t growth, std::string text) override;
    void stopped(std::uint32_t growth) override;
    void failed(std::uint32_t growth, std::vector<Diagnostic> why) override;
    void note_started(std::uint32_t growth, GrowthStart start);
    void note_grown(std::uint32_t growth, const GrownStep& step);
    void note_drawn(std::uint32_t growth, int step, const std::string& statistics);
    void note_printed(std::uint32_t growth, const std::string& text);
    void note_stopped(std::uint32_t growth);
    void note_failed(std::uint32_t growth, const std::vector<Diagnostic>& why);
    void add_statistics(const std::string& rows);
    void retire(std::unique_ptr<PlantSource> growth);
    void forget_ended();
    PlantSource& grown_by(const Json& request) const;
    Json document_json() const;
    Json texts_json() const;
    Json settings_json() const;
    Json graphs_json() const;
    Json problems_json() const;
    Json growth_json() const;
    Json columns_json() const;
    Json fields_json() const;
    Json textures_json();
    Json view_json() const;
    void begin_limbs();
    /// From any thread: sends to a page, on the session's thread and if it is still here.
    void send_later(const Page* page, std::function<void(Page&)> send);
    Json statistics_json(std::size_t first) const;
    void broadcast_statistics();
    void show(Viewer& viewer);
    void send_when_drawn(Viewer& viewer, int step);
    void send_packet(Viewer& viewer, int step);

    // Pages.
    void broadcast(const Json& message);
    void notify(const std::string& severity, const std::string& text);
    void notify_as(std::uint32_t number, const std::string& severity, const std::string& text);
    void send_state_to(Viewer& viewer);

    const StudioOptions& options_;
    const std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);  ///< gone: what threads have posted is not done
    const Post post_;
    std::vector<std::unique_ptr<Viewer>> viewers_;
    HandedFiles files_;
    std::map<std::uint32_t, Json> messages_;
    std::uint32_t last_message_ = 0;
    std::string printed_;                ///< by the models of the growth
    std::uint32_t printed_message_ = 0;  ///< that tells it; 0: none so far

    Document document_;
    std::map<std::filesystem::path, ReadLog::File> read_;  ///< what the last growth that started has read
    std::optional<DocumentState> recorded_from_;           ///< what the open run grew from
    DiskWatch watch_;
    std::set<std::filesystem::path> disputed_;  ///< written by another program while they had unsaved changes
    std::uint32_t read_again_message_ = 0;      ///< 0: none so far
    std::chrono::steady_clock::time_point looked_at_disk_{};
    bool is_document_told_ = true;  ///< pages know the newest version
    std::vector<Diagnostic> problems_;
    bool unkept_ = false;  ///< the newest state is not on disk

    Workers workers_;
    std::uint32_t last_growth_ = 0;
    bool waits_ = false;                                 ///< a growth of the newest version is to begin
    std::unique_ptr<PlantSource> next_;                  ///< reads its files; the present growth goes on if it cannot
    std::unique_ptr<PlantSource> growth_;                ///< the one that pages see
    std::vector<std::unique_ptr<PlantSource>> retired_;  ///< end after their step
    GrowthStart start_;
    std::uint64_t own_seed_ = 0;  ///< what the files say, unless the user says more
    int own_steps_ = 0;
    GrownStep newest_;
    std::string state_ = "done", reason_;
    std::vector<std::string> columns_;
    std::vector<std::vector<std::string>> rows_;
    std::size_t untold_rows_ = 0;  ///< the first row that pages have not been told
    std::chrono::steady_clock::time_point told_{};
    int follow_from_ = 0;   ///< pages that look at the last step see every one from here on
    bool is_busy_ = false;  ///< the newest growth has not come to its end

    int exports_ = 0;
    std::unique_ptr<ExportRun> export_;
    std::map<const Page*, std::unique_ptr<LimbRun>> limb_runs_;                       ///< runs for pages
    std::map<const Page*, std::function<std::unique_ptr<LimbRun>()>> waiting_limbs_;  ///< begin when that has ended
};

}  // namespace espalier::studio
