#include "studio/session/pages.h"

#include "base/json_text.h"

#include <algorithm>

namespace espalier::studio {
namespace {

const Message<Note> note_message{"message", "a note for the user"};

std::string text_of(const Json& message) {
    return json_text(message, -1);
}

}  // namespace

Viewer& Pages::join(Page& page) {
    return *viewers_.emplace_back(std::make_unique<Viewer>(page));
}

void Pages::leave(const Page& page) {
    std::erase_if(viewers_, [&](const auto& viewer) { return &viewer->page == &page; });
}

Viewer* Pages::find(const Page* page) {
    const auto found =
        std::find_if(viewers_.begin(), viewers_.end(), [&](const auto& viewer) { return &viewer->page == page; });
    return found == viewers_.end() ? nullptr : found->get();
}

void Pages::broadcast(const Json& message) {
    const std::string text = text_of(message);
    for (const auto& viewer : viewers_) viewer->page.send_text(text);
}

void Pages::send(Viewer& viewer, const Json& message) {
    viewer.page.send_text(text_of(message));
}

std::uint32_t Pages::replace_note(std::uint32_t number, const std::string& severity, const std::string& text) {
    if (number == 0) number = ++last_note_;
    Json& note = notes_[number];
    note = note_message({number, severity, text});
    broadcast(note);
    return number;
}

void Pages::send_notes(Viewer& viewer) const {
    for (const auto& [number, note] : notes_) send(viewer, note);
}

}  // namespace espalier::studio
