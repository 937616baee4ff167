// Labels: texts where the turtle is.
#include "espalier/turtle/symbol.h"

namespace espalier::turtle {
namespace {

const Registered<Symbol> label{{"@L",
                                {},
                                "@L(\"format\", ...): write a text here, with the other parameters as printf would",
                                [](Walk& walk, std::span<const double> parameters) { walk.write_label(parameters); }}};

const Registered<SymbolGroup> labels_group{{"labels",
                                            "texts",
                                            {"@L"},
                                            "The format is that of printf with one number for each further parameter.",
                                            "axiom: !(0.06) F(1) @L(\"height %.1f m\", 1)"}};

}  // namespace
}  // namespace espalier::turtle
