// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/smooth_mesh.h"

#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <array>

#include "transillum/at.h"

namespace transillum::viewer {

namespace {

constexpr double min_cosine = 0.7;  // between normals that are averaged: about 45 degrees

// The patches at each point.
std::vector<std::vector<PatchId>> patches_at_points(const Scene& scene) {
  std::vector<std::vector<PatchId>> patches(scene.points().size());
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    for (const PointId p : scene.outline(i)) {
      at(patches, p).push_back(i);
    }
  }
  return patches;
}

}  // namespace

SmoothMesh::SmoothMesh(const Scene& scene) {
  const auto patches_at = patches_at_points(scene);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  vtkNew<vtkCellArray> polygons;
  begin_.push_back(0);
  for (const Piece& piece : scene.pieces()) {
    const auto corners = scene.corners(piece);
    polygons->InsertNextCell(static_cast<int>(corners.size()));
    for (const PointId corner : corners) {
      const Vec3& p = scene.point(corner);
      polygons->InsertCellPoint(points->InsertNextPoint(p.x, p.y, p.z));
      for (const PatchId other : at(patches_at, corner)) {
        if (dot(scene.patch(other).normal, scene.patch(piece.patch).normal) > min_cosine) {
          neighbors_.push_back(other);
        }
      }
      if (neighbors_.size() == begin_.back()) {
        neighbors_.push_back(piece.patch);
      }
      begin_.push_back(neighbors_.size());
    }
  }
  colors_ = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors_->SetName("color");
  colors_->SetNumberOfComponents(3);
  colors_->SetNumberOfTuples(points->GetNumberOfPoints());
  colors_->FillValue(0);
  surface_ = vtkSmartPointer<vtkPolyData>::New();
  surface_->SetPoints(points);
  surface_->SetPolys(polygons);
  surface_->GetPointData()->SetScalars(colors_);
}

void SmoothMesh::leave_out(const Scene& scene, const std::vector<bool>& hidden) {
  vtkNew<vtkCellArray> polygons;
  vtkIdType next = 0;  // corners are in the order of the pieces
  for (const Piece& piece : scene.pieces()) {
    const auto corners = static_cast<vtkIdType>(scene.corners(piece).size());
    if (!at(hidden, piece.patch)) {
      polygons->InsertNextCell(static_cast<int>(corners));
      for (vtkIdType corner = next; corner < next + corners; ++corner) {
        polygons->InsertCellPoint(corner);
      }
    }
    next += corners;
  }
  surface_->SetPolys(polygons);
  surface_->Modified();
}

void SmoothMesh::color(std::span<const Color8> colors) {
  for (std::size_t k = 0; k + 1 < begin_.size(); ++k) {
    std::array<unsigned, 3> sum{};
    for (std::size_t n = begin_[k]; n < begin_[k + 1]; ++n) {
      for (std::size_t c = 0; c < 3; ++c) {
        sum[c] += at(colors, neighbors_[n])[c];
      }
    }
    const auto count = static_cast<unsigned>(begin_[k + 1] - begin_[k]);
    Color8 mean;
    for (std::size_t c = 0; c < 3; ++c) {
      mean[c] = static_cast<std::uint8_t>(sum[c] / count);
    }
    colors_->SetTypedTuple(static_cast<vtkIdType>(k), mean.data());
  }
  colors_->Modified();
  surface_->Modified();
}

}  // namespace transillum::viewer
