// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>
#include <memory>

#include "model/snapshot.h"
#include "transillum/at.h"

namespace transillum::viewer {

/// The edges of the fragments of all patches that `tree` cuts, `lift` meters in front of them.
vtkSmartPointer<vtkPolyData> fragment_lines(const Scene& scene, const BspTree& tree, double lift);
/// A line from the center of each patch along its normal, half as long as the patch is wide.
vtkSmartPointer<vtkPolyData> normal_lines(const Scene& scene);

/// Geometry drawn in addition to the colored patches; computed when it is first shown.
class SceneOverlays {
 public:
  enum class Kind { fragments, normals, back_sides };

  explicit SceneOverlays(vtkRenderer& renderer);

  /// @param surface the scene's polygons, to draw their back sides
  /// @param lift meters by which lines are drawn in front of their patches
  void show_scene(std::shared_ptr<const LoadedScene> loaded, vtkPolyData* surface, double lift);
  void set_shown(Kind kind, bool shown);
  void set_line_width(double pixels);

 private:
  void update(Kind kind);

  struct Overlay {
    vtkSmartPointer<vtkActor> actor;
    bool shown = false;
    bool made = false;
  };
  Overlay& overlay(Kind kind) { return at(overlays_, kind); }

  std::array<Overlay, 3> overlays_;
  std::shared_ptr<const LoadedScene> loaded_;
  vtkSmartPointer<vtkPolyData> surface_;
  double lift_ = 0;
};

}  // namespace transillum::viewer
