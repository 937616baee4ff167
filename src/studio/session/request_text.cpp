#include "studio/session/request_text.h"

namespace espalier::studio {
namespace {

using Json = nlohmann::ordered_json;

constexpr int deepest = 16;

}  // namespace

Json read_request(const std::string& text) {
    // Whoever walks through what is nested without limit runs out of stack.
    const auto require_shallow = [](int depth, Json::parse_event_t, Json&) {
        if (depth > deepest) throw UserError(fmt::format("the request is nested more than {} deep", deepest));
        return true;
    };
    Json request;
    try {
        request = Json::parse(text, require_shallow);
    } catch (const Json::exception& error) {
        throw UserError(fmt::format("the request is no JSON: {}", error.what()));
    }
    if (!request.is_object()) throw UserError("the request is no object");
    if (!request.contains("id") || !request["id"].is_number_integer()) throw UserError("'id' is no whole number");
    return request;
}

}  // namespace espalier::studio
