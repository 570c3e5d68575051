// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkActor.h>
#include <vtkFloatArray.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <vector>

#include "colors/color_choice.h"
#include "transillum/scene.h"

namespace transillum::viewer {

/// Draws a quantity that is linear on patches: the value is interpolated within each patch, which
/// shares no corner with another, and each pixel gets the color of its own value. So true color,
/// color maps and logarithmic scales are right in every pixel, and values below 0 are drawn as 0.
class LinearSurface {
 public:
  /// @param property  of the surface that is drawn for constant quantities
  LinearSurface(vtkRenderer& renderer, vtkProperty& property);

  vtkActor* actor() const { return actor_; }
  /// The surface of a scene, hidden until show().
  void show_scene(std::shared_ptr<const Scene> scene);
  /// Omits patches.
  /// @param hidden  one per patch
  void leave_out(const std::vector<bool>& hidden);
  /// Shows the values of `colors`, which are linear.
  /// @param dimmed  whether a patch is dimmed, one per patch; empty if none is
  void show(const ColorChoice& colors, const std::vector<bool>& dimmed);
  void hide() { actor_->VisibilityOff(); }

 private:
  void make_points();

  std::shared_ptr<const Scene> scene_;
  vtkSmartPointer<vtkPolyData> surface_;
  vtkSmartPointer<vtkFloatArray> light_;  ///< for each point: red, green, blue, and the sum of
                                          ///< 1 if it is dimmed and 2 if it has no value
  vtkSmartPointer<vtkPolyDataMapper> mapper_;
  vtkSmartPointer<vtkActor> actor_;
  std::vector<bool> hidden_;
  bool made_ = false;  ///< surface_ is of scene_ and hidden_
};

}  // namespace transillum::viewer
