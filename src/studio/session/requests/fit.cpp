// What was measured, and fits of the document to it.
#include "base/base64.h"
#include "studio/session/request.h"
#include "studio/session/session_parts.h"

#include <fmt/format.h>

namespace espalier::studio {
namespace {

struct MeasureRequest {
    static constexpr TypeName type{"MeasureRequest", "a file of what was measured"};
    std::string name;
    std::optional<std::string> content;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("name", self.name, "of the file; without `content`, its place below the opened folder");
        field("content", self.content, "its bytes in base64");
    }
};

struct ForgetRequest {
    static constexpr TypeName type{"ForgetRequest", "a file of what was measured"};
    std::uint32_t number = 0;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("number", self.number, "as `measured` tells it");
    }
};

struct SoughtSetting {
    static constexpr TypeName type{"SoughtSetting", "a setting that is sought"};
    std::string name;
    double lowest = 0, highest = 1;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("name", self.name, "of a number");
        field("lowest", self.lowest, "that it may be");
        field("highest", self.highest, "that it may be");
    }
};

struct FitRequest {
    static constexpr TypeName type{"FitRequest", "the settings that are sought"};
    std::vector<SoughtSetting> settings;
    std::optional<std::uint32_t> search;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("settings", self.settings, "one at least");
        field("search", self.search, "comparisons over the whole ranges; without it 50 for each setting",
              between(1, 1e6));
    }
};

Nothing measure(SessionParts& session, Viewer&, const MeasureRequest& request) {
    if (!request.content) {
        session.fits.add(session.disk.below_folder(session.options.folder / request.name));
        return {};
    }
    std::vector<char> bytes;
    if (!decode_base64(*request.content, bytes)) throw UserError(fmt::format("{} is not in base64", request.name));
    session.fits.add_sent(request.name, {bytes.begin(), bytes.end()});
    return {};
}

Nothing forget_measured(SessionParts& session, Viewer&, const ForgetRequest& request) {
    session.fits.remove(request.number);
    return {};
}

Nothing fit(SessionParts& session, Viewer&, const FitRequest& request) {
    session.document.require_open();
    std::vector<Fits::Range> ranges;
    for (const SoughtSetting& one : request.settings) ranges.push_back({one.name, one.lowest, one.highest});
    session.fits.begin(ranges, request.search.value_or(0));
    return {};
}

Nothing stop_fit(SessionParts& session, Viewer&, const Nothing&) {
    session.fits.stop();
    return {};
}

const Registered<RequestType> measure_entry{
    request("measure", "reads what was measured: `measured` follows, or a note why it cannot be used", measure)};
const Registered<RequestType> forget_entry{
    request("forget-measured", "takes a file away from what the document is compared with", forget_measured)};
const Registered<RequestType> fit_entry{
    request("fit", "seeks the settings that grow what was measured: `fitting` follows, then `fitted`", fit)};
const Registered<RequestType> stop_fit_entry{request("stop-fit", "ends a fit: `fitted` follows", stop_fit)};

}  // namespace
}  // namespace espalier::studio
