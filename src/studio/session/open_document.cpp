#include "studio/session/open_document.h"

#include "studio/document/document_files.h"
#include "studio/session/document_message.h"

#include <fmt/format.h>

#include <utility>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

struct ShownProblem {
    static constexpr TypeName type{"Problem", "an error or a warning"};
    std::string severity, file;
    int line = 0, column = 0;
    std::string message, source;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("severity", self.severity, "how grave it is", one_of("error warning"));
        field("file", self.file, "path of its text; may be empty");
        field("line", self.line, "from 1 on; 0: not known");
        field("column", self.column, "from 1 on; 0: not known");
        field("message", self.message, "what is wrong and what to do");
        field("source", self.source, "the line of the text");
    }
};

struct Problems {
    static constexpr TypeName type{"Problems", "what is wrong with a version of the document"};
    std::uint64_t version = 0;
    std::vector<ShownProblem> problems;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("version", self.version, "version of the document");
        field("problems", self.problems, "in the order in which they were found");
    }
};

const Message<Problems> problems_message_type{
    "problems", "errors and warnings; the plant of the last version that could be read stays"};

}  // namespace

OpenDocument::OpenDocument(const StudioOptions& options, Pages& pages)
    : options_(options), pages_(pages), texts_(options.library_folder) {}

void OpenDocument::require_open() const {
    if (!is_open()) throw UserError("nothing is open");
}

const DocumentState& OpenDocument::edited() const {
    require_open();
    if (recorded_from_) return *recorded_from_;
    if (is_run(path())) throw UserError("the run does not tell what it grew from: it can only be watched");
    return now();
}

fs::path OpenDocument::require_text(const std::string& path) const {
    if (!texts_.editable(edited()).contains(path))
        throw UserError(fmt::format("{} is not a text of this document", path));
    return path;
}

void OpenDocument::apply(DocumentState state, const std::string& label, bool transient) {
    const fs::path before = path();
    document_.change(std::move(state), label, transient);
    note_changed(before);
}

void OpenDocument::undo() {
    const fs::path before = path();
    if (document_.undo()) note_changed(before);
}

void OpenDocument::redo() {
    const fs::path before = path();
    if (document_.redo()) note_changed(before);
}

void OpenDocument::set_steps(int steps, int known, bool goes_on) {
    const fs::path before = path();
    DocumentState state = edited();
    state.opened.steps = steps;
    document_.change(std::move(state), fmt::format("grow to step {}", steps), false);
    if (!goes_on) return note_changed(before, known + 1);
    is_unkept_ = true;
    broadcast();
}

void OpenDocument::note_changed(const fs::path& before, std::optional<int> follow_from) {
    const bool is_other = before != path();
    if (is_other) {
        texts_.forget();
        problems_.clear();
        recorded_from_.reset();
        disputed_.clear();
    }
    is_unkept_ = true;
    is_told_ = false;
    if (changed_) changed_({is_other, follow_from});
    if (!is_other) broadcast();  // what grows need not wait for it
}

void OpenDocument::note_started(const Opened& grown, const GrowthStart& start) {
    const OwnValues own{grown.seed ? own_.seed : start.seed, grown.steps ? own_.steps : start.last_step};
    const bool is_new = texts_.learn(start.files) || own != own_;
    recorded_from_ = start.recorded_from;
    own_ = own;
    if (is_new || !is_told_) broadcast();
    set_problems(start.warnings);
}

void OpenDocument::set_problems(std::vector<Diagnostic> problems) {
    problems_ = std::move(problems);
    pages_.broadcast(problems_message());
}

void OpenDocument::set_disputed(std::set<fs::path> files) {
    if (std::exchange(disputed_, std::move(files)) != disputed_) broadcast();
}

void OpenDocument::broadcast() {
    is_told_ = true;
    pages_.broadcast(message());
}

void OpenDocument::broadcast_if_untold() {
    if (!is_told_) broadcast();
}

void OpenDocument::send_to(Viewer& viewer) const {
    Pages::send(viewer, message());
    Pages::send(viewer, problems_message());
}

bool OpenDocument::has_texts() const {
    return is_open() && (kind_of(path()) != "run" || recorded_from_);
}

Json OpenDocument::message() const {
    DocumentMessage shown;
    shown.version = version();
    shown.path = path().string();
    shown.name = path().filename().string();
    shown.folder = options_.folder.string();
    shown.undo = document_.undo_label();
    shown.redo = document_.redo_label();
    shown.seed = own_.seed;
    shown.steps = own_.steps;
    if (is_open()) shown.kind = kind_of(path());
    if (has_texts()) {
        shown.seed = now().opened.seed.value_or(own_.seed);
        shown.steps = now().opened.steps.value_or(own_.steps);
        shown.texts = shown_texts(texts_, edited(), disputed_);
        shown.settings = shown_settings(texts_, edited());
        shown.panels = shown_panels(texts_, edited());
        shown.graphs = shown_graphs(texts_, edited());
        shown.curves = shown_curves(texts_, edited());
        shown.view_entries = shown_view_entries(texts_, edited());
    }
    return document_message(shown);
}

Json OpenDocument::problems_message() const {
    Problems shown{version(), {}};
    std::vector<Diagnostic> problems = problems_;
    if (has_texts()) {
        for (Diagnostic& warning : panel_warnings(texts_, edited())) problems.push_back(std::move(warning));
    }
    for (const Diagnostic& problem : problems) {
        const bool is_error = problem.severity == Diagnostic::Severity::error;
        shown.problems.push_back({is_error ? "error" : "warning", problem.place.file, problem.place.line,
                                  problem.place.column, problem.message, problem.source});
    }
    return problems_message_type(shown);
}

}  // namespace espalier::studio
