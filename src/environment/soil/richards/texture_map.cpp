#include "environment/soil/richards/texture_map.h"

#include "base/csv_rows.h"
#include "base/picture_file.h"
#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace espalier::environment {
namespace {

std::string text_of(const Picture::Colour& colour) {
    return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

/// Of "#c8a060".
Picture::Colour read_colour(const std::string& text, const Place& place) {
    unsigned value = 0;
    const char* const end = text.data() + text.size();
    const bool is_long_enough = text.size() == 7 && text[0] == '#';
    if (!is_long_enough || std::from_chars(text.data() + 1, end, value, 16).ptr != end) {
        throw UserError(place, fmt::format("'{}' is no colour: write one as \"#c8a060\"", text));
    }
    return {static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8),
            static_cast<std::uint8_t>(value)};
}

/// The whole number of a share of a side, from 0 to 1.
std::size_t step_of(double share, std::size_t count) {
    const double step = std::floor(share * static_cast<double>(count));
    return static_cast<std::size_t>(std::clamp(step, 0.0, static_cast<double>(count - 1)));
}

}  // namespace

TextureMap::TextureMap(const Settings& map, std::size_t soils) {
    const std::filesystem::path path = map.path("file");
    if (soils > 255) throw UserError(map.place("soils"), "a map has at most 255 soils");
    is_ground_plan_ = map.choice_or("plane", "xy", {"xy", "xz"}) == "xz";
    if (path.extension() == ".csv") {
        read_table(path, soils);
    } else {
        read_colours(path, map, soils);
    }
}

void TextureMap::read_table(const std::filesystem::path& path, std::size_t soils) {
    const CsvRows table(path);
    if (table.rows().empty()) throw UserError({path.string(), 0, 0}, "this map has no rows");
    width_ = table.rows().front().cells.size();
    height_ = table.rows().size();
    for (const CsvRow& row : table.rows()) {
        if (row.cells.size() != width_) {
            throw UserError(table.place(row),
                            fmt::format("this row has {} cells, and the first {}", row.cells.size(), width_));
        }
        for (std::size_t column = 0; column < width_; ++column) {
            const double number = row.number(column).value_or(-1);
            if (!(number >= 0 && number < static_cast<double>(soils) && number == std::floor(number))) {
                throw UserError(table.place(row, column),
                                fmt::format("'{}' is not a number from 0 to {}: it counts the names of 'soils'",
                                            row.cells[column], soils - 1));
            }
            numbers_.push_back(static_cast<std::uint8_t>(number));
        }
    }
}

void TextureMap::read_colours(const std::filesystem::path& path, const Settings& map, std::size_t soils) {
    std::vector<Picture::Colour> colours;
    for (const std::string& text : map.texts_or("colours", {})) {
        colours.push_back(read_colour(text, map.place("colours")));
    }
    if (colours.size() != soils) {
        throw UserError(map.place("colours"), fmt::format("a picture needs a colour for each of the {} soils", soils));
    }
    const Picture picture = read_picture(path);
    width_ = picture.width;
    height_ = picture.height;
    for (std::size_t y = 0; y < height_; ++y) {
        for (std::size_t x = 0; x < width_; ++x) {
            const Picture::Colour& pixel = picture.pixels[(height_ - 1 - y) * width_ + x];
            const auto found = std::find(colours.begin(), colours.end(), pixel);
            if (found == colours.end()) {
                throw UserError({path.string(), 0, 0},
                                fmt::format("the pixel {} of row {} from above is {}, which is none of 'colours'",
                                            x + 1, y + 1, text_of(pixel)));
            }
            numbers_.push_back(static_cast<std::uint8_t>(found - colours.begin()));
        }
    }
}

std::size_t TextureMap::at(const glm::dvec3& place, const Box& domain) const {
    const int axis = is_ground_plan_ ? 2 : 1;
    const double u = (place.x - domain.lower.x) / (domain.upper.x - domain.lower.x);
    const double v = (domain.upper[axis] - place[axis]) / (domain.upper[axis] - domain.lower[axis]);
    return numbers_[step_of(v, height_) * width_ + step_of(u, width_)];
}

}  // namespace espalier::environment
