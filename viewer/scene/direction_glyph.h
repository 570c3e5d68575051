// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "transillum/vec3.h"

namespace transillum::viewer {

/// A transillumination direction: arrows the way the light travels, and the plane it crosses.
class DirectionGlyph {
 public:
  explicit DirectionGlyph(vtkRenderer& renderer);

  /// `omega` points toward the source: light travels along -omega, and both ways where `two_way`.
  /// The plane stands `distance` from `center`, on the side that is nearer to `eye`; its size goes
  /// with `radius`.
  void show(const Vec3& omega, bool two_way, const Vec3& center, double radius, double distance,
            const Vec3& eye);
  /// The plane through `middle`.
  void show_at(const Vec3& omega, bool two_way, const Vec3& middle, double radius);
  void hide();
  void set_line_width(double pixels);

 private:
  vtkSmartPointer<vtkActor> fill_, border_, forward_, backward_;
  vtkSmartPointer<vtkPolyData> quad_, frame_;
};

}  // namespace transillum::viewer
