#include "picture/files/listening.h"

#include <string_view>

namespace espalier::picture {

class Listening::Listener final : public vtkOutputWindow {
public:
    static Listener* New() {
        auto* made = new Listener;
        made->InitializeObjectBase();
        return made;
    }

    void DisplayText(const char*) override {}
    void DisplayErrorText(const char* text) override {
        // Debian's GLEW looks for an X display when it is asked for OpenGL's functions, finds none under EGL and says
        // so after it has found all functions.
        if (std::string_view(text).find("GLEW") == std::string_view::npos) errors += text;
    }

    std::string errors;
};

Listening::Listening()
    : before_(vtkOutputWindow::GetInstance()),
      verbosity_(vtkLogger::GetCurrentVerbosityCutoff()),
      listener_(vtkSmartPointer<Listener>::New()) {
    vtkOutputWindow::SetInstance(listener_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

Listening::~Listening() {
    vtkLogger::SetStderrVerbosity(verbosity_);
    vtkOutputWindow::SetInstance(before_);
}

const std::string& Listening::errors() const {
    return listener_->errors;
}

}  // namespace espalier::picture
