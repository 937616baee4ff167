// The words of RSML's dialects. A habit of a program is a row of a table in vocabulary.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace espalier::language::rsml {

/// What an element is, by the element around it.
enum class Scope {
    outside,
    document,
    metadata,
    bookkeeping,  ///< about the file, not about plants
    unit,
    resolution,
    software,
    up,
    definitions,
    definition,
    defined_name,
    defined_unit,
    scene,
    plant,
    root,
    geometry,
    polyline,
    point,
    functions,
    function,
    sample,
    properties,
    property,
    unused,
};

/// What a function or a property tells of a root.
enum class Quantity { diameter, birth, age, parent_node, length, continues };

struct Term {
    Quantity quantity;
    double factor;  ///< 2 for a radius
};

/// Without a prefix of a namespace, in small letters.
std::string plain_name(std::string_view name);

/// The scope of an element of a plain name; nothing where it is not known there.
std::optional<Scope> scope_of(Scope around, std::string_view element);
/// What the name of a function, property or attribute stands for, however it joins its words; nothing for others.
std::optional<Term> term_of(std::string_view name);

/// Which axis points upwards in three-dimensional files of a program; "" where that is not known.
std::string upwards_of(std::string_view software);
/// The days of a unit of time: "day", "h"; nothing for other words.
std::optional<double> days_of(std::string_view unit);
/// Whether a word stands for the pixel of a picture.
bool is_pixel(std::string_view unit);

}  // namespace espalier::language::rsml
