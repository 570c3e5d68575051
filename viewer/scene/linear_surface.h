// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkActor.h>
#include <vtkFloatArray.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "colors/color_choice.h"
#include "transillum/picture.h"
#include "transillum/scene.h"

namespace transillum::viewer {

/// Draws a quantity that changes within patches: linear, interpolated within each patch, which
/// shares no corner with another, or of a light map. Each pixel gets the color of its own value. So
/// true color, color maps and logarithmic scales are right in every pixel, and values below 0 are
/// drawn as 0.
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
  /// Shows `factor` times the values of a map of the scene, and the values of `colors` on patches
  /// for which `without_map` holds.
  void show(const ColorChoice& colors, std::shared_ptr<const LightMap> map, double factor,
            const std::function<bool(PatchId)>& without_map);
  void hide() { actor_->VisibilityOff(); }

 private:
  using Tuple = std::array<float, 4>;

  void make_points();
  void show(const ColorScale& scale, const std::function<Tuple(PatchId, const Vec3&)>& light_at);
  void load(std::shared_ptr<const LightMap> map);

  std::shared_ptr<const Scene> scene_;
  vtkSmartPointer<vtkPolyData> surface_;
  /// For each point: red, green, blue, and the sum of 1 if it is dimmed and 2 if it has no value.
  /// Or its place in the map, the factor, and 4.
  vtkSmartPointer<vtkFloatArray> light_;
  vtkSmartPointer<vtkPolyDataMapper> mapper_;
  vtkSmartPointer<vtkActor> actor_;
  vtkSmartPointer<vtkTexture> texture_;  ///< has the values of map_; one texel without it
  std::shared_ptr<const LightMap> map_;
  std::vector<bool> hidden_;
  bool made_ = false;  ///< surface_ is of scene_ and hidden_
};

}  // namespace transillum::viewer
