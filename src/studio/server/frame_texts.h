// What a page tells of many frames, a few together in one text: what stays from frame to frame is packed once.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::studio {

/// Letters that need no escape in a page or in JSON, with which texts are written.
inline constexpr std::string_view page_letters =
    "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%()*+,-./:;=?@[]^_{|";

/// Four bytes in five letters, the first the greatest; fewer bytes at the end in one letter more.
std::string in_letters(std::string_view bytes);
/// The format of xz. Throws RunError if there is no memory for it.
std::string packed_by_xz(std::string_view bytes);

/// Texts, each with so many frames.
class FrameTexts {
public:
    static constexpr std::size_t together = 8;

    /// Bytes of the next frame. Those of `together` frames make a text: each behind its length, u32, packed.
    void add(std::string_view bytes);
    std::vector<std::string> take();

private:
    void pack_pending();

    std::string group_;
    std::size_t frames_ = 0;            ///< in `group_`
    std::vector<std::string> pending_;  ///< groups that are packed together, each on a thread
    std::vector<std::string> texts_;
};

}  // namespace espalier::studio
