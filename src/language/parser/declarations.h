// Reads what a model declares: arrays and external variables, modules with names, processes, constants, fields.
#pragma once

#include "espalier/lsystem/lsystem.h"

#include "language/parser/expressions.h"
#include "language/parser/names.h"
#include "language/parser/scanner.h"
#include "language/parser/symbols.h"

#include <vector>

namespace espalier::language {

class DeclarationParser {
public:
    DeclarationParser(Scanner& in, Names& names, Mistakes& mistakes, Symbols& symbols, ExpressionParser& expressions,
                      Model& model)
        : in_(in), names_(names), mistakes_(mistakes), symbols_(symbols), expressions_(expressions), model_(model) {}

    /// `module ...;`, `environment ...;`, `const ...;` or `field ...;`; false if none of them stands here.
    bool declaration();
    /// The braces after `define:`.
    void definitions();

private:
    void definition(bool external, bool array);
    void values(ArrayDeclaration& array);
    void fill_row(ArrayDeclaration& array, std::size_t begin, Location at);
    void check_size(const ArrayDeclaration& array, Location at);
    void module_declaration();
    void process_declaration();
    double constant_number(const std::string& meaning);
    std::vector<double> default_answer(const std::string& process);
    void constant_declaration();
    void field_declaration();
    void field_components(const std::string& name);

    Scanner& in_;
    Names& names_;
    Mistakes& mistakes_;
    Symbols& symbols_;
    ExpressionParser& expressions_;
    Model& model_;
    std::size_t value_depth_ = 0;  // depth of the braces at hand
};

}  // namespace espalier::language
