// What pages are told of the document.
#pragma once

#include "studio/document/document.h"
#include "studio/protocol/graph.h"
#include "studio/protocol/points.h"
#include "studio/protocol/view_entry.h"
#include "studio/session/document_texts.h"
#include "studio/session/message.h"
#include "studio/session/panels.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace espalier::studio {

struct ShownText {
    static constexpr TypeName type{"TextFile", "a text of the document"};
    std::string path, role, language, content;
    bool changed = false, disputed = false;
    std::optional<std::string> disk = {};

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("path", self.path, "absolute path of the file");
        field("role", self.role, "what it is to the document", one_of("main model view side"));
        field("language", self.language, "of `map` and `materials`, the content is the bytes of the file in base64",
              one_of("cpfg toml pgraph sdl species view map materials plain"));
        field("content", self.content, "with unsaved changes");
        field("changed", self.changed, "it has changes that are not saved");
        field("disputed", self.disputed,
              "another program has written the file meanwhile: it is not saved before `settle`");
        field("disk", self.disk, "what the file then holds, if it is a text");
    }
};

struct ShownSetting {
    static constexpr TypeName type{"Setting", "a number or a switch that a text writes; to change it changes the text"};
    std::string name, label, kind, text, fallback, unit, group;
    double value = 0;
    Nullable<double> lowest, highest;
    bool whole = false, changed = false;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("name", self.name, "unique in the document");
        field("label", self.label, "what it is, for people");
        field("kind", self.kind, "a switch is `true` or `false`", one_of("number switch"));
        field("value", self.value, "the number");
        field("text", self.text, "as the text writes it");
        field("default", self.fallback, "as the file on disk writes it");
        field("lowest", self.lowest, "null if there is no bound");
        field("highest", self.highest, "null if there is no bound");
        field("whole", self.whole, "it is a whole number");
        field("unit", self.unit, "empty for a pure number");
        field("group", self.group, "heading under which it stands");
        field("changed", self.changed, "it is not as on disk");
    }
};

struct DocumentMessage {
    static constexpr TypeName type{"StudioDocument", "what is open"};
    std::uint64_t version = 0;
    std::string path, name, folder;
    Nullable<std::string> undo, redo;
    std::optional<std::string> kind;
    std::vector<ShownText> texts;
    std::vector<ShownSetting> settings;
    std::vector<ShownPanel> panels;
    std::vector<ComponentGraph> graphs;
    std::vector<PointCurve> curves;
    std::vector<ViewEntry> view_entries;
    std::uint64_t seed = 0;
    int steps = 0;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("version", self.version, "grows with every change, undo and redo");
        field("path", self.path, "absolute path of what is open; empty: nothing is");
        field("name", self.name, "name of its file or folder");
        field("folder", self.folder, "below which files are written");
        field("undo", self.undo, "label of what undo would take back");
        field("redo", self.redo, "label of what redo would bring back");
        field("kind", self.kind,
              "of a `run`, texts and settings are those that it grew from, and a change of them opens that instead",
              one_of("model scene object run"));
        field("texts", self.texts, "none of a run that does not tell what it grew from");
        field("settings", self.settings, "numbers and switches that the texts write");
        field("panels", self.panels, "how the author has laid out the settings; none: in their groups");
        field("graphs", self.graphs, "texts in `pgraph` that can be read");
        field("curves", self.curves, "control points of side files that can be read, in the order of their texts");
        field("view_entries", self.view_entries, "what view files say, setting after setting");
        field("seed", self.seed, "that the plants grow with");
        field("steps", self.steps, "to which they grow");
    }
};

inline const Message<DocumentMessage> document_message{
    "document", "after every change, to every page; after `open` once the files have been read"};

std::vector<ShownText> shown_texts(const DocumentTexts& texts, const DocumentState& state,
                                   const std::set<std::filesystem::path>& disputed);
std::vector<ShownSetting> shown_settings(const DocumentTexts& texts, const DocumentState& state);
std::vector<ComponentGraph> shown_graphs(const DocumentTexts& texts, const DocumentState& state);
std::vector<PointCurve> shown_curves(const DocumentTexts& texts, const DocumentState& state);
std::vector<ViewEntry> shown_view_entries(const DocumentTexts& texts, const DocumentState& state);

}  // namespace espalier::studio
