#include "studio/server/frame_texts.h"

#include "espalier/base/error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <lzma.h>

namespace espalier::studio {
namespace {

constexpr std::size_t most_pending = 8;  // groups that wait for a thread, in memory as they are

}  // namespace

std::string in_letters(std::string_view bytes) {
    std::string text;
    text.reserve(bytes.size() / 4 * 5 + 5);
    for (std::size_t from = 0; from < bytes.size(); from += 4) {
        const std::size_t count = std::min<std::size_t>(4, bytes.size() - from);
        std::uint32_t number = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            number = number << 8 | (i < count ? static_cast<unsigned char>(bytes[from + i]) : 0u);
        }
        std::array<char, 5> five;
        for (std::size_t i = 5; i-- > 0; number /= 85) five[i] = page_letters[number % 85];
        text.append(five.data(), count + 1);
    }
    return text;
}

std::string packed_by_xz(std::string_view bytes) {
    lzma_options_lzma options;
    lzma_lzma_preset(&options, 1);  // what searches longer takes twice the time for 6 % less
    options.mf = LZMA_MF_HC4;
    options.depth = 4;
    options.nice_len = 273;
    // Several frames; a larger one than the bytes costs memory and nothing else.
    options.dict_size = static_cast<std::uint32_t>(std::clamp<std::size_t>(bytes.size(), 1 << 12, 1 << 24));
    options.lc = 1;
    options.lp = options.pb = 2;  // numbers of four bytes
    const std::array<lzma_filter, 2> filters{{{LZMA_FILTER_LZMA2, &options}, {LZMA_VLI_UNKNOWN, nullptr}}};
    std::string packed(lzma_stream_buffer_bound(bytes.size()), '\0');
    std::size_t size = 0;
    const lzma_ret end =
        lzma_stream_buffer_encode(const_cast<lzma_filter*>(filters.data()), LZMA_CHECK_CRC32, nullptr,
                                  reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(),
                                  reinterpret_cast<std::uint8_t*>(packed.data()), &size, packed.size());
    if (end != LZMA_OK) throw RunError("there is no memory to pack the frames of a page");
    packed.resize(size);
    return packed;
}

void FrameTexts::add(std::string_view bytes) {
    const auto length = static_cast<std::uint32_t>(bytes.size());
    for (int byte = 0; byte < 4; ++byte) group_ += static_cast<char>(length >> (8 * byte) & 0xFF);
    group_ += bytes;
    if (++frames_ < together) return;
    pending_.push_back(std::move(group_));
    group_.clear();
    frames_ = 0;
    if (pending_.size() == most_pending) pack_pending();
}

std::vector<std::string> FrameTexts::take() {
    if (frames_ > 0) pending_.push_back(std::move(group_));
    pack_pending();
    return std::move(texts_);
}

void FrameTexts::pack_pending() {
    const std::size_t first = texts_.size();
    texts_.resize(first + pending_.size());
    tbb::parallel_for(std::size_t{0}, pending_.size(),
                      [&](std::size_t i) { texts_[first + i] = in_letters(packed_by_xz(pending_[i])); });
    pending_.clear();
}

}  // namespace espalier::studio
