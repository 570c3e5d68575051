// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>

#include <algorithm>
#include <functional>

namespace transillum::viewer {

/// How drags and keys move the camera. VTK's keys are off, which end the program ("e", "q") or
/// change the picture ("w", "3").
class CameraStyle : public vtkInteractorStyleTrackballCamera {
 public:
  static CameraStyle* New() { VTK_STANDARD_NEW_BODY(CameraStyle); }
  void OnChar() override {}
  void Rotate() override {
    if (!turn) {
      vtkInteractorStyleTrackballCamera::Rotate();
      return;
    }
    // A drag across the whole picture turns by 200 degrees, like VTK's trackball.
    const int* now = Interactor->GetEventPosition();
    const int* before = Interactor->GetLastEventPosition();
    const int* size = Interactor->GetSize();
    turn(-200.0 * (now[0] - before[0]) / std::max(size[0], 1),
         -200.0 * (now[1] - before[1]) / std::max(size[1], 1));
  }

  /// Turns by azimuth and elevation, degrees; empty for a trackball.
  std::function<void(double, double)> turn;
};

}  // namespace transillum::viewer
