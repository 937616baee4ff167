// A twig of leaves for one card.
#pragma once

#include "formats/leaf_texture.h"

namespace espalier::formats {

/// Throws UserError if leaves would be shorter than eight pixels.
LeafPicture twig_picture(const LeafTexture& texture);

}  // namespace espalier::formats
