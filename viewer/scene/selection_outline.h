// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "model/snapshot.h"

namespace transillum::viewer {

/// The outlines of the selected patches, with a dark halo.
class SelectionOutline {
 public:
  explicit SelectionOutline(vtkRenderer& renderer);

  std::vector<vtkActor*> actors() const { return {halo_, outline_}; }
  /// @param loaded  null without a scene
  /// @param patches  ascending; nothing is shown where they are none of the scene
  /// @param lift  distance from the patches, m
  void show(const LoadedScene* loaded, const std::vector<PatchId>& patches, double lift);
  /// Scaled about the camera, the outline stays in place in the picture but is in front of its
  /// halo.
  void follow_camera(const Vec3& eye);
  void set_line_width(double pixels);

 private:
  vtkSmartPointer<vtkActor> halo_, outline_;
};

}  // namespace transillum::viewer
