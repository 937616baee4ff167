// Growing on, and looking at what has grown.
#include "studio/session/request.h"
#include "studio/session/session_parts.h"

#include <fmt/format.h>

namespace espalier::studio {
namespace {

struct GrowRequest {
    static constexpr TypeName type{"GrowRequest", "a step to grow to"};
    int to = 0;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("to", self.to, "a step", between(0, most_steps));
    }
};

struct LookRequest {
    static constexpr TypeName type{"LookRequest", "a step that a page looks at"};
    Nullable<int> step;
    std::optional<Nullable<std::uint32_t>> held;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("step", self.step, "null: the last", at_least(0));
        field("held", self.held, "the growth whose packet of this step the page has");
    }
};

struct NewestStep {
    static constexpr TypeName type{"NewestStep", "how far it has grown"};
    int step = 0;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("step", self.step, "the last step that can be shown; -1: none", at_least(-1));
    }
};

/// A step of a growth.
struct StepRequest {
    static constexpr TypeName type{"StepRequest", "a step of a growth"};
    std::uint32_t growth = 0;
    int step = 0;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("growth", self.growth, "number of the growth");
        field("step", self.step, "a step that has grown", at_least(0));
    }
};

struct NamedRequest : StepRequest {
    static constexpr TypeName type{"NamedRequest", "a column or a field of a step"};
    std::string name;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        StepRequest::declare(self, field);
        field("name", self.name, "as `columns` or `fields` tells it");
    }
};

struct PickRequest : StepRequest {
    static constexpr TypeName type{"PickRequest", "a module of a step"};
    std::uint32_t module = 0;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        StepRequest::declare(self, field);
        field("module", self.module, "counted through all plants");
    }
};

struct LimbsRequest {
    static constexpr TypeName type{"LimbsRequest", "limbs as pictures have them"};
    Nullable<std::string> skin;
    std::optional<std::uint32_t> growth;
    std::optional<int> step;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("skin", self.skin, "null stops what was asked for before", one_of("tubes smooth"));
        field("growth", self.growth, "number of the growth");
        field("step", self.step, "a step that has been drawn", at_least(0));
    }
};

NewVersion grow(SessionParts& session, Viewer&, const GrowRequest& request) {
    session.growths.grow_to(request.to);
    return {session.document.version()};
}

Nothing stop(SessionParts& session, Viewer&, const Nothing&) {
    session.growths.stop();
    return {};
}

Nothing go_on(SessionParts& session, Viewer&, const Nothing&) {
    session.growths.go_on();
    return {};
}

NewestStep look(SessionParts& session, Viewer& viewer, const LookRequest& request) {
    viewer.step = request.step;
    const std::optional<std::uint32_t> held = request.held.value_or(Nullable<std::uint32_t>());
    if (!held || held != session.growths.number()) session.growths.show(viewer);
    return {session.growths.newest_step()};
}

NewestStep frame(SessionParts& session, Viewer& viewer, const StepRequest& request) {
    const ShownGrowth& growth = session.growths.shown(request.growth);
    if (!growth.source().has(request.step)) throw UserError(fmt::format("step {} has not been grown", request.step));
    growth.send_when_drawn(viewer, request.step, session.files);
    return {request.step};
}

Nothing column(SessionParts& session, Viewer& viewer, const NamedRequest& request) {
    viewer.page.send_bytes(session.growths.shown(request.growth).source().column(request.step, request.name));
    return {};
}

Picked pick(SessionParts& session, Viewer&, const PickRequest& request) {
    return session.growths.shown(request.growth).source().module_info(request.step, request.module);
}

Nothing field(SessionParts& session, Viewer& viewer, const NamedRequest& request) {
    viewer.page.send_bytes(session.growths.shown(request.growth).source().field(request.step, request.name));
    return {};
}

Nothing limbs(SessionParts& session, Viewer& viewer, const LimbsRequest& request) {
    session.jobs.stop_limbs(viewer.page);
    if (!request.skin) return {};
    if (!request.growth || !request.step) throw UserError("limbs need 'growth' and 'step'");
    const PlantSource& source = session.growths.shown(*request.growth).source();
    if (!source.has_packet(*request.step)) throw UserError(fmt::format("step {} has not been drawn", *request.step));
    session.jobs.begin_limbs(
        viewer, {source.limb_axes(*request.step), source.number(), *request.step, *request.skin == "smooth"});
    return {};
}

const Registered<RequestType> grow_entry{request("grow", "grows on to a step", grow)};
const Registered<RequestType> stop_entry{
    request("stop", "ends the growth after the step at hand, which is dropped if it is not done within 0.4 s", stop)};
const Registered<RequestType> go_on_entry{
    request("go-on", "goes on with a growth whose state is `asks`; later growths of the document do not ask", go_on)};
const Registered<RequestType> look_entry{request(
    "look", "looks at a step: its packet follows, now unless the page holds it, and whenever it changes", look)};
const Registered<RequestType> frame_entry{
    request("frame", "sends the packet of a step, once it has been drawn", frame)};
const Registered<RequestType> column_entry{request("column", "sends a number for each module", column)};
const Registered<RequestType> pick_entry{request("pick", "what is known of a module", pick)};
const Registered<RequestType> field_entry{request("field", "sends a field after a step", field)};
const Registered<RequestType> limbs_entry{request(
    "limbs", "sends the limbs as pictures have them, after `progress`; what the page asked for before is stopped",
    limbs)};

}  // namespace
}  // namespace espalier::studio
