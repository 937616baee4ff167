#include "simulation/world/string_checkpoint.h"

#include "base/bytes.h"

#include <algorithm>

namespace espalier::simulation {
namespace {

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

void save_siblings(const SiblingTable& siblings, std::ostream& out) {
    Column<Siblings> rows;
    for (std::size_t k = 0; k < siblings.size(); ++k) rows.push_back(siblings[k]);
    put_column(out, rows);
}

void restore_siblings(SiblingTable& siblings, std::size_t& memory, std::istream& in) {
    Column<Siblings> rows;
    restore_column(rows, memory, in);
    siblings = SiblingTable().grown(rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k) siblings.added(k) = rows[k];
}

}  // namespace

void save_string(const ModuleString& string, std::ostream& out) {
    put_column(out, string.letters);
    put_column(out, string.parameters);
    put_column(out, string.births);
    save_siblings(string.siblings, out);
}

void restore_string(ModuleString& string, std::size_t memory, std::istream& in) {
    restore_column(string.letters, memory, in);
    restore_column(string.parameters, memory, in);
    restore_column(string.births, memory, in);
    restore_siblings(string.siblings, memory, in);
    for (const Birth& birth : string.births) {
        if (birth.siblings >= string.siblings.size()) throw RunError("the checkpoint's lineages are damaged");
    }
}

}  // namespace espalier::simulation
