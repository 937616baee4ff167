// The state of an environment as bytes: each process's own, behind its name and length.
#include "espalier/base/error.h"
#include "espalier/environment/environment.h"

#include <fmt/format.h>

#include <istream>
#include <ostream>
#include <sstream>

namespace espalier::environment {
namespace {

void write_block(std::ostream& out, const std::string& bytes) {
    const auto length = static_cast<std::uint64_t>(bytes.size());
    out.write(reinterpret_cast<const char*>(&length), sizeof length);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string read_block(std::istream& in) {
    std::uint64_t length = 0;
    in.read(reinterpret_cast<char*>(&length), sizeof length);
    std::string bytes;
    // In pieces: a damaged length must not ask for all the memory there is.
    char piece[65536];
    while (in && bytes.size() < length) {
        const std::size_t wanted = std::min<std::size_t>(sizeof piece, length - bytes.size());
        in.read(piece, static_cast<std::streamsize>(wanted));
        bytes.append(piece, static_cast<std::size_t>(in.gcount()));
    }
    if (!in) throw UserError("the checkpoint ends too early");
    return bytes;
}

}  // namespace

void Environment::save(std::ostream& out) const {
    for (std::size_t process = 0; process < processes_.size(); ++process) {
        std::ostringstream state;
        processes_[process]->save(state);
        write_block(out, names_[process]);
        write_block(out, state.str());
        const std::uint64_t kept = kept_[process];
        out.write(reinterpret_cast<const char*>(&kept), sizeof kept);
    }
}

void Environment::restore(std::istream& in) {
    for (std::size_t process = 0; process < processes_.size(); ++process) {
        const std::string name = read_block(in);
        if (name != names_[process]) {
            throw UserError(
                fmt::format("the checkpoint is of another scene: it holds process '{}' where the scene has "
                            "'{}'",
                            name, names_[process]));
        }
        std::istringstream state(read_block(in));
        processes_[process]->restore(state);
        std::uint64_t kept = 0;
        in.read(reinterpret_cast<char*>(&kept), sizeof kept);
        if (!in) throw UserError("the checkpoint ends too early");
        kept_[process] = kept;
    }
}

}  // namespace espalier::environment
