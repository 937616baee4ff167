// Changes of the document, back and forth.
#include "studio/document/document_files.h"
#include "studio/document/graph_text.h"
#include "studio/session/request.h"
#include "studio/session/session_parts.h"

#include <fmt/format.h>

namespace espalier::studio {
namespace {

struct ChangeRequest {
    static constexpr TypeName type{"ChangeRequest", "changes of the document that are made as one"};
    std::optional<std::map<std::string, std::string>> texts;
    std::optional<std::map<std::string, Nullable<std::string>>> settings;
    std::optional<Nullable<std::uint64_t>> seed;
    std::optional<Nullable<int>> steps;
    std::optional<std::string> label;
    std::optional<bool> transient;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("texts", self.texts, "contents of texts, by paths");
        field("settings", self.settings, "numbers as texts write them, by names; null: as the file on disk says");
        field("seed", self.seed, "null: what the files say");
        field("steps", self.steps, "null: what the files say", between(0, most_steps));
        field("label", self.label, "what undo calls it");
        field("transient", self.transient, "the next change replaces it");
    }
};

struct GraphRequest : GraphEdit {
    static constexpr TypeName type{"GraphRequest", "an edit of a graph of components"};
    std::string path;
    std::optional<std::string> label;
    std::optional<bool> transient;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("path", self.path, "path of its text");
        GraphEdit::declare(self, field);
        field("label", self.label, "what undo calls it");
        field("transient", self.transient, "the next change replaces it");
    }
};

NewVersion change(SessionParts& session, Viewer&, const ChangeRequest& request) {
    OpenDocument& document = session.document;
    DocumentState state = document.edited();
    for (const auto& [path, text] : request.texts.value_or(std::map<std::string, std::string>())) {
        const std::filesystem::path file = document.require_text(path);
        if (text.size() > most_text) throw UserError("the text is too long");
        state.unsaved[file] = bytes_of(file, text);
    }
    if (request.settings) {
        for (const auto& [name, text] : *request.settings) document.texts().set_number(name, text, state);
    }
    if (request.seed) state.opened.seed = *request.seed;
    if (request.steps) state.opened.steps = *request.steps;
    document.apply(std::move(state), request.label.value_or("change"), request.transient.value_or(false));
    return {document.version()};
}

NewVersion graph(SessionParts& session, Viewer&, const GraphRequest& request) {
    OpenDocument& document = session.document;
    const std::filesystem::path file = document.require_text(request.path);
    DocumentState state = document.edited();
    state.unsaved[file] = edited_graph(file, text_of(file, state), request);
    document.apply(std::move(state), request.label.value_or("graph"), request.transient.value_or(false));
    return {document.version()};
}

NewVersion undo(SessionParts& session, Viewer&, const Nothing&) {
    session.document.undo();
    return {session.document.version()};
}

NewVersion redo(SessionParts& session, Viewer&, const Nothing&) {
    session.document.redo();
    return {session.document.version()};
}

const Registered<RequestType> change_entry{request("change", "changes texts, numbers in them, seed or steps", change)};
const Registered<RequestType> graph_entry{request("graph", "edits a graph of components; its text follows", graph)};
const Registered<RequestType> undo_entry{request("undo", "takes back one lasting change", undo)};
const Registered<RequestType> redo_entry{request("redo", "brings back what was taken back", redo)};

}  // namespace
}  // namespace espalier::studio
