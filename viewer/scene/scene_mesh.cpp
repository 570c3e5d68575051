// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/scene_mesh.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <utility>

#include "transillum/at.h"

namespace transillum::viewer {

namespace {

vtkSmartPointer<vtkPoints> points_of(const Scene& scene) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToFloat();
  points->SetNumberOfPoints(static_cast<vtkIdType>(scene.points().size()));
  vtkIdType next = 0;
  for (const Vec3& p : scene.points()) {
    points->SetPoint(next++, p.x, p.y, p.z);
  }
  return points;
}

}  // namespace

SceneMesh::SceneMesh(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {
  colors_ = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors_->SetName("color");
  colors_->SetNumberOfComponents(3);
  surface_ = vtkSmartPointer<vtkPolyData>::New();
  surface_->SetPoints(points_of(*scene_));
  surface_->GetCellData()->SetScalars(colors_);
  leave_out(std::vector<bool>(scene_->patches().size(), false));
}

void SceneMesh::leave_out(const std::vector<bool>& hidden) {
  vtkNew<vtkCellArray> polygons;
  std::vector<vtkIdType> corners;
  patches_.clear();
  for (const Piece& piece : scene_->pieces()) {
    if (at(hidden, piece.patch)) {
      continue;
    }
    const auto outline = scene_->corners(piece);
    corners.assign(outline.begin(), outline.end());
    polygons->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
    patches_.push_back(piece.patch);
  }
  surface_->SetPolys(polygons);
  colors_->SetNumberOfTuples(static_cast<vtkIdType>(patches_.size()));
  colors_->FillValue(0);
}

void SceneMesh::color(std::span<const Color8> colors) {
  vtkIdType cell = 0;
  for (const PatchId patch : patches_) {
    colors_->SetTypedTuple(cell++, at(colors, patch).data());
  }
  colors_->Modified();
  surface_->Modified();
}

vtkSmartPointer<vtkPolyData> patch_outlines(const Scene& scene, std::span<const PatchId> patches,
                                            double lift) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  std::vector<vtkIdType> corners;
  for (const PatchId patch : patches) {
    corners.clear();
    for (const PointId id : scene.outline(patch)) {
      const Vec3 p = scene.point(id) + lift * scene.patch(patch).normal;
      corners.push_back(points->InsertNextPoint(p.x, p.y, p.z));
    }
    corners.push_back(corners.front());
    lines->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
  }
  auto outlines = vtkSmartPointer<vtkPolyData>::New();
  outlines->SetPoints(points);
  outlines->SetLines(lines);
  return outlines;
}

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
