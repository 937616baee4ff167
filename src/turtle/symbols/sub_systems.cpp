// Sub-L-systems: what stands between ? and $ is drawn in a scale of its own.
#include "espalier/turtle/symbol.h"

namespace espalier::turtle {
namespace {

const Registered<Symbol> enter{
    {"?",
     {1, 2},
     "?(id, scale): enter sub-L-system id; lengths and widths are multiplied by scale until $",
     [](Walk& walk, std::span<const double> parameters) {
         walk.enter_system(parameters.size() > 1 ? parameters[1] : 1);
     }}};

const Registered<Symbol> leave{
    {"$", {0}, "$: leave the sub-L-system and restore scale and width", [](Walk& walk, std::span<const double>) {
         walk.leave_system();
     }}};

const Registered<SymbolGroup> sub_systems_group{
    {"sub-systems",
     "enters and leaves sub-L-systems",
     {"?", "$"},
     "A model with several numbered L-systems uses the productions of system `id` between ? and $.",
     "derivation length: 4\n"
     "axiom: !(0.06) F(1) [+(40) ?(2, 0.5) B $] F(1)\n"
     "endlsystem\n"
     "\n"
     "lsystem: 2\n"
     "B --> F(1) [+(30) F(1)] -(30) B"}};

}  // namespace
}  // namespace espalier::turtle
