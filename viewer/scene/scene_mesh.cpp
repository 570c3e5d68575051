// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/scene_mesh.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

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

}  // namespace transillum::viewer
