// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

namespace transillum {
class Scene;
struct OrientationPlan;
}  // namespace transillum

namespace transillum::viewer {

/// The faces that an OrientationPlan would change, drawn over the scene and seen from both sides.
class TurnPreview {
 public:
  explicit TurnPreview(vtkRenderer& renderer);

  /// @param plan for the faces of `scene`
  void show(const Scene& scene, const OrientationPlan& plan);
  void hide();
  bool shown() const { return actor_->GetVisibility() != 0; }

 private:
  vtkSmartPointer<vtkActor> actor_;
};

}  // namespace transillum::viewer
