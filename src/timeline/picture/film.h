// Writers of films: pictures of one size go in one after the other.
#pragma once

#include "espalier/timeline/chart_page.h"

#include <filesystem>
#include <memory>

class vtkImageData;

namespace espalier {

class Film {
public:
    virtual ~Film() = default;
    /// 8 bits red, green, blue per pixel. Throws RunError.
    virtual void add(vtkImageData& picture) = 0;
    /// Without it the file is not complete. Throws RunError.
    virtual void finish() = 0;
};

/// Ogg Theora, which VTK writes itself.
std::unique_ptr<Film> theora_film(const std::filesystem::path& path, double pictures_per_second);

/// What the extension says, by ffmpeg. Throws RunError saying what to install if there is none.
std::unique_ptr<Film> ffmpeg_film(const std::filesystem::path& path, const PictureSize& size,
                                  double pictures_per_second);

}  // namespace espalier
