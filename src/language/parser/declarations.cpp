#include "language/parser/declarations.h"

#include "base/text.h"
#include "language/parser/constant.h"
#include "language/parser/vector_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::language {
namespace {

constexpr double most_filled = 1e6;  // elements of one row

}  // namespace

// define: { array name[2][3] = {...}, other[4]; external name, name; }
void DeclarationParser::definitions() {
    {
        const Scanner::Inside inside(in_, Scanner::Inside::braces);
        in_.expect("{", "after 'define:'");
        while (!in_.accept("}")) {
            const bool external = in_.accept_keyword("external");
            const bool array = in_.accept_keyword("array");
            if (!external && !array) {
                const std::vector<std::string> known{"array", "external"};
                in_.expected("'array' or 'external' in 'define'", did_you_mean(in_.looking_at_name(), known));
            }
            do {
                definition(external, array);
            } while (in_.accept(","));
            if (!in_.accept(";") && !in_.looking_at("}")) in_.expected("';' after the declaration");
        }
    }
    in_.end_statement("'define'");
}

void DeclarationParser::definition(bool external, bool array) {
    in_.skip();
    const Location at = in_.here();
    const std::string name(in_.accept_name());
    if (name.empty()) in_.expected("the name of a variable or an array");
    if (!array && !in_.looking_at("[")) {
        names_.add_external(name);
        return;
    }
    if (names_.array(name)) mistakes_.error(at, fmt::format("array '{}' is declared a second time", name));
    ArrayDeclaration declared;
    declared.name = name;
    declared.external = external;
    declared.place = names_.place(at);
    while (in_.accept("[")) {
        declared.dimensions.push_back(expressions_.expression());
        if (in_.looking_at(",")) throw SyntaxError{in_.here(), "each dimension has its own brackets: a[2][3]"};
        in_.expect("]", "after the size of the array");
    }
    if (declared.dimensions.empty() && !external) {
        in_.expected(fmt::format("the size of array '{0}': {0}[size]", name));
    }
    value_depth_ = 0;
    if (external && in_.looking_at("=")) {
        throw SyntaxError{in_.here(), "an external array has the values it has in the surrounding L-system"};
    }
    if (in_.looking_at("=")) {
        in_.take(1);
        values(declared);
    }
    check_size(declared, at);
    names_.add_array(std::move(declared), at);
}

// { 1, 2, 3 }, row by row in braces of their own or not.
void DeclarationParser::values(ArrayDeclaration& array) {
    in_.expect("{", "before the values of the array");
    if (++value_depth_ > 50) throw SyntaxError{in_.here(), "the values are nested more than 50 deep"};
    while (!in_.accept("}")) {
        if (in_.looking_at("{")) {
            const Location at = in_.here();
            const std::size_t begin = array.values.size();
            values(array);
            fill_row(array, begin, at);
        } else {
            array.values.push_back(expressions_.expression());
        }
        if (!in_.accept(",") && !in_.looking_at("}")) in_.expected("',' or '}' after a value of the array");
    }
    --value_depth_;
}

// What inner braces leave open is 0.
void DeclarationParser::fill_row(ArrayDeclaration& array, std::size_t begin, Location at) {
    double elements = 1;
    for (std::size_t i = value_depth_; i < array.dimensions.size(); ++i) {
        elements *= std::floor(constant_value(array.dimensions[i]).value_or(0));
    }
    const std::size_t given = array.values.size() - begin;
    if (value_depth_ >= array.dimensions.size() || elements < 1 || elements > most_filled) return;
    if (static_cast<double>(given) > elements) {
        mistakes_.error(
            at, fmt::format("these braces hold {} values for {} elements of array '{}'", given, elements, array.name));
    }
    array.values.resize(begin + static_cast<std::size_t>(elements), Expression::number(0, names_.place(at)));
}

void DeclarationParser::check_size(const ArrayDeclaration& array, Location at) {
    double elements = 1;
    for (const Expression& dimension : array.dimensions) {
        const std::optional<double> size = constant_value(dimension);
        if (!size) return;
        if (*size < 1) {
            mistakes_.error(at, fmt::format("array '{}' has a dimension of size {}", array.name, *size));
            return;
        }
        elements *= std::floor(*size);
    }
    if (static_cast<double>(array.values.size()) > elements) {
        mistakes_.error(
            at, fmt::format("array '{}' has {} elements but {} values", array.name, elements, array.values.size()));
    }
}

bool DeclarationParser::declaration() {
    if (in_.accept_keyword("module")) {
        do module_declaration();
        while (in_.accept(","));
        in_.end_statement("the declaration");
    } else if (in_.accept_keyword("environment")) {
        do process_declaration();
        while (in_.accept(","));
        in_.end_statement("the declaration");
    } else if (in_.accept_keyword("const")) {
        constant_declaration();
    } else if (in_.accept_keyword("field")) {
        field_declaration();
    } else {
        return false;
    }
    return true;
}

void DeclarationParser::module_declaration() {
    in_.skip();
    ModuleDeclaration declared;
    declared.name = in_.accept_name();
    if (declared.name.empty()) in_.expected("the name of a module");
    if (in_.accept("(") && !in_.accept(")")) {
        const Scanner::Inside inside(in_);
        do {
            declared.parameters.emplace_back(in_.accept_name());
            if (declared.parameters.back().empty()) in_.expected("the name of a parameter");
        } while (in_.accept(","));
        in_.expect(")", fmt::format("after the parameters of '{}'", declared.name));
    }
    symbols_.declare(declared.name);
    symbols_.declare_arity(declared.name, declared.parameters.size());
    model_.modules.push_back(std::move(declared));
}

void DeclarationParser::process_declaration() {
    in_.skip();
    const Location at = in_.here();
    const std::string name(in_.accept_name());
    if (name.empty()) in_.expected("the name of a process of the environment");
    if (name.size() == 1 && std::string_view("EPHLUQ").find(name) != std::string_view::npos) {
        throw SyntaxError{at, fmt::format("'?{}' has a meaning of its own; give the process a longer name", name)};
    }
    symbols_.declare("?" + name);
    if (std::find(model_.processes.begin(), model_.processes.end(), name) == model_.processes.end()) {
        model_.processes.push_back(name);
    }
    if (!in_.accept("=")) return;
    const std::vector<double> answer = default_answer(name);
    const auto [known, is_new] = model_.default_answers.emplace(name, answer);
    if (!is_new && known->second != answer) {
        throw SyntaxError{at, fmt::format("the process '{}' already has another default", name)};
    }
}

double DeclarationParser::constant_number(const std::string& meaning) {
    in_.skip();
    const Location at = in_.here();
    names_.set_constants_only(true);
    const Expression expression = expressions_.expression();
    names_.set_constants_only(false);
    const std::optional<double> value = constant_value(expression);
    if (!value) throw SyntaxError{at, fmt::format("{} has no value that is known now", meaning)};
    return *value;
}

// environment light = 1; or environment wind = { 0, 0, 1 };
std::vector<double> DeclarationParser::default_answer(const std::string& process) {
    const std::string meaning = fmt::format("the default of '{}'", process);
    if (!in_.accept("{")) return {constant_number(meaning)};
    const Scanner::Inside inside(in_, Scanner::Inside::braces);
    std::vector<double> answer;
    do answer.push_back(constant_number(meaning));
    while (in_.accept(","));
    in_.expect("}", "after " + meaning);
    return answer;
}

void DeclarationParser::constant_declaration() {
    in_.skip();
    const Location at = in_.here();
    const std::string name(in_.accept_name());
    if (name.empty()) in_.expected("the name of a constant");
    in_.expect("=", fmt::format("after 'const {}'", name));
    names_.define_constant(name, constant_number(fmt::format("the constant '{}'", name)), at);
    in_.end_statement("the constant");
}

void DeclarationParser::field_components(const std::string& name) {
    names_.set_formals(&VectorField::coordinates());
    names_.set_constants_only(true);
    for (int axis = 0; axis < 3; ++axis) {
        if (axis > 0) in_.expect(",", fmt::format("between the components of the field '{}': x, y, z", name));
        expressions_.expression();
    }
    names_.set_formals(nullptr);
    names_.set_constants_only(false);
}

// field swirl = -z, 0, x; or field sun = gradient(light); becomes a text of the model, of which the name is the number.
void DeclarationParser::field_declaration() {
    in_.skip();
    const Location at = in_.here();
    const std::string name(in_.accept_name());
    if (name.empty()) in_.expected("the name of a field");
    in_.expect("=", fmt::format("after 'field {}'", name));
    in_.skip();
    const std::size_t begin = in_.position(), reading = VectorField::length_of_reading(in_.rest());
    if (reading > 0) {
        in_.take(reading);
    } else {
        field_components(name);
    }
    const std::string text(in_.text(begin, in_.position()));
    try {
        VectorField::parse(text);
    } catch (const UserError& error) {
        throw SyntaxError{at, fmt::format("the field '{}': {}", name, error.what())};
    }
    names_.define_constant(name, static_cast<double>(model_.texts.size()), at);
    model_.texts.push_back(text);
    in_.end_statement("the field");
}

}  // namespace espalier::language
