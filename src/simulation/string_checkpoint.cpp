#include "string_checkpoint.h"

#include "espalier/base/bytes.h"

#include <algorithm>

namespace espalier {
namespace {

template <class T>
void save_column(const Column<T>& column, std::ostream& out) {
    put(out, static_cast<std::uint64_t>(column.size()));
    out.write(reinterpret_cast<const char*>(column.data()), static_cast<std::streamsize>(column.size() * sizeof(T)));
}

// In pieces: a damaged length must not ask for memory that its bytes do not fill.
template <class T>
void restore_column(Column<T>& column, std::size_t& memory, std::istream& in) {
    constexpr std::size_t piece = std::size_t(1) << 20;
    const auto size = get<std::uint64_t>(in);
    if (size > memory / sizeof(T)) throw RunError("the checkpoint's strings take more than --memory allows");
    memory -= size * sizeof(T);
    column.clear();
    while (column.size() < size) {
        const std::size_t begin = column.size(), more = std::min<std::size_t>(piece, size - begin);
        column.resize(begin + more);
        const auto bytes = static_cast<std::streamsize>(more * sizeof(T));
        if (!in.read(reinterpret_cast<char*>(column.data() + begin), bytes)) {
            throw RunError("the checkpoint ends too early");
        }
    }
}

}  // namespace

void save_string(const ModuleString& string, std::ostream& out) {
    save_column(string.letters, out);
    save_column(string.parameters, out);
    save_column(string.identities, out);
    save_column(string.parents, out);
    save_column(string.births, out);
}

void restore_string(ModuleString& string, std::size_t memory, std::istream& in) {
    restore_column(string.letters, memory, in);
    restore_column(string.parameters, memory, in);
    restore_column(string.identities, memory, in);
    restore_column(string.parents, memory, in);
    restore_column(string.births, memory, in);
}

}  // namespace espalier
