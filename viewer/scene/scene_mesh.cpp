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
  vtkNew<vtkCellArray> polygons;
  std::vector<vtkIdType> corners;
  for (const Piece& piece : scene_->pieces()) {
    const auto outline = scene_->corners(piece);
    corners.assign(outline.begin(), outline.end());
    polygons->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
  }
  colors_ = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors_->SetName("color");
  colors_->SetNumberOfComponents(3);
  colors_->SetNumberOfTuples(static_cast<vtkIdType>(scene_->pieces().size()));
  colors_->FillValue(0);

  surface_ = vtkSmartPointer<vtkPolyData>::New();
  surface_->SetPoints(points_of(*scene_));
  surface_->SetPolys(polygons);
  surface_->GetCellData()->SetScalars(colors_);
}

void SceneMesh::color(std::span<const Color8> colors) {
  vtkIdType cell = 0;
  for (const Piece& piece : scene_->pieces()) {
    colors_->SetTypedTuple(cell++, at(colors, piece.patch).data());
  }
  colors_->Modified();
  surface_->Modified();
}

vtkSmartPointer<vtkPolyData> patch_outline(const Scene& scene, PatchId patch, double lift) {
  vtkNew<vtkPoints> points;
  std::vector<vtkIdType> corners;
  for (const PointId id : scene.outline(patch)) {
    const Vec3 p = scene.point(id) + lift * scene.patch(patch).normal;
    corners.push_back(points->InsertNextPoint(p.x, p.y, p.z));
  }
  corners.push_back(corners.front());
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
  auto outline = vtkSmartPointer<vtkPolyData>::New();
  outline->SetPoints(points);
  outline->SetLines(lines);
  return outline;
}

}  // namespace transillum::viewer
