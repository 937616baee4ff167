#include "timeline/files/inline_data.h"

#include "base/base64.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <lz4.h>
#include <vector>
#include <zlib.h>

namespace espalier::timeline {
namespace {

/// Blocks stay in the cache.
constexpr std::size_t block_bytes = std::size_t{1} << 18;

/// The blocks of an array one after the other, compressed.
class Blocks {
public:
    Blocks(const DataArray& array, Compression compression)
        : array_(array),
          compression_(compression),
          tuples_(std::max<std::size_t>(1, block_bytes / std::max<std::size_t>(1, array.tuple_bytes))) {
        if (!array.ends.empty()) expanded_.resize(std::min(full(), array.bytes()));
    }

    std::size_t full() const { return tuples_ * array_.tuple_bytes; }
    std::size_t count() const { return (array_.tuples + tuples_ - 1) / tuples_; }
    std::size_t most_bytes() const {
        const std::size_t bytes = std::min(full(), array_.bytes());
        if (compression_ == Compression::zlib) return compressBound(bytes);
        return static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(bytes)));
    }

    /// Returns how many bytes it has written.
    std::size_t next(unsigned char* out) {
        const std::size_t first = done_, last = std::min(array_.tuples, done_ + tuples_), width = array_.tuple_bytes;
        done_ = last;
        const char* bytes = static_cast<const char*>(array_.values) + first * width;
        if (!array_.ends.empty()) bytes = expand_runs(first, last);
        return compress(bytes, (last - first) * width, out);
    }

private:
    /// As small as at 1, and fastest: beyond it LZ4 steps over the normals that the corners of a flat leaf share.
    static constexpr int acceleration = 2;
    /// Higher levels take twice the time for 2 % of the bytes.
    static constexpr int level = 1;

    std::size_t compress(const char* bytes, std::size_t count, unsigned char* out) const {
        if (compression_ == Compression::lz4) {
            return static_cast<std::size_t>(LZ4_compress_fast(bytes, reinterpret_cast<char*>(out),
                                                              static_cast<int>(count), static_cast<int>(most_bytes()),
                                                              acceleration));
        }
        uLongf size = most_bytes();
        if (compress2(out, &size, reinterpret_cast<const Bytef*>(bytes), count, level) != Z_OK) throw std::bad_alloc();
        return size;
    }

    const char* expand_runs(std::size_t first, std::size_t last) {
        const std::size_t width = array_.tuple_bytes;
        char* out = expanded_.data();
        for (std::size_t tuple = first; tuple < last;) {
            const std::size_t end = std::min<std::size_t>(array_.ends[run_], last), bytes = (end - tuple) * width;
            fill(out, static_cast<const char*>(array_.values) + run_ * width, width, bytes);
            out += bytes;
            tuple = end;
            if (end == array_.ends[run_]) ++run_;
        }
        return expanded_.data();
    }

    /// Copies of a tuple: each copy doubles what there is.
    static void fill(char* out, const char* tuple, std::size_t width, std::size_t bytes) {
        if (bytes == 0) return;
        std::memcpy(out, tuple, width);
        for (std::size_t done = width; done < bytes; done *= 2)
            std::memcpy(out + done, out, std::min(done, bytes - done));
    }

    const DataArray& array_;
    const Compression compression_;
    std::size_t tuples_;              ///< in a block
    std::size_t done_ = 0, run_ = 0;  ///< tuples, runs
    Column<char> expanded_;           ///< a block of an array of runs
};

}  // namespace

void encode(const DataArray& array, Compression compression, Column<char>& text) {
    Blocks blocks(array, compression);
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

}  // namespace espalier::timeline
