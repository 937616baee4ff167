// What VTK says of errors, instead of on standard error.
#pragma once

#include <vtkLogger.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <string>

namespace espalier::picture {

/// For as long as it lives, VTK's words come here.
class Listening {
public:
    Listening();
    ~Listening();
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;

    const std::string& errors() const;

private:
    class Listener;
    vtkSmartPointer<vtkOutputWindow> before_;
    vtkLogger::Verbosity verbosity_;
    vtkSmartPointer<Listener> listener_;
};

}  // namespace espalier::picture
