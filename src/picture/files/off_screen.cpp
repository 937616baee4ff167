#include "picture/files/off_screen.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "base/platform.h"
#include "picture/files/listening.h"

#include <fmt/format.h>
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkFloatArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#if __has_include(<EGL/egl.h>) && __has_include(<EGL/eglext.h>)
#define ESPALIER_HAS_EGL 1
#include <EGL/egl.h>
#include <EGL/eglext.h>
#else
#define ESPALIER_HAS_EGL 0
#endif

// What VTK draws with; parts of it are chosen at run time and must be named.
VTK_MODULE_INIT(vtkRenderingOpenGL2);
VTK_MODULE_INIT(vtkRenderingContextOpenGL2);
VTK_MODULE_INIT(vtkRenderingFreeType);

namespace espalier::picture {

#if ESPALIER_HAS_EGL

/// An OpenGL context without a window. Its surface is never drawn on: VTK draws into a buffer of its own.
class OffScreenWindow::Context {
public:
    /// Null if this machine makes none.
    static std::unique_ptr<Context> make() {
        auto context = std::unique_ptr<Context>(new Context);
        return context->surface_ != EGL_NO_SURFACE && context->make_current() ? std::move(context) : nullptr;
    }
    ~Context() {
        if (display() == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display(), surface_);
        if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display(), context_);
    }
    bool make_current() { return eglMakeCurrent(display(), surface_, surface_, context_) == EGL_TRUE; }

private:
    Context() {
        if (display() == EGL_NO_DISPLAY || !eglBindAPI(EGL_OPENGL_API)) return;
        const EGLint wanted[] = {EGL_SURFACE_TYPE,
                                 EGL_PBUFFER_BIT,
                                 EGL_RENDERABLE_TYPE,
                                 EGL_OPENGL_BIT,
                                 EGL_RED_SIZE,
                                 8,
                                 EGL_GREEN_SIZE,
                                 8,
                                 EGL_BLUE_SIZE,
                                 8,
                                 EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (!eglChooseConfig(display(), wanted, &config, 1, &count) || count == 0) return;
        const EGLint version[] = {
            EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        context_ = eglCreateContext(display(), config, EGL_NO_CONTEXT, version);
        if (context_ == EGL_NO_CONTEXT) return;
        const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
        surface_ = eglCreatePbufferSurface(display(), config, size);
    }

    /// Opened once: ending it would take it from every other context.
    static EGLDisplay display() {
        static const EGLDisplay display = open_display();
        return display;
    }
    static EGLDisplay open_display() {
        const auto works = [](EGLDisplay display) {
            return display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr);
        };
        const auto on_platform =
            reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
        if (on_platform) {
            const EGLDisplay display = on_platform(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
            if (works(display)) return display;
        }
        const EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
        return works(display) ? display : EGL_NO_DISPLAY;
    }

    EGLContext context_ = EGL_NO_CONTEXT;
    EGLSurface surface_ = EGL_NO_SURFACE;
};

#else

class OffScreenWindow::Context {
public:
    static std::unique_ptr<Context> make() { return nullptr; }
    bool make_current() { return false; }
};

#endif

// Stays connected: an X server may begin anew when the last program leaves it (Xvfb does), and VTK, which comes next,
// does not survive being turned away meanwhile.
bool has_display() {
    static void* const connection = []() -> void* {
        if (!std::getenv("DISPLAY")) return nullptr;
        std::string ignored;
        void* const library = platform::open_library("libX11.so.6", /*shared=*/false, ignored);
        if (!library) return nullptr;
        using Open = void* (*)(const char*);
        const auto open = reinterpret_cast<Open>(platform::function_of(library, "XOpenDisplay"));
        return open ? open(nullptr) : nullptr;
    }();
    return connection != nullptr;
}

std::string why_no_pictures() {
    try {
        const OffScreenWindow attempt(16, 16, 0);
        return "";
    } catch (const RunError& error) {
        return error.what();
    }
}

OffScreenWindow::OffScreenWindow(int width, int height, int samples) : context_(Context::make()) {
    constexpr int largest = 16384;
    if (width < 1 || height < 1 || width > largest || height > largest) {
        throw UserError(fmt::format("a picture has 1 to {} pixels along a side, not {}x{}", largest, width, height));
    }
    if (context_) {
        const auto window = vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New();
        window->SetOwnContext(0);
        window->SetMapped(1);
        window->SetIsCurrent(true);
        window->SetSupportsOpenGL(1);
        window->SetReadyForRendering(true);
        window_ = window;
    } else if (has_display()) {
        window_ = vtkSmartPointer<vtkRenderWindow>::New();
    } else {
        throw RunError(
            "no picture can be drawn here: EGL makes no context and no X display answers.\n"
            "On Debian: apt-get install libegl1 libgl1-mesa-dri; or apt-get install xvfb xauth and put `xvfb-run -a` "
            "in "
            "front of the command");
    }
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(samples);
    window_->SetSize(width, height);
}

OffScreenWindow::~OffScreenWindow() {
    const Listening listening;
    if (context_) context_->make_current();
    window_->Finalize();
    window_ = nullptr;
}

vtkRenderWindow& OffScreenWindow::window() {
    return *window_;
}

void OffScreenWindow::render() {
    const Listening listening;
    if (context_) context_->make_current();
    window_->Render();
    if (!listening.errors().empty()) throw RunError("drawing failed: " + listening.errors());
}

vtkSmartPointer<vtkImageData> OffScreenWindow::image() {
    return read_pixels(VTK_RGB);
}

vtkSmartPointer<vtkImageData> OffScreenWindow::image_with_alpha() {
    return read_pixels(VTK_RGBA);
}

vtkSmartPointer<vtkImageData> OffScreenWindow::read_pixels(int kind) {
    render();
    const Listening listening;
    vtkNew<vtkWindowToImageFilter> reader;
    reader->SetInput(window_);
    reader->SetInputBufferType(kind);
    reader->ReadFrontBufferOff();
    reader->ShouldRerenderOff();
    reader->Update();
    return reader->GetOutput();
}

std::vector<float> OffScreenWindow::distances(vtkCamera& camera) {
    const Listening listening;
    if (context_) context_->make_current();
    vtkNew<vtkFloatArray> depths;
    const int* size = window_->GetSize();
    window_->GetZbufferData(0, 0, size[0] - 1, size[1] - 1, depths);
    const double near = camera.GetClippingRange()[0], far = camera.GetClippingRange()[1];
    std::vector<float> distances(depths->Begin(), depths->End());
    for (float& depth : distances) {
        const double z = depth;
        if (depth >= 1)
            depth = std::numeric_limits<float>::infinity();
        else
            depth = static_cast<float>(camera.GetParallelProjection() ? std::lerp(near, far, z)
                                                                      : near * far / (far - z * (far - near)));
    }
    return distances;
}

void OffScreenWindow::write_png(const std::filesystem::path& path) {
    picture::write_png(path, *image());
}

void write_png(const std::filesystem::path& path, vtkImageData& image) {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(&image);
    writer->SetCompressionLevel(9);
    writer->WriteToMemoryOn();
    writer->Write();
    vtkUnsignedCharArray* bytes = writer->GetResult();
    if (!bytes || bytes->GetNumberOfValues() == 0) throw RunError(fmt::format("cannot write {}", path.string()));
    write_text(path, {reinterpret_cast<const char*>(bytes->GetPointer(0)),
                      static_cast<std::size_t>(bytes->GetNumberOfValues())});
}

}  // namespace espalier::picture
