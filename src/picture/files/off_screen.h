// A render window that no screen shows, on machines with and without one.
#pragma once

#include <vtkSmartPointer.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

class vtkCamera;
class vtkImageData;
class vtkRenderWindow;

namespace espalier::picture {

/// Why nothing can be drawn here, and what to install; "" if it can.
std::string why_no_pictures();

/// True if there is an X display that answers: VTK ends the program where none does.
bool has_display();

/// Draws by EGL without any display where that works, else on the X display there is.
/// What is put into the window must be gone before it, because it frees its memory on the graphics card. One thread
/// makes, uses and destroys it.
class OffScreenWindow {
public:
    /// Throws RunError with `why_no_pictures()`; UserError for a size that no graphics card draws.
    OffScreenWindow(int width, int height, int samples = 8);
    ~OffScreenWindow();
    OffScreenWindow(const OffScreenWindow&) = delete;
    OffScreenWindow& operator=(const OffScreenWindow&) = delete;

    vtkRenderWindow& window();
    /// Throws RunError if VTK complains.
    void render();
    /// Renders; 8 bits red, green, blue per pixel.
    vtkSmartPointer<vtkImageData> image();
    /// The same with a fourth part: how opaque each pixel is.
    vtkSmartPointer<vtkImageData> image_with_alpha();
    /// Of what was rendered last, seen by this camera: how far before it each pixel lies, in the order of image();
    /// infinite where nothing is.
    std::vector<float> distances(vtkCamera& camera);
    /// Renders into a file that appears complete or not at all. Throws RunError.
    void write_png(const std::filesystem::path& path);

private:
    vtkSmartPointer<vtkImageData> read_pixels(int kind);

    class Context;
    std::unique_ptr<Context> context_;  ///< EGL's; null where X draws
    vtkSmartPointer<vtkRenderWindow> window_;
};

/// Complete or not at all. Throws RunError.
void write_png(const std::filesystem::path& path, vtkImageData& image);

}  // namespace espalier::picture
