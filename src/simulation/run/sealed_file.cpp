#include "simulation/run/sealed_file.h"

#include "espalier/base/read_log.h"

#include "base/bytes.h"

#include <algorithm>
#include <fstream>
#include <optional>

namespace espalier::simulation {
namespace {

// Returns the digest of the first `bytes` bytes, in pieces: the file may be larger than the memory.
std::optional<std::uint64_t> digest_of(std::istream& in, std::uintmax_t bytes) {
    char piece[65536];
    std::uint64_t sum = digest({});
    while (bytes > 0) {
        const std::size_t more = std::min<std::uintmax_t>(sizeof piece, bytes);
        if (!in.read(piece, static_cast<std::streamsize>(more))) return std::nullopt;
        sum = digest({piece, more}, sum);
        bytes -= more;
    }
    return sum;
}

}  // namespace

bool seal(const std::filesystem::path& path) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(path, error);
    if (error) return false;
    std::ifstream in(path, std::ios::binary);
    const std::optional<std::uint64_t> sum = digest_of(in, bytes);
    if (!sum) return false;
    std::ofstream out(path, std::ios::binary | std::ios::app);
    put(out, *sum);
    return out.flush().good();
}

bool is_sealed(const std::filesystem::path& path) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(path, error);
    if (error || bytes < sizeof(std::uint64_t)) return false;
    std::ifstream in(path, std::ios::binary);
    const std::optional<std::uint64_t> sum = digest_of(in, bytes - sizeof(std::uint64_t));
    return sum && get<std::uint64_t>(in) == *sum;
}

}  // namespace espalier::simulation
