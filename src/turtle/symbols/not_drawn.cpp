// Symbols that belong to the language and draw nothing here. They are named so that their letters are not taken for
// something else: the F in @F does not move.
#include "espalier/turtle/symbol.h"

namespace espalier::turtle {
namespace {

void nothing(Walk&, std::span<const double>) {}

const Registered<Symbol> command{{"@S", {}, "@S(\"command\"): a shell command; never run", nothing}};
const Registered<Symbol> old_i{{"@I", {}, "@I: an old symbol; has no effect", nothing}};
const Registered<Symbol> old_j{{"@J", {}, "@J: an old symbol; has no effect", nothing}};
const Registered<Symbol> old_mo{{"@mo", {}, "@mo: an old symbol; has no effect", nothing}};
const Registered<Symbol> old_mc{{"@mc", {}, "@mc: an old symbol; has no effect", nothing}};
const Registered<Symbol> unknown{{"@*", {}, "@x: unless listed, ignored together with its second character", nothing}};

const Registered<SymbolGroup> not_drawn_group{{"not-drawn",
                                               "symbols without effect",
                                               {"@S", "@I", "@J", "@mo", "@mc", "@*"},
                                               "They are recognised, so that old models can be read.",
                                               "axiom: F(1) @I F(1)"}};

}  // namespace
}  // namespace espalier::turtle
