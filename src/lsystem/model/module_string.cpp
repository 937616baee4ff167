#include "espalier/lsystem/module_string.h"

#include "base/text.h"

namespace espalier::lsystem {
namespace {

template <class T>
std::size_t filled(const Column<T>& column) {
    return column.size() * sizeof(T);
}

template <class T>
std::size_t held(const Column<T>& column) {
    return column.capacity() * sizeof(T);
}

}  // namespace

void ModuleString::clear() {
    letters.clear();
    parameters.clear();
    births.clear();
    siblings.clear();
}

void ModuleString::append(LetterId letter, std::span<const double> values) {
    letters.push_back(letter);
    parameters.insert(parameters.end(), values.begin(), values.end());
}

std::size_t ModuleString::content() const {
    return filled(letters) + filled(parameters) + filled(births) + siblings.bytes();
}

std::size_t ModuleString::bytes() const {
    return held(letters) + held(parameters) + held(births) + siblings.bytes();
}

std::vector<std::size_t> parameter_offsets(const ModuleString& string, const Alphabet& alphabet) {
    std::vector<std::size_t> offsets(string.size() + 1);
    std::size_t at = 0;
    for (std::size_t i = 0; i < string.size(); ++i) {
        offsets[i] = at;
        at += alphabet.arity(string.letters[i]);
    }
    offsets.back() = at;
    return offsets;
}

std::string to_text(const ModuleString& string, const Alphabet& alphabet) {
    std::string text;
    text.reserve(string.size() + 8 * string.parameters.size());
    const double* value = string.parameters.data();
    for (const LetterId letter : string.letters) {
        text += alphabet.name(letter);
        const int arity = alphabet.arity(letter);
        for (int k = 0; k < arity; ++k) {
            text += k == 0 ? '(' : ',';
            text += format_general(*value++);
        }
        if (arity > 0) text += ')';
    }
    return text;
}

void link_branches(const ModuleString& string, BranchLinks& links) {
    links.partner.resize(string.size());
    std::uint32_t* partner = links.partner.data();
    std::uint32_t open =
        BranchLinks::none;  // innermost open bracket; until it closes, its entry holds the one around it
    for (std::size_t i = 0; i < string.size(); ++i) {
        const LetterId letter = string.letters[i];
        partner[i] = open;
        if (letter == Alphabet::open_bracket) {
            open = static_cast<std::uint32_t>(i);
        } else if (letter == Alphabet::close_bracket && open != BranchLinks::none) {
            const std::uint32_t around = partner[open];
            partner[open] = static_cast<std::uint32_t>(i);
            open = around;
        }
    }
    while (open != BranchLinks::none) {
        const std::uint32_t around = partner[open];
        partner[open] = BranchLinks::none;
        open = around;
    }
}

}  // namespace espalier::lsystem
