// Changes of the document, back and forth.
#include "studio/document/document_files.h"
#include "studio/document/graph_text.h"
#include "studio/document/point_text.h"
#include "studio/document/view_text.h"
#include "studio/session/request.h"
#include "studio/session/session_parts.h"

#include <fmt/format.h>

namespace espalier::studio {
namespace {

/// What requests say of the change that undo takes back.
struct UndoStep {
    std::optional<std::string> label;
    std::optional<bool> transient;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("label", self.label, "what undo calls it");
        field("transient", self.transient, "the next change replaces it");
    }
};

struct ChangeRequest : UndoStep {
    static constexpr TypeName type{"ChangeRequest", "changes of the document that are made as one"};
    std::optional<std::map<std::string, std::string>> texts;
    std::optional<std::map<std::string, Nullable<std::string>>> settings;
    std::optional<Nullable<std::uint64_t>> seed;
    std::optional<Nullable<int>> steps;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("texts", self.texts, "contents of texts, by paths");
        field("settings", self.settings, "numbers as texts write them, by names; null: as the file on disk says");
        field("seed", self.seed, "null: what the files say");
        field("steps", self.steps, "null: what the files say", between(0, most_steps));
        UndoStep::declare(self, field);
    }
};

struct GraphRequest : GraphEdit, UndoStep {
    static constexpr TypeName type{"GraphRequest", "an edit of a graph of components"};
    std::string path;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("path", self.path, "path of its text");
        GraphEdit::declare(self, field);
        UndoStep::declare(self, field);
    }
};

struct PointsRequest : UndoStep {
    static constexpr TypeName type{"PointsRequest", "other control points of a curve"};
    std::string path;
    int number = 0;
    std::vector<CurvePoint> points;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("path", self.path, "path of its text");
        field("number", self.number, "of the curve among those of its text, from 0 on", at_least(0));
        field("points", self.points, "all that the curve is to have; a patch has 16");
        UndoStep::declare(self, field);
    }
};

struct ViewRequest : ViewEdit, UndoStep {
    static constexpr TypeName type{"ViewRequest", "another value for a setting of a view file"};
    std::string path;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("path", self.path, "path of its text");
        ViewEdit::declare(self, field);
        UndoStep::declare(self, field);
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

/// Changes one text; `edited` makes the new one of the file and its text.
template <class Request, class Edit>
NewVersion edit_text(OpenDocument& document, const Request& request, const char* label, Edit edited) {
    const std::filesystem::path file = document.require_text(request.path);
    DocumentState state = document.edited();
    state.unsaved[file] = edited(file, text_of(file, state));
    document.apply(std::move(state), request.label.value_or(label), request.transient.value_or(false));
    return {document.version()};
}

NewVersion graph(SessionParts& session, Viewer&, const GraphRequest& request) {
    return edit_text(session.document, request, "graph",
                     [&](const auto& file, const std::string& text) { return edited_graph(file, text, request); });
}

NewVersion points(SessionParts& session, Viewer&, const PointsRequest& request) {
    return edit_text(session.document, request, "points", [&](const auto& file, const std::string& text) {
        return with_curve_points(file, text, request.number, request.points);
    });
}

NewVersion view_value(SessionParts& session, Viewer&, const ViewRequest& request) {
    return edit_text(session.document, request, "view", [&](const auto& file, const std::string& text) {
        if (language_of(file) != "view") throw UserError(file.filename().string() + " is no view file");
        return with_view_edit(text, request);
    });
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
const Registered<RequestType> points_entry{
    request("points", "moves, adds or takes out control points of a side file; its text follows", points)};
const Registered<RequestType> view_value_entry{
    request("view-value", "changes a setting of a view file; its text follows", view_value)};
const Registered<RequestType> undo_entry{request("undo", "takes back one lasting change", undo)};
const Registered<RequestType> redo_entry{request("redo", "brings back what was taken back", redo)};

}  // namespace
}  // namespace espalier::studio
