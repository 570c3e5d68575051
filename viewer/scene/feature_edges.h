// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <memory>
#include <span>
#include <vector>

#include "colors/color_map.h"
#include "model/snapshot.h"

namespace transillum::viewer {

/// An edge at which the surface bends or ends.
struct FeatureEdge {
  PointId begin, end;
  PatchId first, second;  ///< second is no_patch where the surface ends
};
/// Edges between patches at more than 20 degrees, and edges of a single patch where the surface
/// does not continue in its plane (it does at a T-junction). Sorted by their points.
std::vector<FeatureEdge> feature_edges(const LoadedScene& loaded);

/// Draws feature edges where both sides have about the same color, so that the shape is seen even
/// if the quantity is the same on all patches. Only edges with a front side toward the camera are
/// drawn.
class FeatureEdges {
 public:
  explicit FeatureEdges(vtkRenderer& renderer);

  void show_scene(std::shared_ptr<const LoadedScene> loaded);
  /// @param colors  one per patch
  /// @param hidden  whether a patch is omitted, one per patch
  void show(std::span<const Color8> colors, const std::vector<bool>& hidden);
  vtkActor* actor() const { return actor_; }
  void hide();
  bool shown() const { return actor_->GetVisibility() != 0; }
  /// The edges between patches of about the same color, whichever side is toward the camera.
  const std::vector<FeatureEdge>& edges() const { return flat_; }
  /// To be called before each picture: selects the edges with a front side toward `eye`, and draws
  /// them in front of their patches.
  void follow_camera(const Vec3& eye);
  void set_line_width(double pixels);

 private:
  void draw(const Vec3& eye);

  std::shared_ptr<const LoadedScene> loaded_;
  bool found_ = false;  ///< all_ is of loaded_
  std::vector<FeatureEdge> all_, flat_;
  std::vector<Color8> flat_colors_;  ///< colors of the lines, one per edge of flat_
  Vec3 eye_;
  bool drawn_ = false;  ///< lines_ is of flat_ and eye_
  vtkSmartPointer<vtkPolyData> lines_;
  vtkSmartPointer<vtkUnsignedCharArray> colors_;
  vtkSmartPointer<vtkActor> actor_;
};

}  // namespace transillum::viewer
