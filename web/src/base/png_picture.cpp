// PNG pictures read without libpng: chunks, deflate (RFC 1951) and the filters of rows (ISO/IEC 15948).
#include "base/picture_bytes.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>

namespace espalier {
namespace {

/// A code of Huffman, looked through by the length of its words (RFC 1951, section 3.2.2).
class Code {
public:
    explicit Code(const std::vector<std::uint8_t>& lengths) {
        for (const std::uint8_t length : lengths) ++counts_[length];
        counts_[0] = 0;
        std::array<std::uint16_t, 16> next{};
        for (std::size_t length = 1; length + 1 < next.size(); ++length)
            next[length + 1] = next[length] + counts_[length];
        symbols_.resize(lengths.size());
        for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
            if (lengths[symbol] > 0) symbols_[next[lengths[symbol]]++] = static_cast<std::uint16_t>(symbol);
        }
    }

    /// `bit` gives the next bit. -1: no word of the code.
    template <class NextBit>
    int read(const NextBit& bit) const {
        int word = 0, first = 0, index = 0;
        for (std::size_t length = 1; length < counts_.size(); ++length) {
            word |= bit();
            const int count = counts_[length];
            if (word - first < count) return symbols_[static_cast<std::size_t>(index + word - first)];
            index += count;
            first = (first + count) << 1;
            word <<= 1;
        }
        return -1;
    }

private:
    std::array<std::uint16_t, 16> counts_{};
    std::vector<std::uint16_t> symbols_;
};

class Inflater {
public:
    Inflater(const PictureBytes& picture, std::string packed, std::size_t most)
        : picture_(picture), packed_(std::move(packed)), most_(most) {}

    /// Of the form of zlib; more than `most` bytes are not wanted.
    std::string bytes() {
        at_ = 2;
        bool is_last = false;
        while (!is_last && out_.size() < most_) {
            is_last = bits(1) != 0;
            const unsigned kind = bits(2);
            if (kind == 0) {
                take_stored();
            } else if (kind == 1) {
                take_fixed();
            } else if (kind == 2) {
                take_dynamic();
            } else {
                damaged();
            }
        }
        return std::move(out_);
    }

private:
    [[noreturn]] void damaged() const { picture_.fail("the picture is damaged"); }
    unsigned byte() {
        if (at_ >= packed_.size()) picture_.fail("the picture ends too early");
        return static_cast<std::uint8_t>(packed_[at_++]);
    }
    unsigned bits(unsigned count) {
        while (held_ < count) {
            buffer_ |= byte() << held_;
            held_ += 8;
        }
        const unsigned value = buffer_ & ((1U << count) - 1);
        buffer_ >>= count;
        held_ -= count;
        return value;
    }
    unsigned symbol(const Code& code) {
        const int found = code.read([this] { return static_cast<int>(bits(1)); });
        if (found < 0) damaged();
        return static_cast<unsigned>(found);
    }

    void take_stored() {
        buffer_ = held_ = 0;
        const unsigned low = byte(), size = low | byte() << 8;
        at_ += 2;
        for (unsigned i = 0; i < size; ++i) out_ += static_cast<char>(byte());
    }

    void take_fixed() {
        std::vector<std::uint8_t> lengths(288, 8);
        std::fill(lengths.begin() + 144, lengths.begin() + 256, 9);
        std::fill(lengths.begin() + 256, lengths.begin() + 280, 7);
        take_coded(Code(lengths), Code(std::vector<std::uint8_t>(30, 5)));
    }

    void take_dynamic() {
        constexpr std::array<std::uint8_t, 19> order{16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
        const unsigned literals = bits(5) + 257, distances = bits(5) + 1, count = bits(4) + 4;
        std::vector<std::uint8_t> lengths(order.size());
        for (unsigned i = 0; i < count; ++i) lengths[order[i]] = static_cast<std::uint8_t>(bits(3));
        const Code of_lengths(lengths);
        lengths.clear();
        while (lengths.size() < literals + distances) add_lengths(lengths, symbol(of_lengths));
        const auto middle = lengths.begin() + literals;
        take_coded(Code({lengths.begin(), middle}), Code({middle, lengths.begin() + literals + distances}));
    }

    void add_lengths(std::vector<std::uint8_t>& lengths, unsigned symbol) {
        if (symbol < 16) {
            lengths.push_back(static_cast<std::uint8_t>(symbol));
        } else if (symbol == 16) {
            if (lengths.empty()) damaged();
            lengths.insert(lengths.end(), 3 + bits(2), std::uint8_t{lengths.back()});
        } else {
            lengths.insert(lengths.end(), symbol == 17 ? 3 + bits(3) : 11 + bits(7), std::uint8_t{0});
        }
    }

    void take_coded(const Code& literals, const Code& distances) {
        for (unsigned found = symbol(literals); found != 256 && out_.size() < most_; found = symbol(literals)) {
            if (found < 256) {
                out_ += static_cast<char>(found);
            } else {
                copy(found - 257, distances);
            }
        }
    }

    void copy(unsigned symbol_of_length, const Code& distances) {
        constexpr std::array<std::uint16_t, 29> shortest{3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                                         15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                                         67, 83, 99, 115, 131, 163, 195, 227, 258};
        constexpr std::array<std::uint8_t, 29> more{0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                                    2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
        if (symbol_of_length >= shortest.size()) damaged();
        const unsigned length = shortest[symbol_of_length] + bits(more[symbol_of_length]);
        const unsigned far = symbol(distances);
        if (far >= 30) damaged();
        const unsigned extra = far < 4 ? 0 : far / 2 - 1;
        const unsigned distance = (far < 4 ? far : (2 + far % 2) << extra) + 1 + bits(extra);
        if (distance > out_.size()) damaged();
        for (unsigned i = 0; i < length; ++i) out_ += out_[out_.size() - distance];
    }

    const PictureBytes& picture_;
    std::string packed_, out_;
    std::size_t most_, at_ = 0;
    unsigned buffer_ = 0, held_ = 0;
};

enum ColourType { grey = 0, rgb = 2, palette = 3, grey_with_opacity = 4, rgb_with_opacity = 6 };

struct Chunks {
    std::size_t width = 0, height = 0;
    unsigned depth = 8, type = grey;
    bool is_interlaced = false;
    std::string colours, opacities, packed;
    bool has_opacities = false;

    std::size_t channels() const {
        switch (type) {
            case rgb:
                return 3;
            case grey_with_opacity:
                return 2;
            case rgb_with_opacity:
                return 4;
            default:
                return 1;
        }
    }
    std::size_t bits_of_pixel() const { return std::clamp<std::size_t>(channels() * depth, 1, 64); }
    std::size_t row_bytes(std::size_t pixels) const { return (pixels * bits_of_pixel() + 7) / 8; }
};

Chunks chunks_of(const PictureBytes& bytes, std::size_t most) {
    Chunks chunks;
    for (std::size_t at = png_signature.size();;) {
        const std::size_t size = bytes.big4(at), content = at + 8;
        if (size > bytes.size() || content + size + 4 > bytes.size()) bytes.fail("the picture ends too early");
        const std::string_view type(bytes.data() + at + 4, 4);
        if (type == "IHDR") {
            chunks.width = bytes.big4(content);
            chunks.height = bytes.big4(content + 4);
            chunks.depth = bytes.at(content + 8);
            chunks.type = bytes.at(content + 9);
            chunks.is_interlaced = bytes.at(content + 12) != 0;
            constexpr std::size_t most_packed = 1100;  // deflate packs 1032 bytes into one at most
            bytes.require_size(chunks.width, chunks.height, most_packed * 8 / chunks.bits_of_pixel(), most);
        } else if (type == "PLTE") {
            chunks.colours.assign(bytes.data() + content, size);
        } else if (type == "tRNS") {
            chunks.opacities.assign(bytes.data() + content, size);
            chunks.has_opacities = true;
        } else if (type == "IDAT") {
            chunks.packed.append(bytes.data() + content, size);
        } else if (type == "IEND") {
            return chunks;
        }
        at = content + size + 4;
    }
}

int nearest_of(int left, int up, int corner) {
    const int estimate = left + up - corner;
    const int to_left = std::abs(estimate - left), to_up = std::abs(estimate - up);
    const int to_corner = std::abs(estimate - corner);
    return to_left <= to_up && to_left <= to_corner ? left : to_up <= to_corner ? up : corner;
}

/// Undoes a row's filter; the row before it is plain already.
void unfilter(unsigned filter, std::uint8_t* row, const std::uint8_t* before, std::size_t size, std::size_t pixel) {
    for (std::size_t i = 0; i < size; ++i) {
        const int left = i >= pixel ? row[i - pixel] : 0, up = before ? before[i] : 0;
        const int corner = i >= pixel && before ? before[i - pixel] : 0;
        const int added = filter == 1   ? left
                          : filter == 2 ? up
                          : filter == 3 ? (left + up) / 2
                          : filter == 4 ? nearest_of(left, up, corner)
                                        : 0;
        row[i] = static_cast<std::uint8_t>(row[i] + added);
    }
}

/// The picture in the making.
class Rows {
public:
    Rows(const PictureBytes& bytes, const Chunks& chunks, PngOpacity opacity) : bytes_(bytes), chunks_(chunks) {
        const bool has_palette = chunks.type == palette;
        const bool has_colours = has_palette || chunks.type == rgb || chunks.type == rgb_with_opacity;
        const bool has_opacity =
            chunks.has_opacities || chunks.type == grey_with_opacity || chunks.type == rgb_with_opacity;
        picture_.width = chunks.width;
        picture_.height = chunks.height;
        picture_.channels = (has_colours ? 3u : 1u) + (has_opacity && opacity == PngOpacity::kept ? 1u : 0u);
        picture_.greatest = chunks.depth == 16 ? 65535 : 255;
        picture_.samples.resize(picture_.width * picture_.height * picture_.channels);
    }

    void set(std::size_t x, std::size_t y, const std::uint8_t* row, std::size_t place) {
        std::uint16_t* to = &picture_.samples[(y * picture_.width + x) * picture_.channels];
        if (chunks_.type == palette) return set_of_palette(to, sample(row, place, 0));
        const std::size_t colours = picture_.channels - (picture_.has_opacity() ? 1 : 0);
        bool is_key = chunks_.has_opacities && chunks_.opacities.size() >= 2 * colours;
        for (std::size_t k = 0; k < colours; ++k) {
            const unsigned value = sample(row, place, k);
            is_key = is_key && value == key(k);
            const unsigned greatest = (1U << chunks_.depth) - 1;
            to[k] = static_cast<std::uint16_t>(chunks_.depth < 8 ? value * 255 / greatest : value);
        }
        if (!picture_.has_opacity()) return;
        to[colours] = static_cast<std::uint16_t>(chunks_.has_opacities ? (is_key ? 0 : picture_.greatest)
                                                                       : sample(row, place, colours));
    }

    PngPicture take() { return std::move(picture_); }

private:
    unsigned sample(const std::uint8_t* row, std::size_t place, std::size_t channel) const {
        const std::size_t number = place * chunks_.channels() + channel;
        if (chunks_.depth == 16) return 256U * row[2 * number] + row[2 * number + 1];
        const std::size_t bit = number * chunks_.depth;
        return row[bit / 8] >> (8 - chunks_.depth - bit % 8) & ((1U << chunks_.depth) - 1);
    }
    unsigned key(std::size_t channel) const {
        const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(chunks_.opacities[i]); };
        return 256U * byte(2 * channel) + byte(2 * channel + 1);
    }
    void set_of_palette(std::uint16_t* to, unsigned index) const {
        if (3 * index + 2 >= chunks_.colours.size()) bytes_.fail("the picture uses a colour that its palette lacks");
        for (std::size_t k = 0; k < 3; ++k) to[k] = static_cast<std::uint8_t>(chunks_.colours[3 * index + k]);
        if (!picture_.has_opacity()) return;
        to[3] = index < chunks_.opacities.size() ? static_cast<std::uint8_t>(chunks_.opacities[index]) : 255;
    }

    const PictureBytes& bytes_;
    const Chunks& chunks_;
    PngPicture picture_;
};

/// Where the pixels of a pass lie: interlaced pictures have seven, others one.
struct Pass {
    std::size_t x, y, x_step, y_step;
};
constexpr std::array<Pass, 7> interlaced{
    {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}};
constexpr std::array<Pass, 1> in_one{{{0, 0, 1, 1}}};

}  // namespace

PngPicture read_png(const PictureBytes& bytes, PngOpacity opacity, std::size_t most) {
    if (!bytes.begins_with(png_signature)) bytes.fail("this is no PNG picture");
    const Chunks chunks = chunks_of(bytes, most);
    const std::size_t enough = (chunks.row_bytes(chunks.width) + 1) * chunks.height * 2 + 64;
    std::string plain = Inflater(bytes, chunks.packed, enough).bytes();
    auto* at = reinterpret_cast<std::uint8_t*>(plain.data());
    const auto* const end = at + plain.size();
    Rows rows(bytes, chunks, opacity);
    const std::span<const Pass> passes =
        chunks.is_interlaced ? std::span<const Pass>(interlaced) : std::span<const Pass>(in_one);
    for (const Pass& pass : passes) {
        if (pass.x >= chunks.width) continue;
        const std::size_t pixels = (chunks.width - pass.x + pass.x_step - 1) / pass.x_step;
        const std::size_t size = chunks.row_bytes(pixels), pixel = std::max<std::size_t>(1, chunks.bits_of_pixel() / 8);
        const std::uint8_t* before = nullptr;
        for (std::size_t y = pass.y; y < chunks.height; y += pass.y_step) {
            if (static_cast<std::size_t>(end - at) < size + 1) bytes.fail("the picture ends too early");
            unfilter(*at, at + 1, before, size, pixel);
            for (std::size_t i = 0; i < pixels; ++i) rows.set(pass.x + i * pass.x_step, y, at + 1, i);
            before = at + 1;
            at += size + 1;
        }
    }
    return rows.take();
}

}  // namespace espalier
