// The format: Collet, "LZ4 Block Format Description", github.com/lz4/lz4, doc/lz4_Block_format.md.
#include "timeline/lz4_block.h"

#include "espalier/base/error.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace espalier {
namespace {

constexpr std::size_t shortest_match = 4;
constexpr std::size_t farthest = 65535;
/// The last match begins so many bytes before the end, and the last five bytes are no match: none reaches so far.
constexpr std::size_t without_match = 12;
constexpr std::size_t most_slots = 4096;
/// After so many units that were new, every second is tried, then every third, ...
constexpr std::size_t patience = 64;

/// Writes one sequence after the other: bytes as they are, then some that repeat those `offset` before.
class Sequences {
public:
    explicit Sequences(unsigned char* out) : begin_(out), out_(out) {}

    void add(const unsigned char* literals, std::size_t count, std::size_t offset, std::size_t length) {
        unsigned char* token = out_++;
        *token = static_cast<unsigned char>(nibble(count) << 4 | nibble(length - shortest_match));
        add_rest(count);
        copy(literals, count);
        *out_++ = static_cast<unsigned char>(offset);
        *out_++ = static_cast<unsigned char>(offset >> 8);
        add_rest(length - shortest_match);
    }

    /// The last sequence has no match. Returns the bytes of the block.
    std::size_t end(const unsigned char* literals, std::size_t count) {
        *out_++ = static_cast<unsigned char>(nibble(count) << 4);
        add_rest(count);
        copy(literals, count);
        return static_cast<std::size_t>(out_ - begin_);
    }

private:
    static unsigned nibble(std::size_t length) { return static_cast<unsigned>(std::min<std::size_t>(length, 15)); }
    void add_rest(std::size_t length) {
        if (length < 15) return;
        for (length -= 15; length >= 255; length -= 255) *out_++ = 255;
        *out_++ = static_cast<unsigned char>(length);
    }
    void copy(const unsigned char* literals, std::size_t count) {
        if (count == 0) return;
        std::memcpy(out_, literals, count);
        out_ += count;
    }

    unsigned char* const begin_;
    unsigned char* out_;
};

template <std::size_t Width>
std::uint64_t hash_of(const unsigned char* bytes) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, std::min<std::size_t>(Width, 8));
    if constexpr (Width > 8) {
        std::uint64_t rest = 0;
        std::memcpy(&rest, bytes + 8, Width - 8);
        word ^= rest * 0xC2B2AE3D27D4EB4F;
    }
    return word * 0x9E3779B185EBCA87;
}

/// How many bytes at `a` and `b` are the same, before `end` of `a`.
std::size_t common(const unsigned char* a, const unsigned char* b, const unsigned char* end) {
    const unsigned char* const begin = a;
    while (end - a >= 8) {
        std::uint64_t x, y;
        std::memcpy(&x, a, 8);
        std::memcpy(&y, b, 8);
        if (x != y) {
            if constexpr (std::endian::native != std::endian::little) break;
            return static_cast<std::size_t>(a - begin) + static_cast<std::size_t>(std::countr_zero(x ^ y)) / 8;
        }
        a += 8;
        b += 8;
    }
    while (a < end && *a == *b) ++a, ++b;
    return static_cast<std::size_t>(a - begin);
}

/// Bits of a hash that number the slots of a table for so many things.
int slot_bits(std::size_t things) {
    return static_cast<int>(std::bit_width(std::clamp<std::size_t>(things, 16, most_slots) - 1));
}

/// Sequences of an array of runs. What is not yet written: some literals and the match behind them.
class RunSequences {
public:
    /// `room` is for as many literals as there may be.
    RunSequences(unsigned char* out, unsigned char* room) : out_(out), literals_(room) {}

    template <std::size_t Width>
    void add_literal(const unsigned char* tuple) {
        if (length_ > 0) flush();
        std::memcpy(literals_ + count_, tuple, Width);
        count_ += Width;
    }
    void add_match(std::size_t offset, std::size_t length) {
        if (length_ > 0 && offset != offset_) flush();
        offset_ = offset;
        length_ += length;
    }
    std::size_t end() {
        if (length_ > 0) flush();
        return out_.end(literals_, count_);
    }

private:
    void flush() {
        out_.add(literals_, count_, offset_, length_);
        count_ = length_ = 0;
    }

    Sequences out_;
    unsigned char* const literals_;
    std::size_t count_ = 0, offset_ = 0, length_ = 0;
};

}  // namespace

template <std::size_t Unit>
std::size_t Lz4Blocks::compress_units(std::span<const unsigned char> bytes, unsigned char* out) {
    Sequences sequences(out);
    const unsigned char* const data = bytes.data();
    const std::size_t end = bytes.size() > without_match ? bytes.size() - without_match : 0, units = end / Unit;
    const int bits = slot_bits(units);
    units_.assign(std::size_t{1} << bits, 0);
    std::uint32_t* const seen = units_.data();
    std::size_t written = 0, unit = 0, misses = 0;
    while (unit < units) {
        const std::size_t at = unit * Unit;
        std::uint32_t& slot = seen[hash_of<Unit>(data + at) >> (64 - bits)];
        const std::size_t before = slot;
        slot = static_cast<std::uint32_t>(at + 1);
        if (before == 0 || at + 1 - before > farthest || std::memcmp(data + before - 1, data + at, Unit) != 0) {
            unit += 1 + misses++ / patience;
            continue;
        }
        const std::size_t length = Unit + common(data + at + Unit, data + before - 1 + Unit, data + end);
        sequences.add(data + written, at - written, at + 1 - before, length);
        written = at + length;
        unit = (written + Unit - 1) / Unit;
        misses = 0;
    }
    return sequences.end(data + written, bytes.size() - written);
}

std::size_t Lz4Blocks::compress(std::span<const unsigned char> bytes, std::size_t tuple_bytes, unsigned char* out) {
    if (tuple_bytes == 12) return compress_units<12>(bytes, out);
    if (tuple_bytes % 8 == 0) return compress_units<8>(bytes, out);
    return compress_units<4>(bytes, out);
}

template <std::size_t Unit>
std::size_t Lz4Blocks::compress_parts_of(std::span<const unsigned char> bytes, std::span<const std::uint32_t> ends,
                                         std::size_t first, std::size_t& part, unsigned char* out) {
    Sequences sequences(out);
    const unsigned char* const data = bytes.data();
    const std::size_t end = bytes.size() > without_match ? bytes.size() - without_match : 0, units = end / Unit;
    const int bits = slot_bits(units);
    units_.assign(std::size_t{1} << bits, 0);
    std::uint32_t* const seen = units_.data();
    std::size_t written = 0;
    for (std::size_t unit = 0; unit < units; unit = ends[part++] - first) {
        const std::size_t at = unit * Unit;
        if (at >= written) {
            std::uint32_t& slot = seen[hash_of<Unit>(data + at) >> (64 - bits)];
            const std::size_t before = std::exchange(slot, static_cast<std::uint32_t>(at + 1));
            const bool is_known =
                before != 0 && at + 1 - before <= farthest && std::memcmp(data + before - 1, data + at, Unit) == 0;
            const std::size_t from = is_known ? at : at + Unit, offset = is_known ? at + 1 - before : Unit;
            const std::size_t length = common(data + from, data + from - offset, data + end);
            if (length >= Unit) {
                sequences.add(data + written, from - written, offset, length);
                written = from + length;
            }
        }
        if (ends[part] - first >= units) break;
    }
    const std::size_t last = first + bytes.size() / Unit;
    while (part < ends.size() && ends[part] <= last) ++part;
    return sequences.end(data + written, bytes.size() - written);
}

std::size_t Lz4Blocks::compress_parts(const void* values, std::span<const std::uint32_t> ends, std::size_t tuple_bytes,
                                      std::size_t first, std::size_t last, std::size_t& part, unsigned char* out) {
    const auto* const tuples = static_cast<const unsigned char*>(values);
    const std::span<const unsigned char> bytes(tuples + first * tuple_bytes, (last - first) * tuple_bytes);
    switch (tuple_bytes) {
        case 4:
            return compress_parts_of<4>(bytes, ends, first, part, out);
        case 8:
            return compress_parts_of<8>(bytes, ends, first, part, out);
        case 12:
            return compress_parts_of<12>(bytes, ends, first, part, out);
        default:
            throw RunError("an array of parts with tuples of a width that is never written");
    }
}

template <std::size_t Width>
std::size_t Lz4Blocks::compress_runs_of(const void* values, std::span<const std::uint32_t> ends, std::size_t first,
                                        std::size_t last, std::size_t& run, unsigned char* out) {
    literals_.resize((last - first) * Width);
    RunSequences sequences(out, literals_.data());
    const auto* const tuples = static_cast<const unsigned char*>(values);
    constexpr std::size_t alone = (without_match + Width - 1) / Width;
    const std::size_t end = last - first > alone ? last - alone : first;
    const int bits = slot_bits(end - first);
    runs_.assign(std::size_t{1} << bits, Seen{});
    std::size_t tuple = first;
    while (tuple < end) {
        const std::size_t begin = (tuple - first) * Width;
        const unsigned char* const value = tuples + run * Width;
        while (ends[run] < end && std::memcmp(value, tuples + (run + 1) * Width, Width) == 0) ++run;
        tuple = std::min<std::size_t>(ends[run], end);
        if (tuple == ends[run]) ++run;
        const std::size_t bytes = (tuple - first) * Width - begin;
        const Seen now{value, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(bytes)};
        const Seen before = std::exchange(runs_[hash_of<Width>(value) >> (64 - bits)], now);
        if (bytes >= shortest_match && before.bytes >= bytes && begin - before.begin <= farthest &&
            std::memcmp(before.value, value, Width) == 0) {
            sequences.add_match(begin - before.begin, bytes);
            continue;
        }
        sequences.add_literal<Width>(value);
        if (bytes - Width >= shortest_match) {
            sequences.add_match(Width, bytes - Width);
        } else {
            for (std::size_t more = Width; more < bytes; more += Width) sequences.add_literal<Width>(value);
        }
    }
    for (; tuple < last; ++tuple) {
        sequences.add_literal<Width>(tuples + run * Width);
        if (tuple + 1 == ends[run]) ++run;
    }
    return sequences.end();
}

std::size_t Lz4Blocks::compress_runs(const void* values, std::span<const std::uint32_t> ends, std::size_t tuple_bytes,
                                     std::size_t first, std::size_t last, std::size_t& run, unsigned char* out) {
    switch (tuple_bytes) {
        case 1:
            return compress_runs_of<1>(values, ends, first, last, run, out);
        case 2:
            return compress_runs_of<2>(values, ends, first, last, run, out);
        case 3:
            return compress_runs_of<3>(values, ends, first, last, run, out);
        case 4:
            return compress_runs_of<4>(values, ends, first, last, run, out);
        case 8:
            return compress_runs_of<8>(values, ends, first, last, run, out);
        default:
            throw RunError("an array of runs with tuples of a width that is never written");
    }
}

}  // namespace espalier
