// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <array>

#include "radiosity/form_factors/light_paths.h"
#include "transillum/scene.h"

namespace transillum::viewer {

/// Light paths as lines between the centers of their patches, in front of the whole scene: the
/// stronger, the brighter. The fractions of the strongest paths, and of the emphasized path, are
/// written.
class PathGlyph {
 public:
  explicit PathGlyph(vtkRenderer& renderer);

  /// @param emphasized  index of a path, or -1
  void show(const Scene& scene, const LightPaths& paths, int emphasized);
  void hide();
  bool shown() const { return lines_actor_->GetVisibility() != 0; }
  void set_line_width(double pixels);

 private:
  void label(std::size_t slot, const Scene& scene, const LightPaths& paths, std::size_t path);

  vtkSmartPointer<vtkPolyData> lines_, emphasized_;
  vtkSmartPointer<vtkActor> lines_actor_, emphasized_actor_;
  std::array<vtkSmartPointer<vtkTextActor>, 4> labels_;  ///< the last line is emphasized
};

}  // namespace transillum::viewer
