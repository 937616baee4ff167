#include "studio/document/document.h"

#include "espalier/base/error.h"

#include "studio/document/document_files.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace espalier::studio {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const DocumentState& state) {
    Json texts = Json::object();
    for (const auto& [path, text] : state.unsaved) texts[path.string()] = content_of(path, text);
    Json json = {{"path", state.opened.path.string()}, {"texts", texts}};
    if (state.opened.steps) json["steps"] = *state.opened.steps;
    if (state.opened.seed) json["seed"] = *state.opened.seed;
    return json;
}

DocumentState state_of(const Json& json) {
    DocumentState state;
    state.opened.path = json.at("path").get<std::string>();
    if (json.contains("steps")) state.opened.steps = json["steps"].get<int>();
    if (json.contains("seed")) state.opened.seed = json["seed"].get<std::uint64_t>();
    for (const auto& [path, text] : json.at("texts").items()) {
        state.unsaved[path] = bytes_of(path, text.get<std::string>());
    }
    return state;
}

}  // namespace

void Document::change(DocumentState state, const std::string& label, bool transient) {
    ++version_;
    states_.resize(at_ + 1);
    if (!is_transient_) {
        states_.emplace_back();
        if (states_.size() > most_states) states_.erase(states_.begin());
        at_ = states_.size() - 1;
    }
    states_[at_] = {std::move(state), label};
    is_transient_ = transient;
}

bool Document::undo() {
    is_transient_ = false;
    if (is_first()) return false;
    ++version_;
    --at_;
    return true;
}

bool Document::redo() {
    is_transient_ = false;
    if (at_ + 1 >= states_.size()) return false;
    ++version_;
    ++at_;
    return true;
}

void Document::keep_text(const std::filesystem::path& file, const std::string& text) {
    for (Entry& entry : states_) {
        if (entry.state.opened.path == now().opened.path) entry.state.unsaved.try_emplace(file, text);
    }
}

std::optional<std::string> Document::undo_label() const {
    return is_first() ? std::nullopt : std::optional(states_[at_].label);
}

bool Document::is_first() const {
    return at_ == 0 || states_[at_ - 1].state.opened.path.empty();
}

std::optional<std::string> Document::redo_label() const {
    return at_ + 1 < states_.size() ? std::optional(states_[at_ + 1].label) : std::nullopt;
}

Json Document::to_json() const {
    // The last hundred: the file is written anew with every change.
    constexpr std::size_t most_written = 100;
    const std::size_t first = at_ >= most_written ? at_ - most_written + 1 : 0;
    Json states = Json::array();
    for (std::size_t i = first; i <= at_; ++i) {
        Json entry = json_of(states_[i].state);
        entry["label"] = states_[i].label;
        states.push_back(std::move(entry));
    }
    return {{"states", states}};
}

Document Document::from_json(const Json& json) {
    Document document;
    try {
        if (!json.at("states").empty()) document.states_.clear();
        for (const Json& entry : json.at("states")) {
            document.states_.push_back({state_of(entry), entry.at("label").get<std::string>()});
        }
    } catch (const Json::exception& error) {
        throw UserError(error.what());
    }
    document.at_ = document.states_.size() - 1;
    document.version_ = 1;
    return document;
}

}  // namespace espalier::studio
