// Requests of pages. A constant registers one, with what it takes, what it gives and the function that answers it:
//   const Registered<RequestType> entry{request("look", "looks at a step", look)};
// Nothing else is edited: the page's types, the table of docs/developer/studio-protocol.md and the words of the fuzzer
// are made from what is registered.
#pragma once

#include "espalier/base/registry.h"

#include "studio/protocol/description.h"
#include "studio/protocol/json.h"
#include "studio/session/page.h"

#include <functional>

namespace espalier::studio {

struct SessionParts;

/// What requests give that change the document.
struct NewVersion {
    static constexpr TypeName type{"NewVersion", "the version of the document"};
    std::uint64_t version = 0;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("version", self.version, "version of the document");
    }
};

struct RequestType {
    std::string name;  ///< what `do` holds
    std::string help;
    /// Throws UserError for what it refuses.
    std::function<Json(SessionParts&, Viewer&, const Json&)> answer;
    std::string (*sends)(TypeDescriptions&);
    std::string (*gets)(TypeDescriptions&);
};

template <Declared Sent, Declared Got>
RequestType request(const char* name, const char* help, Got (*answer)(SessionParts&, Viewer&, const Sent&)) {
    const auto answer_json = [answer](SessionParts& session, Viewer& viewer, const Json& json) {
        return json_of(answer(session, viewer, from_json<Sent>(json)));
    };
    return {name, help, answer_json, describe<Sent>, describe<Got>};
}

}  // namespace espalier::studio
