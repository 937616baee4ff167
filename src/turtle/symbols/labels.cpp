// Labels: texts where the turtle is.
#include "espalier/turtle/symbol.h"

namespace espalier::turtle {
namespace {

const Registered<Symbol> label{{"@L",
                                {},
                                "@L(\"format\", ...): write a text here, with the other parameters as printf would",
                                [](Walk& walk, std::span<const double> parameters) { walk.write_label(parameters); }}};

}  // namespace
}  // namespace espalier::turtle
