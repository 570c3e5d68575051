// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A scene as VTK polygons in the colors of its patches.
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

/// A scene with colors interpolated across patches: at each corner the mean color of the patches
/// that meet there at less than about 45 degrees, linear in between. For display only: the solution
/// is constant on each patch.
class SmoothMesh {
 public:
  explicit SmoothMesh(const Scene& scene);

  vtkPolyData* surface() const { return surface_; }
  /// Omits patches of the scene.
  /// @param hidden  one per patch
  void leave_out(const Scene& scene, const std::vector<bool>& hidden);
  /// One color per patch.
  void color(std::span<const Color8> colors);

 private:
  vtkSmartPointer<vtkPolyData> surface_;
  vtkSmartPointer<vtkUnsignedCharArray> colors_;
  /// Corner k gets the mean color of neighbors_[begin_[k] … begin_[k + 1]).
  std::vector<std::size_t> begin_;
  std::vector<PatchId> neighbors_;
};

}  // namespace transillum::viewer
