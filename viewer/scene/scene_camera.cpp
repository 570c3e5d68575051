// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The camera of the 3-D view. A view that was fitted follows the size of the window until the
// camera is moved.
#include <QVTKOpenGLNativeWidget.h>
#include <vtkCamera.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <utility>

#include "scene/camera_style.h"
#include "scene/scene_view.h"

namespace transillum::viewer {
namespace {

Vec3 vec3(const double p[3]) { return {p[0], p[1], p[2]}; }

double aspect_of(const QSize& size) {
  return static_cast<double>(size.width()) / std::max(size.height(), 1);
}

}  // namespace

void SceneView::reset_view() {
  if (loaded_) {
    fit([this] {
      const ViewPoint view = initial_view(*loaded_->scene, aspect(), vertical_);
      focus_point_ = view.target;
      radius_ = view.radius;
      return view;
    });
  }
}

void SceneView::fit(std::function<ViewPoint()> view) {
  refit_ = std::move(view);
  set_camera(refit_());
  fitted_ = view_point();
}

/// Fits the view to a new size. A view that was set as it is stays until the camera is moved.
void SceneView::follow_size(const QSize& before) {
  if (!loaded_) {
    return;
  }
  if (!(view_point() == fitted_) && !before.isEmpty()) {
    refit_ = [this, moved = view_point(), old = aspect_of(before)] {
      return widened(moved, old, aspect());
    };
  }
  if (refit_) {
    fit(refit_);
  }
}

double SceneView::aspect() const { return aspect_of(canvas_->size()); }

void SceneView::fit_all() {
  if (loaded_) {
    fit([this] { return fitting_view(*loaded_->scene, view_point(), aspect()); });
  }
}

void SceneView::fit_selected() {
  const PatchId patch = selection_.patch();
  if (loaded_ && patch >= 0 && patch < loaded_->scene->patch_count()) {
    set_camera(patch_view(*loaded_->scene, patch, view_point()));
  }
}

void SceneView::view_from_side(Side side) {
  if (loaded_) {
    fit([this, side] { return standard_view(*loaded_->scene, side, aspect(), vertical_); });
  }
}

ViewPoint SceneView::view_point() const {
  vtkCamera* camera = renderer_->GetActiveCamera();
  return {vec3(camera->GetPosition()), vec3(camera->GetFocalPoint()), vec3(camera->GetViewUp()),
          camera->GetViewAngle(), radius_};
}

void SceneView::set_view_point(const ViewPoint& view) {
  if (loaded_) {
    set_camera(view);
    refit_ = nullptr;
    fitted_ = view_point();
  }
}

void SceneView::turn(double azimuth, double elevation) {
  if (loaded_) {
    set_camera(turned(view_point(), vertical_, azimuth, elevation));
  }
}

void SceneView::set_turntable(bool turntable) {
  turntable_ = turntable;
  auto* style = static_cast<CameraStyle*>(canvas_->interactor()->GetInteractorStyle());
  style->turn = nullptr;
  if (turntable) {
    style->turn = [this](double azimuth, double elevation) { turn(azimuth, elevation); };
    turn(0, 0);
  }
}

void SceneView::set_camera(const ViewPoint& view) {
  vtkCamera* camera = renderer_->GetActiveCamera();
  camera->SetPosition(view.eye.x, view.eye.y, view.eye.z);
  camera->SetFocalPoint(view.target.x, view.target.y, view.target.z);
  camera->SetViewUp(view.up.x, view.up.y, view.up.z);
  camera->SetViewAngle(view.view_angle);
  show_direction();
  render();
}

}  // namespace transillum::viewer
