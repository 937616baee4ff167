// Mouse and keys of a window whose plants stay upright.
#pragma once

#include <vtkInteractorStyle.h>

#include <string>

namespace espalier::view {

/// What the mouse and the keys do before the camera: true if that is done with it. Pixels from the lower left corner.
class WindowHands {
public:
    virtual ~WindowHands() = default;
    virtual bool press(int x, int y) = 0;
    virtual void drag(int x, int y) = 0;  ///< after a press that was taken
    virtual void release() = 0;
    virtual void click(int x, int y) = 0;  ///< pressed and released in one place of the scene
    virtual void key(const std::string& name, bool shift) = 0;
    virtual void camera_moved() = 0;
};

/// The left button turns the camera about the vertical through what it looks at and up and down, the middle one (or the
/// left one with Shift) moves it, the right one and the wheel go near and far. Nothing is drawn: camera_moved() says
/// that something should be.
class Turntable final : public vtkInteractorStyle {
public:
    vtkTypeMacro(Turntable, vtkInteractorStyle)
    static Turntable* New();

    void set_hands(WindowHands* hands) { hands_ = hands; }
    /// A flat scene is not turned: the left button moves it.
    void set_flat(bool flat) { flat_ = flat; }

    void OnLeftButtonDown() override;
    void OnLeftButtonUp() override;
    void OnMiddleButtonDown() override;
    void OnMiddleButtonUp() override;
    void OnRightButtonDown() override;
    void OnRightButtonUp() override;
    void OnMouseMove() override;
    void OnMouseWheelForward() override;
    void OnMouseWheelBackward() override;
    void OnKeyPress() override;
    void OnChar() override {}  // VTK's own keys
    void OnKeyRelease() override {}

    void Rotate() override;
    void Pan() override;
    void Dolly() override;

private:
    bool press();
    void end_gesture();
    void approach(double factor);

    WindowHands* hands_ = nullptr;
    bool flat_ = false, taken_ = false, moved_ = false;
    int pressed_[2] = {0, 0};
};

}  // namespace espalier::view
