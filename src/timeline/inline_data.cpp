#include "timeline/inline_data.h"

#include "timeline/lz4_block.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#endif

namespace espalier {
namespace {

/// Blocks stay in the cache.
constexpr std::size_t block_bytes = std::size_t{1} << 18;

constexpr std::size_t base64_length(std::size_t bytes) {
    return (bytes + 2) / 3 * 4;
}

// The two characters of every twelve bits.
constexpr std::array<char, 8192> base64_pairs = [] {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<char, 8192> pairs{};
    for (std::size_t i = 0; i < 4096; ++i) {
        pairs[2 * i] = digits[i >> 6];
        pairs[2 * i + 1] = digits[i & 63];
    }
    return pairs;
}();

#if defined(__x86_64__) && defined(__GNUC__)
// Muła and Lemire 2018, "Faster Base64 Encoding and Decoding using AVX2 Instructions", ACM Trans. Web 12(3), sections 3
// and 4: 24 bytes at a time, as long as 28 may be read. Returns how many bytes it has written.
__attribute__((target("avx2"))) std::size_t write_wide_base64(const unsigned char* bytes, std::size_t count,
                                                              char* out) {
    const __m256i spread = _mm256_setr_epi8(1, 0, 2, 1, 4, 3, 5, 4, 7, 6, 8, 7, 10, 9, 11, 10,  //
                                            1, 0, 2, 1, 4, 3, 5, 4, 7, 6, 8, 7, 10, 9, 11, 10);
    // What is added to a digit: a to z, ten times 0 to 9, +, /, A to Z.
    const __m256i shifts = _mm256_setr_epi8(71, -4, -4, -4, -4, -4, -4, -4, -4, -4, -4, -19, -16, 65, 0, 0,  //
                                            71, -4, -4, -4, -4, -4, -4, -4, -4, -4, -4, -19, -16, 65, 0, 0);
    std::size_t done = 0;
    for (; done + 28 <= count; done += 24, out += 32) {
        const __m128i low = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes + done));
        const __m128i high = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes + done + 12));
        const __m256i triplets = _mm256_shuffle_epi8(_mm256_set_m128i(high, low), spread);
        const __m256i odd = _mm256_and_si256(triplets, _mm256_set1_epi32(0x0fc0fc00));
        const __m256i even = _mm256_and_si256(triplets, _mm256_set1_epi32(0x003f03f0));
        const __m256i digits = _mm256_or_si256(_mm256_mulhi_epu16(odd, _mm256_set1_epi32(0x04000040)),
                                               _mm256_mullo_epi16(even, _mm256_set1_epi32(0x01000010)));
        const __m256i upper = _mm256_cmpgt_epi8(_mm256_set1_epi8(26), digits);
        const __m256i range = _mm256_or_si256(_mm256_subs_epu8(digits, _mm256_set1_epi8(51)),
                                              _mm256_and_si256(upper, _mm256_set1_epi8(13)));
        const __m256i text = _mm256_add_epi8(_mm256_shuffle_epi8(shifts, range), digits);
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), text);
    }
    return done;
}

const bool writes_wide = __builtin_cpu_supports("avx2");
#else
std::size_t write_wide_base64(const unsigned char*, std::size_t, char*) {
    return 0;
}

constexpr bool writes_wide = false;
#endif

// Whole triplets.
char* write_base64(const unsigned char* bytes, std::size_t count, char* out) {
    const std::size_t wide = writes_wide ? write_wide_base64(bytes, count, out) : 0;
    out += wide / 3 * 4;
    for (std::size_t i = wide; i < count; i += 3, out += 4) {
        const std::uint32_t bits =
            std::uint32_t{bytes[i]} << 16 | std::uint32_t{bytes[i + 1]} << 8 | std::uint32_t{bytes[i + 2]};
        std::memcpy(out, &base64_pairs[2 * std::size_t{bits >> 12}], 2);
        std::memcpy(out + 2, &base64_pairs[2 * std::size_t{bits & 4095}], 2);
    }
    return out;
}

// The last one or two bytes, if any.
char* write_base64_end(const unsigned char* bytes, std::size_t count, char* out) {
    if (count == 0) return out;
    const unsigned char triplet[3] = {bytes[0], count > 1 ? bytes[1] : static_cast<unsigned char>(0), 0};
    out = write_base64(triplet, 3, out);
    std::fill(out - (count > 1 ? 1 : 2), out, '=');
    return out;
}

/// The blocks of an array one after the other, compressed.
class Blocks {
public:
    explicit Blocks(const DataArray& array)
        : array_(array), tuples_(std::max<std::size_t>(1, block_bytes / std::max<std::size_t>(1, array.tuple_bytes))) {}

    std::size_t full() const { return tuples_ * array_.tuple_bytes; }
    std::size_t count() const { return (array_.tuples + tuples_ - 1) / tuples_; }
    std::size_t most_bytes() const { return most_lz4_bytes(std::min(full(), array_.bytes())); }

    /// Returns how many bytes it has written.
    std::size_t next(unsigned char* out) {
        const std::size_t first = done_, last = std::min(array_.tuples, done_ + tuples_), width = array_.tuple_bytes;
        done_ = last;
        if (!array_.ends.empty()) {
            return compressor_.compress_runs(array_.values, array_.ends, width, first, last, run_, out);
        }
        if (!array_.parts.empty()) {
            return compressor_.compress_parts(array_.values, array_.parts, width, first, last, run_, out);
        }
        const auto* bytes = static_cast<const unsigned char*>(array_.values);
        return compressor_.compress({bytes + first * width, (last - first) * width}, width, out);
    }

private:
    const DataArray& array_;
    Lz4Blocks compressor_;
    std::size_t tuples_;              ///< in a block
    std::size_t done_ = 0, run_ = 0;  ///< tuples; runs or parts
};

}  // namespace

void encode(const DataArray& array, Column<char>& text) {
    Blocks blocks(array);
    const std::size_t count = blocks.count();
    // What VTK calls a partial block is a last one that is not full; 0 where there is none.
    std::vector<std::uint64_t> header(3 + count);
    header[0] = count;
    header[1] = blocks.full();
    header[2] = array.bytes() % blocks.full();
    const std::size_t header_at = text.size(), header_bytes = header.size() * sizeof(std::uint64_t);
    text.resize(header_at + base64_length(header_bytes));

    Column<unsigned char> packed(2 + blocks.most_bytes());  // behind what the block before left of a triplet
    std::size_t left = 0;
    for (std::size_t block = 0; block < count; ++block) {
        const std::size_t size = blocks.next(packed.data() + left);
        header[3 + block] = size;
        const std::size_t ready = left + size, whole = ready / 3 * 3;
        const std::size_t at = text.size();
        text.resize(at + base64_length(whole));
        write_base64(packed.data(), whole, text.data() + at);
        left = ready - whole;
        std::copy_n(packed.data() + whole, left, packed.data());
    }
    const std::size_t at = text.size();
    text.resize(at + base64_length(left));
    write_base64_end(packed.data(), left, text.data() + at);

    const auto* words = reinterpret_cast<const unsigned char*>(header.data());
    const std::size_t whole = header_bytes / 3 * 3;
    write_base64_end(words + whole, header_bytes - whole, write_base64(words, whole, text.data() + header_at));
}

}  // namespace espalier
