// The pages of a session, and the notes that all of them show.
#pragma once

#include "studio/session/message.h"
#include "studio/session/page.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace espalier::studio {

struct Note {
    static constexpr TypeName type{"Note", "a note that stays until it is dismissed, or another of its number comes"};
    std::uint32_t number = 0;
    std::string severity, text;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("number", self.number, "of the note, to dismiss it");
        field("severity", self.severity, "how grave it is", one_of("error warning note"));
        field("text", self.text, "what models print is a note, too");
    }
};

class Pages {
public:
    Viewer& join(Page& page);
    void leave(const Page& page);
    /// Null if it has left.
    Viewer* find(const Page* page);
    const std::vector<std::unique_ptr<Viewer>>& all() const { return viewers_; }

    void broadcast(const Json& message);
    static void send(Viewer& viewer, const Json& message);

    void notify(const std::string& severity, const std::string& text) { replace_note(0, severity, text); }
    /// Says it instead of the note of this number; 0: as a new one. Returns the number of the note.
    std::uint32_t replace_note(std::uint32_t number, const std::string& severity, const std::string& text);
    void dismiss(std::uint32_t number) { notes_.erase(number); }
    void send_notes(Viewer& viewer) const;

private:
    std::vector<std::unique_ptr<Viewer>> viewers_;
    std::map<std::uint32_t, Json> notes_;
    std::uint32_t last_note_ = 0;
};

}  // namespace espalier::studio
