// What a page asks first: who answers, what there is to open, and what stands in the manual.
#include "espalier/environment/environment_process.h"
#include "espalier/formats/exporter.h"
#include "espalier/language/notation.h"
#include "espalier/timeline/recorder.h"
#include "espalier/turtle/geometry_stage.h"
#include "espalier/turtle/symbol.h"

#include "language/parser/functions.h"
#include "studio/document/graph_text.h"
#include "studio/session/notation_help.h"
#include "studio/session/request.h"
#include "studio/session/session_parts.h"
#include "studio/session/view_help.h"

namespace espalier::studio {
namespace {

struct HelloRequest {
    static constexpr TypeName type{"HelloRequest", "a page and its token"};
    std::optional<std::string> token;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("token", self.token, "of the studio's address; another one ends the connection");
    }
};

struct Greeting {
    static constexpr TypeName type{"Greeting", "who answers"};
    std::string version, opened;
    bool fits = false;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("version", self.version, "of the program");
        field("opened", self.opened, "path of the document; empty: nothing is open");
        field("fits", self.fits, "it can fit what is open to what was measured");
    }
};

struct OfferedModel {
    static constexpr TypeName type{"LibraryEntry", "a model, a scene or a run that can be opened"};
    std::string path, shelf, name, summary;
    Nullable<std::uint32_t> picture;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("path", self.path, "absolute path");
        field("shelf", self.shelf, "heading under which people find it");
        field("name", self.name, "for people");
        field("summary", self.summary, "first line of its text");
        field("picture", self.picture, "number for `/file/`; null: none");
    }
};

struct Library {
    static constexpr TypeName type{"Library", "what can be opened"};
    std::vector<OfferedModel> library, files;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("library", self.library, "what comes with the program, in the order of the shelves");
        field("files", self.files, "what lies in the opened folder");
    }
};

struct Help {
    static constexpr TypeName type{"Help", "what the manual says of the parts of the program"};
    std::vector<HelpEntry> symbols, functions, processes, stages, recorders, notations, exporters, keys;
    std::vector<ComponentForm> components;
    std::map<std::string, std::vector<HelpEntry>> words;
    std::vector<ViewSettingHelp> view;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("symbols", self.symbols, "symbols of the turtle");
        field("functions", self.functions, "functions of expressions");
        field("processes", self.processes, "environment processes");
        field("stages", self.stages, "geometry stages");
        field("recorders", self.recorders, "recorders of runs");
        field("notations", self.notations, "notations of models");
        field("exporters", self.exporters, "formats of exports");
        field("keys", self.keys, "the tables of a scene file");
        field("components", self.components, "types of components of graphs");
        field("words", self.words, "words of the languages `cpfg`, `sdl` and `species`, by name");
        field("view", self.view, "settings of view files");
    }
};

template <class Kind>
std::vector<HelpEntry> parts() {
    std::vector<HelpEntry> list;
    for (const auto& [name, part] : registered<Kind>()) list.push_back({name, part->summary, part->help});
    return list;
}

std::vector<HelpEntry> symbols() {
    std::vector<HelpEntry> list;
    for (const auto& [name, symbol] : registered<Symbol>()) list.push_back({name, symbol->help, ""});
    return list;
}

std::vector<HelpEntry> names(const std::vector<std::string>& all) {
    std::vector<HelpEntry> list;
    for (const std::string& name : all) list.push_back({name, "", ""});
    return list;
}

Greeting hello(SessionParts& session, Viewer&, const HelloRequest&) {
    return {ESPALIER_VERSION, session.document.path().string(), session.fits.can_fit()};
}

Library library(SessionParts& session, Viewer&, const Nothing&) {
    Library library;
    for (const LibraryEntry& entry : session.options.library()) {
        OfferedModel& offered = (entry.is_own ? library.files : library.library).emplace_back();
        offered.path = entry.path.string();
        offered.shelf = entry.shelf;
        offered.name = entry.name;
        offered.summary = entry.summary;
        if (!entry.picture.empty()) offered.picture = session.files.number(entry.picture);
    }
    return library;
}

Help help(SessionParts&, Viewer&, const Nothing&) {
    Help help;
    help.symbols = symbols();
    help.functions = names(language::function_names());
    help.processes = parts<ProcessType>();
    help.stages = parts<GeometryStageType>();
    help.recorders = parts<RecorderType>();
    help.notations = parts<NotationType>();
    help.exporters = parts<ExporterType>();
    help.keys = {{"scene", "the tables of a scene file", scene_help()}};
    help.components = component_forms();
    help.words = words_of_languages();
    help.view = view_settings_help();
    return help;
}

const Registered<RequestType> hello_entry{
    request("hello", "begins; then comes all that there is to tell, and `told` at its end", hello)};
const Registered<RequestType> library_entry{request("library", "what can be opened", library)};
const Registered<RequestType> help_entry{request("help", "what the manual says", help)};

}  // namespace
}  // namespace espalier::studio
