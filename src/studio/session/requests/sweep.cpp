// One setting swept through a range: what grows then, without a change of the document.
#include "studio/document/sharing.h"
#include "studio/session/request.h"
#include "studio/session/session_parts.h"

namespace espalier::studio {
namespace {

struct SweepRequest {
    static constexpr TypeName type{"SweepRequest", "values of a setting, each of which grows a plant"};
    std::string name;
    std::vector<std::string> values;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("name", self.name, "of the setting");
        field("values", self.values, "as texts write them; 24 at most");
    }
};

struct SweptGrowths {
    static constexpr TypeName type{"SweptGrowths", "the growths of a sweep"};
    std::uint32_t first = 0;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("first", self.first, "number of the first growth; those of the other values follow");
    }
};

SweptGrowths sweep(SessionParts& session, Viewer& viewer, const SweepRequest& request) {
    constexpr std::size_t most_values = 24;
    if (request.values.empty() || request.values.size() > most_values) throw UserError("a sweep has 1 to 24 values");
    SweepOrder order;
    for (const std::string& value : request.values) {
        DocumentState state = session.document.edited();
        session.document.texts().set_number(request.name, value, state);
        order.states.push_back(std::move(state));
    }
    order.scratch = session.options.scratch;
    order.read = session.options.read;
    order.permission = permission_of(order.states[0].opened.path, session.options.library_folder);
    order.memory = session.options.memory;
    return {session.sweeps.begin(viewer.page, std::move(order))};
}

Nothing stop_sweep(SessionParts& session, Viewer& viewer, const Nothing&) {
    session.sweeps.forget(viewer.page);
    return {};
}

const Registered<RequestType> sweep_entry{
    request("sweep", "grows the document with other values of a setting, one after the other: `swept` follows for each",
            sweep)};
const Registered<RequestType> stop_sweep_entry{
    request("stop-sweep", "ends the sweep of this page; no more `swept` follows", stop_sweep)};

}  // namespace
}  // namespace espalier::studio
