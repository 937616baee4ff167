#include "picture/palette.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace espalier::picture {
namespace {

constexpr std::array<Rgb, 11> viridis_anchors{{{68, 1, 84},
                                               {72, 36, 117},
                                               {65, 68, 135},
                                               {53, 95, 141},
                                               {42, 120, 142},
                                               {33, 145, 140},
                                               {34, 168, 132},
                                               {68, 191, 112},
                                               {122, 209, 81},
                                               {189, 223, 38},
                                               {253, 231, 37}}};

using Hue = std::array<Rgb, 7>;
constexpr std::array<Hue, 4> hues{{
    {{{239, 243, 255},
      {198, 219, 239},
      {158, 202, 225},
      {107, 174, 214},
      {66, 146, 198},
      {33, 113, 181},
      {8, 69, 148}}},
    {{{254, 237, 222}, {253, 208, 162}, {253, 174, 107}, {253, 141, 60}, {241, 105, 19}, {217, 72, 1}, {140, 45, 4}}},
    {{{242, 240, 247},
      {218, 218, 235},
      {188, 189, 220},
      {158, 154, 200},
      {128, 125, 186},
      {106, 81, 163},
      {74, 20, 134}}},
    {{{237, 248, 233}, {199, 233, 192}, {161, 217, 155}, {116, 196, 118}, {65, 171, 93}, {35, 139, 69}, {0, 90, 50}}},
}};

constexpr std::array<Hue, 4> reversed_hues = [] {
    std::array<Hue, 4> reversed = hues;
    for (Hue& hue : reversed) std::reverse(hue.begin(), hue.end());
    return reversed;
}();

constexpr std::array<Rgb, 7> categories{
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}, {120, 120, 120}}};

}  // namespace

Rgb along(std::span<const Rgb> anchors, double place) {
    const double at = std::clamp(place, 0.0, 1.0) * static_cast<double>(anchors.size() - 1);
    const auto before = std::min(static_cast<std::size_t>(at), anchors.size() - 2);
    const double share = at - static_cast<double>(before);
    Rgb colour;
    for (std::size_t k = 0; k < 3; ++k) {
        const double mixed = (1 - share) * anchors[before][k] + share * anchors[before + 1][k];
        colour[k] = static_cast<std::uint8_t>(std::lround(mixed));
    }
    return colour;
}

std::span<const Rgb> viridis() {
    return viridis_anchors;
}

std::span<const Rgb> field_colours(std::size_t number, bool dark) {
    return (dark ? reversed_hues : hues)[number % hues.size()];
}

Rgb category_colour(std::size_t number) {
    return categories[number % categories.size()];
}

std::optional<Rgb> hex_colour(const std::string& text) {
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    unsigned number = 0;
    const char* end = text.data() + text.size();
    const auto [rest, wrong] = std::from_chars(text.data() + 1, end, number, 16);
    if (wrong != std::errc() || rest != end) return std::nullopt;
    const auto part = [&](unsigned shift) { return static_cast<std::uint8_t>(number >> shift & 255); };
    return Rgb{part(16), part(8), part(0)};
}

}  // namespace espalier::picture
