// Exports, and notes that are dismissed.
#include "espalier/formats/exporter.h"

#include "studio/document/sharing.h"
#include "studio/session/request.h"
#include "studio/session/session_parts.h"

namespace espalier::studio {
namespace {

struct ExportRequest {
    static constexpr TypeName type{"ExportRequest", "a format and what it is to hold"};
    std::string format;
    std::optional<Nullable<int>> step;
    std::optional<bool> film, smooth, instances;
    std::optional<int> triangles;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("format", self.format, "name of an exporter");
        field("step", self.step, "null: the last", at_least(0));
        field("film", self.film, "every step");
        field("smooth", self.smooth, "limbs with one skin");
        field("instances", self.instances, "organs that look alike are one shape");
        field("triangles", self.triangles, "at most so many", at_least(1));
    }
};

struct DismissRequest {
    static constexpr TypeName type{"DismissRequest", "a note"};
    std::uint32_t message = 0;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("message", self.message, "number of the note");
    }
};

Nothing export_run(SessionParts& session, Viewer&, const ExportRequest& request) {
    session.document.require_open();
    if (!registered<ExporterType>().contains(request.format)) throw UserError("there is no such format");
    ExportOrder order;
    order.opened = session.document.now().opened;
    order.unsaved = session.document.now().unsaved;
    order.format = request.format;
    if (request.step && *request.step) order.step = **request.step;
    order.is_film = request.film.value_or(false);
    order.is_smooth = request.smooth.value_or(false);
    order.has_instances = request.instances.value_or(false);
    if (request.triangles) order.triangles = *request.triangles;
    if (order.is_smooth && order.triangles) throw UserError("a smooth skin has as many triangles as it needs");
    order.scratch = session.options.scratch;
    order.read = session.options.read;
    order.permission = permission_of(order.opened.path, session.options.library_folder);
    order.memory = session.options.memory;
    session.jobs.begin_export(std::move(order));
    return {};
}

Nothing dismiss(SessionParts& session, Viewer&, const DismissRequest& request) {
    session.pages.dismiss(request.message);
    return {};
}

const Registered<RequestType> export_entry{
    request("export", "writes what is open for another program: `progress` follows, then `exported`", export_run)};
const Registered<RequestType> dismiss_entry{request("dismiss", "forgets a note", dismiss)};

}  // namespace
}  // namespace espalier::studio
