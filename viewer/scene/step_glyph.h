// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "colors/color_map.h"
#include "model/recorded_map.h"

namespace transillum::viewer {

/// The polygon that a step processes, lit up in the scene, even through what hides it.
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

/// The middle of the polygon that a step processes.
Vec3 center_of_step(const RecordedMap& map, std::int32_t step);

/// Dims the colors of the patches that steps after `step` still have to process.
void dim_what_is_to_come(const RecordedMap& map, std::int32_t step, std::vector<Color8>& colors);

}  // namespace transillum::viewer
