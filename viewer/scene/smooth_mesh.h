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

/// A scene whose colors run smoothly over its patches: at each corner of a patch the mean of the
/// patches that meet there at a blunt edge, in between straight. To be looked at only: the solution
/// is constant on each patch.
class SmoothMesh {
 public:
  explicit SmoothMesh(const Scene& scene);

  vtkPolyData* surface() const { return surface_; }
  /// One color a patch.
  void color(std::span<const Color8> colors);

 private:
  vtkSmartPointer<vtkPolyData> surface_;
  vtkSmartPointer<vtkUnsignedCharArray> colors_;
  /// Corner k has the mean of neighbors_[begin_[k] … begin_[k + 1]).
  std::vector<std::size_t> begin_;
  std::vector<PatchId> neighbors_;
};

}  // namespace transillum::viewer
