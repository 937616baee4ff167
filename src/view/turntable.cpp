#include "view/turntable.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <vtkCamera.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace espalier::view {
namespace {

constexpr int click_tolerance = 3;  ///< pixels that a hand trembles
constexpr double degrees_per_window = 360, steepest = 89, wheel_step = 1.15;

glm::dvec3 vector(const double* v) {
    return {v[0], v[1], v[2]};
}

}  // namespace

vtkStandardNewMacro(Turntable);

bool Turntable::press() {
    const int* at = Interactor->GetEventPosition();
    pressed_[0] = at[0];
    pressed_[1] = at[1];
    moved_ = false;
    taken_ = hands_ && hands_->press(at[0], at[1]);
    if (!taken_) FindPokedRenderer(at[0], at[1]);
    return !taken_ && CurrentRenderer;
}

void Turntable::OnLeftButtonDown() {
    if (!press()) return;
    if (Interactor->GetShiftKey() || flat_) {
        StartPan();
    } else {
        StartRotate();
    }
}

void Turntable::OnLeftButtonUp() {
    const bool clicked = !taken_ && !moved_ && (State == VTKIS_ROTATE || State == VTKIS_PAN);
    end_gesture();
    if (clicked && hands_) hands_->click(pressed_[0], pressed_[1]);
}

void Turntable::OnMiddleButtonDown() {
    if (press()) StartPan();
}

void Turntable::OnMiddleButtonUp() {
    end_gesture();
}

void Turntable::OnRightButtonDown() {
    if (press()) StartDolly();
}

void Turntable::OnRightButtonUp() {
    end_gesture();
}

void Turntable::end_gesture() {
    if (taken_ && hands_) hands_->release();
    taken_ = false;
    StopState();
}

void Turntable::OnMouseMove() {
    const int* at = Interactor->GetEventPosition();
    if (taken_) {
        hands_->drag(at[0], at[1]);
        return;
    }
    const int away = std::max(std::abs(at[0] - pressed_[0]), std::abs(at[1] - pressed_[1]));
    if (away > click_tolerance) moved_ = true;
    if (!moved_) return;
    if (State == VTKIS_ROTATE) Rotate();
    if (State == VTKIS_PAN) Pan();
    if (State == VTKIS_DOLLY) Dolly();
    if (State != VTKIS_NONE && hands_) hands_->camera_moved();
}

void Turntable::OnMouseWheelForward() {
    approach(wheel_step);
}

void Turntable::OnMouseWheelBackward() {
    approach(1 / wheel_step);
}

void Turntable::OnKeyPress() {
    const char* name = Interactor->GetKeySym();
    if (name && hands_) hands_->key(name, Interactor->GetShiftKey() != 0);
}

void Turntable::Rotate() {
    const int* now = Interactor->GetEventPosition();
    const int* before = Interactor->GetLastEventPosition();
    const double per_pixel = degrees_per_window / CurrentRenderer->GetRenderWindow()->GetSize()[1];
    vtkCamera* camera = CurrentRenderer->GetActiveCamera();
    const glm::dvec3 focus = vector(camera->GetFocalPoint());
    const glm::dvec3 away = vector(camera->GetPosition()) - focus;
    const double distance = glm::length(away);
    if (!(distance > 0)) return;
    double azimuth = std::atan2(away.x, away.z);
    double elevation = std::asin(std::clamp(away.y / distance, -1.0, 1.0));
    azimuth -= glm::radians((now[0] - before[0]) * per_pixel);
    elevation -= glm::radians((now[1] - before[1]) * per_pixel);
    elevation = std::clamp(elevation, -glm::radians(steepest), glm::radians(steepest));
    const glm::dvec3 position =
        focus + distance * glm::dvec3(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                      std::cos(elevation) * std::cos(azimuth));
    camera->SetPosition(position.x, position.y, position.z);
    camera->SetViewUp(0, 1, 0);
}

// What is under the pointer at the distance of the focus stays under it.
void Turntable::Pan() {
    const int* now = Interactor->GetEventPosition();
    const int* before = Interactor->GetLastEventPosition();
    vtkCamera* camera = CurrentRenderer->GetActiveCamera();
    double focus[3], from[4], to[4];
    camera->GetFocalPoint(focus);
    double on_screen[3];
    ComputeWorldToDisplay(focus[0], focus[1], focus[2], on_screen);
    ComputeDisplayToWorld(before[0], before[1], on_screen[2], from);
    ComputeDisplayToWorld(now[0], now[1], on_screen[2], to);
    const glm::dvec3 shift = vector(from) - vector(to);
    const glm::dvec3 at = vector(camera->GetPosition()) + shift, focus_now = vector(focus) + shift;
    camera->SetPosition(at.x, at.y, at.z);
    camera->SetFocalPoint(focus_now.x, focus_now.y, focus_now.z);
}

void Turntable::Dolly() {
    const double height = CurrentRenderer->GetRenderWindow()->GetSize()[1];
    const int up = Interactor->GetEventPosition()[1] - Interactor->GetLastEventPosition()[1];
    approach(std::exp(3 * up / height));
}

void Turntable::approach(double factor) {
    const int* at = Interactor->GetEventPosition();
    if (State == VTKIS_NONE) FindPokedRenderer(at[0], at[1]);
    if (!CurrentRenderer) return;
    vtkCamera* camera = CurrentRenderer->GetActiveCamera();
    if (camera->GetParallelProjection()) {
        camera->SetParallelScale(camera->GetParallelScale() / factor);
    } else {
        camera->Dolly(factor);
    }
    if (hands_) hands_->camera_moved();
}

}  // namespace espalier::view
