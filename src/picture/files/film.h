// Writers of films: pictures of one size go in one after the other.
#pragma once

#include "espalier/picture/chart_page.h"

#include <filesystem>
#include <memory>
#include <string>

class vtkImageData;

namespace espalier::picture {

class Film {
public:
    virtual ~Film() = default;
    /// 8 bits red, green, blue per pixel. Throws RunError.
    virtual void add(vtkImageData& picture) = 0;
    /// Without it the file is not complete. Throws RunError.
    virtual void finish() = 0;
};

/// What the extension says: .webm (VP9) is written here, .mp4 (H.264) and .gif by ffmpeg.
/// Throws RunError saying what to install if there is none.
std::unique_ptr<Film> film_of(const std::filesystem::path& path, const PictureSize& size, double pictures_per_second);

/// The path's extension in small letters: ".png".
std::string kind_of_file(const std::filesystem::path& path);

}  // namespace espalier::picture
