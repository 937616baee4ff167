// Graphs of component prototypes (p-graphs): plants from parts that multiply and repeat one another.
#include "espalier/base/file.h"
#include "espalier/language/notation.h"

#include "language/pgraph/schema.h"
#include "language/pgraph/translation.h"

#include <sstream>
#include <vector>

namespace espalier::language {
namespace {

std::string help() {
    return R"(A file states components with their keys, and links between them:

    pgraph 1
    Horn stem
      length 2
      bend 1 .. -1
    Phiball head
      count 100
    Horn hair
      length 0.2 .. 0.3 noise 0.05
    camera -> stem -> head -> hair

include "other.pgraph" stands for the lines of another file, which lies beside this one.
Links: -> child, -B-> branch of a Tree, -L-> leaf: in place of links that lead back, once these have come to the limit
`recursion` of where they lead.
Values: a number; or a range a .. b, spread over the instances i = 0 .. n - 1 of the component, over the children of a
multiplier, or along the axis of a horn; then perhaps `then f(x)`, a function of that, and `noise a`, at most a more or
less. Numbers are expressions of the language of models, in the names i, n, u = i / (n - 1), depth (of the recursion)
and those of #define, which may be settings.
Source: Lintermann & Deussen 1997, Erzeugung komplexer botanischer Objekte in der Computergraphik.
)" + pgraph::describe_types();
}

std::string line_of(const std::string& text, int number) {
    std::istringstream in(text);
    std::string line;
    for (int k = 0; k < number; ++k) {
        if (!std::getline(in, line)) return "";
    }
    return line;
}

/// The mistakes with the lines they speak of: of this file, or of one that it includes.
std::vector<Diagnostic> with_lines(std::vector<Diagnostic> mistakes, const std::string& text, const std::string& file) {
    for (Diagnostic& mistake : mistakes) {
        const Place& place = mistake.place;
        if (place.line > 0) mistake.source = line_of(place.file == file ? text : read_text(place.file), place.line);
    }
    return mistakes;
}

TranslatedText translated_graph(const std::string& text, const std::filesystem::path& path) {
    try {
        return pgraph::translate(pgraph::parse(text, path.string()));
    } catch (const UserError& error) {
        throw UserError(with_lines(error.diagnostics(), text, path.string()));
    }
}

const Registered<NotationType> entry{
    {"pgraph", ".pgraph", "plants as graphs of components (Lintermann & Deussen 1997)", help(), translated_graph}};

}  // namespace
}  // namespace espalier::language
