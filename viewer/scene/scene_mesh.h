// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <memory>
#include <span>
#include <vector>

#include "colors/color_map.h"
#include "transillum/scene.h"

namespace transillum::viewer {

/// A scene as VTK polygons: one cell per piece, in the color of its patch.
class SceneMesh {
 public:
  explicit SceneMesh(std::shared_ptr<const Scene> scene);

  vtkPolyData* surface() const { return surface_; }
  /// Omits patches.
  /// @param hidden  one per patch
  void leave_out(const std::vector<bool>& hidden);
  /// One color per patch. Changes the cells' colors, never their shape.
  void color(std::span<const Color8> colors);

 private:
  std::shared_ptr<const Scene> scene_;
  vtkSmartPointer<vtkPolyData> surface_;
  std::vector<PatchId> patches_;  ///< patch of each cell
  vtkSmartPointer<vtkUnsignedCharArray> colors_;
};

/// The outlines of patches, `lift` meters in front of them.
vtkSmartPointer<vtkPolyData> patch_outlines(const Scene& scene, std::span<const PatchId> patches,
                                            double lift);

}  // namespace transillum::viewer
