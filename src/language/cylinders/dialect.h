// How programs name the columns of a cylinder model. A dialect is a row of a table.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language::cylinders {

/// What is read of a cylinder.
enum Field {
    id,
    parent,
    extension,  ///< the next cylinder of its branch
    branch,
    order,
    radius,
    length,
    start_x,
    start_y,
    start_z,
    axis_x,
    axis_y,
    axis_z,
    end_x,
    end_y,
    end_z,
    fields
};

struct Dialect {
    const char* program;
    std::array<const char*, fields> columns;  ///< in small letters and digits alone; null: there is none
    bool counts_from_one;                     ///< else from 0; the parent of the first is one less
};

/// A header of such a table.
struct Header {
    const Dialect* dialect = nullptr;
    char separator = ',';
    std::vector<std::string> names;                         ///< of the columns of its rows
    std::array<std::optional<std::size_t>, fields> column;  ///< of the rows
};

/// Of a line; nothing if no known program writes such a one.
std::optional<Header> header_of(std::string_view line);
/// Whether the first line of a text that is neither empty nor a comment is one.
bool is_cylinder_model(std::string_view head);

}  // namespace espalier::language::cylinders
