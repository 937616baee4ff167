// Films that browsers play: VP9 in WebM, by libvpx.
#pragma once

#include "picture/files/film.h"

namespace espalier::picture {

/// The same pictures give the same bytes. Throws RunError if nothing can be written there.
std::unique_ptr<Film> vp9_film(const std::filesystem::path& path, const PictureSize& size, double pictures_per_second);

}  // namespace espalier::picture
