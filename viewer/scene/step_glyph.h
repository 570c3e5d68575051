// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "colors/color_map.h"
#include "model/requests/recorded_map.h"

namespace transillum::viewer {

/// Highlights a step's fragment in the scene, drawn in front of everything that hides it.
class StepGlyph {
 public:
  explicit StepGlyph(vtkRenderer& renderer);

  void show(const RecordedMap& map, std::int32_t step);
  void hide();
  void set_line_width(double pixels);

 private:
  vtkSmartPointer<vtkPolyData> polygon_, loop_;
  vtkSmartPointer<vtkActor> fill_, halo_, border_;
};

/// The mean of the corners of a step's fragment.
Vec3 center_of_step(const RecordedMap& map, std::int32_t step);

/// Which patches have fragments in steps after `step`, one per patch.
std::vector<bool> later_patches(const RecordedMap& map, std::int32_t step);
/// Makes the colors of patches dark and nearly gray.
/// @param dimmed  one per color
void dim_patches(const std::vector<bool>& dimmed, std::vector<Color8>& colors);

}  // namespace transillum::viewer
