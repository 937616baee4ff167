#include "simulation/plant/string_checkpoint.h"

#include "base/bytes.h"

namespace espalier::simulation {
namespace {

template <class T>
void restore_column(Column<T>& column, std::size_t& memory, std::istream& in) {
    const auto size = get<std::uint64_t>(in);
    if (size > memory / sizeof(T)) throw RunError("the checkpoint's strings take more than --memory allows");
    memory -= size * sizeof(T);
    if (!read_claimed(in, column, size)) throw RunError("the checkpoint ends too early");
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

void require_modules_of(const lsystem::Alphabet& alphabet, const ModuleString& string) {
    std::size_t parameters = 0;
    for (const LetterId letter : string.letters) {
        if (letter >= alphabet.size()) throw RunError("the checkpoint's strings are of another model");
        parameters += static_cast<std::size_t>(alphabet.arity(letter));
    }
    const bool has_births = string.births.empty() || string.births.size() == string.letters.size();
    if (parameters != string.parameters.size() || !has_births) {
        throw RunError("the checkpoint's strings are damaged");
    }
}

}  // namespace espalier::simulation
