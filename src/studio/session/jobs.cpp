#include "studio/session/jobs.h"

#include "base/json_text.h"

#include <fmt/format.h>

#include <utility>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

struct JobProgress {
    static constexpr TypeName type{"Progress", "how much of some work is done"};
    std::string what;
    double done = 0;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("what", self.what, "the work, for people");
        field("done", self.done, "0 to 1", between(0, 1));
    }
};

struct HandedFile {
    static constexpr TypeName type{"HandedFile", "a file that pages may fetch"};
    std::uint32_t number = 0;
    std::string name;
    std::uint64_t bytes = 0;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("number", self.number, "for `/file/`");
        field("name", self.name, "as it should be called");
        field("bytes", self.bytes, "its size");
    }
};

struct Exported {
    static constexpr TypeName type{"Exported", "the files of an export"};
    std::vector<HandedFile> files;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("files", self.files, "the first names the others, such as materials and textures; none if it failed");
    }
};

const Message<JobProgress> progress_message{"progress", "while an export or limbs are made"};
const Message<Exported> exported_message{"exported", "after `export`; a note says why it failed"};

/// What the status line says while it is made.
constexpr const char* skin_name(bool smooth) {
    return smooth ? "smooth skin" : "bark";
}

}  // namespace

void Jobs::begin_export(ExportOrder order) {
    if (export_ && !export_->has_ended()) throw UserError("another export is going on");
    const fs::path scratch = order.scratch / fmt::format("export-{}", ++exports_);
    order.scratch = scratch;
    const auto progressed = [this](double share) {
        post_([this, share] { pages_.broadcast(progress_message({"export", share})); });
    };
    const auto done = [this, scratch](std::vector<fs::path> files, std::string why) {
        post_([this, scratch, files = std::move(files), why = std::move(why)] {
            note_exported(files, export_folder(scratch), why);
        });
    };
    export_ = std::make_unique<ExportRun>(std::move(order), workers_, progressed, done);
}

void Jobs::note_exported(const std::vector<fs::path>& files, const fs::path& folder, const std::string& why) {
    Exported exported;
    for (const fs::path& file : files) {
        exported.files.push_back(
            {files_.number(file), file.lexically_relative(folder).generic_string(), fs::file_size(file)});
    }
    pages_.broadcast(exported_message(exported));
    if (!why.empty()) pages_.notify("error", why);
}

void Jobs::stop_limbs(const Page& page) {
    const auto running = limb_runs_.find(&page);
    if (running != limb_runs_.end()) running->second->cancel();
    waiting_limbs_.erase(&page);
}

void Jobs::begin_limbs(Viewer& viewer, LimbOrder order) {
    stop_limbs(viewer.page);
    Page* const page = &viewer.page;
    const auto progressed = [this, page, smooth = order.smooth](double share) {
        send_later(page, [text = json_text(progress_message({skin_name(smooth), share}), -1)](Page& to) {
            to.send_text(text);
        });
    };
    const auto done = [this, page, progressed](std::string bytes, const std::string& why) {
        progressed(1);
        if (why.empty()) {
            send_later(page, [bytes = std::move(bytes)](Page& to) { to.send_bytes(bytes); });
        } else {
            post_([this, why] { pages_.notify("error", why); });
        }
    };
    const auto shared = std::make_shared<const LimbOrder>(std::move(order));
    waiting_limbs_[page] = [this, shared, progressed, done] {
        return std::make_unique<LimbRun>(shared, workers_, progressed, done);
    };
    begin_waiting_limbs();
}

// One at a time for each page: those that were cancelled still take the machine until they end.
void Jobs::begin_waiting_limbs() {
    std::erase_if(limb_runs_, [](const auto& run) { return run.second->has_ended(); });
    std::erase_if(waiting_limbs_, [this](const auto& waiting) {
        const auto& [page, make] = waiting;
        if (limb_runs_.contains(page)) return false;
        limb_runs_[page] = make();
        return true;
    });
}

void Jobs::send_later(const Page* page, std::function<void(Page&)> send) {
    post_([this, page, send = std::move(send)] {
        if (Viewer* const viewer = pages_.find(page)) send(viewer->page);
    });
}

}  // namespace espalier::studio
