// What the pages of a studio share: one document, its growths, and the requests of docs/developer/studio-protocol.md.
#pragma once

#include "espalier/studio/studio.h"

#include "studio/session/session_parts.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace espalier::studio {

/// Used on one thread. What other threads have to say comes by `post`.
class Session {
public:
    Session(const StudioOptions& options, Post post);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    void join(Page& page) { parts_.pages.join(page); }
    void leave(Page& page);
    void receive(Page& page, const std::string& text);
    /// To be called several times a second.
    void tick();
    /// The file that a reply called by this number; none if there is none.
    std::optional<std::filesystem::path> file(std::uint32_t number) const { return parts_.files.find(number); }

private:
    Post guarded(Post post);
    void guard(const std::function<void()>& work);
    void greet(Viewer& viewer);

    const std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);  ///< gone: what threads have posted is not done
    SessionParts parts_;
};

}  // namespace espalier::studio
