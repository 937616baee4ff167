// Colours for numbers and for names, on light and dark paper.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace espalier::picture {

using Rgb = std::array<std::uint8_t, 3>;

/// A number's place from 0 to 1 as a colour between anchors at even distances.
Rgb along(std::span<const Rgb> anchors, double place);

/// Perceptually uniform and readable without colour vision (van der Walt & Smith 2015).
std::span<const Rgb> viridis();

/// For fields: what is low fades into the paper (Brewer 2003, "Blues", "Oranges", "Purples", "Greens"); each number
/// another hue.
std::span<const Rgb> field_colours(std::size_t number, bool dark);

/// Seven that colour-blind readers tell apart (Okabe & Ito 2008); more repeat.
Rgb category_colour(std::size_t number);

/// "#rrggbb"; none for another text.
std::optional<Rgb> hex_colour(const std::string& text);

inline constexpr Rgb no_value{165, 165, 165};

}  // namespace espalier::picture
