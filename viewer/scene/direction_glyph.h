// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The direction of light over the scene, and the step in focus.
#pragma once

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "colors/color_map.h"
#include "model/requests/recorded_map.h"
#include "transillum/scene.h"
#include "transillum/vec3.h"

namespace transillum::viewer {

/// Red, green and blue of arrows and plane, in [0, 1].
inline constexpr double direction_color[3] = {1.0, 0.72, 0.15};

/// A transillumination direction: arrows along which light travels, and the plane across them.
class DirectionGlyph {
 public:
  explicit DirectionGlyph(vtkRenderer& renderer);

  /// `omega` points toward the source: light travels along -omega, and also along omega if
  /// `two_way` is set. The plane is just outside the scene, or outside the part of interest of a
  /// large enclosure, `radius` around `center`; on the side nearer to `eye`. Lengths in meters.
  void show(const Vec3& omega, bool two_way, const Scene& scene, const Vec3& center, double radius,
            const Vec3& eye);
  /// The same with the plane through `middle`.
  void show_at(const Vec3& omega, bool two_way, const Vec3& middle, double radius);
  void hide();
  /// Whether the plane is filled, translucent; otherwise it is a frame, which tints no color.
  void set_filled(bool filled);
  /// The end of the arrow along omega, m; valid while the glyph is shown.
  const Vec3& tip() const { return tip_; }
  bool shown() const { return shown_; }
  void set_line_width(double pixels);

 private:
  bool filled_ = true, shown_ = false;
  vtkSmartPointer<vtkActor> fill_, border_, forward_, backward_;
  vtkSmartPointer<vtkPolyData> quad_, frame_;
  Vec3 tip_;
};

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
