// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Light paths in the 3-D view, as VTK actors. SceneView passes the paths of the panel "Light
// paths".
#include "scene/path_glyph.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCoordinate.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <QString>
#include <algorithm>
#include <cmath>

#include "colors/color_scale.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

vtkSmartPointer<vtkActor> line_actor(vtkPolyData* data, double units, vtkRenderer& renderer) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetColorModeToDirectScalars();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  // A depth offset puts the lines in front of the whole scene, like StepGlyph.
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0, units);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->PickableOff();
  actor->VisibilityOff();
  renderer.AddActor(actor);
  return actor;
}

void add_line(vtkPolyData& data, const Scene& scene, const LightPath& path) {
  std::vector<vtkIdType> ends;
  for (const PatchId patch : path.patches) {
    const Vec3& p = scene.patch(patch).center;
    ends.push_back(data.GetPoints()->InsertNextPoint(p.x, p.y, p.z));
  }
  data.GetLines()->InsertNextCell(static_cast<vtkIdType>(ends.size()), ends.data());
}

void start_lines(vtkPolyData& data) {
  data.SetPoints(vtkNew<vtkPoints>());
  data.SetLines(vtkNew<vtkCellArray>());
}

// The point at a fraction of the length of a path.
Vec3 point_on(const Scene& scene, const LightPath& path, double fraction) {
  const auto center = [&](std::size_t k) { return scene.patch(path.patches[k]).center; };
  double length = 0;
  for (std::size_t k = 1; k < path.patches.size(); ++k) {
    length += norm(center(k) - center(k - 1));
  }
  double left = fraction * length;
  for (std::size_t k = 1; k < path.patches.size(); ++k) {
    const double step = norm(center(k) - center(k - 1));
    if (left <= step) {
      return center(k - 1) + (step > 0 ? left / step : 0.0) * (center(k) - center(k - 1));
    }
    left -= step;
  }
  return center(path.patches.size() - 1);
}

}  // namespace

PathGlyph::PathGlyph(vtkRenderer& renderer)
    : lines_(vtkSmartPointer<vtkPolyData>::New()),
      emphasized_(vtkSmartPointer<vtkPolyData>::New()) {
  lines_actor_ = line_actor(lines_, -1e5, renderer);
  emphasized_actor_ = line_actor(emphasized_, -1.2e5, renderer);
  const QColor& color = theme::processed;
  emphasized_actor_->GetProperty()->SetColor(color.redF(), color.greenF(), color.blueF());
  for (auto& text : labels_) {
    text = vtkSmartPointer<vtkTextActor>::New();  // over everything, at a place in the scene
    text->GetPositionCoordinate()->SetCoordinateSystemToWorld();
    text->GetTextProperty()->SetColor(1, 1, 1);
    text->GetTextProperty()->SetBackgroundColor(0, 0, 0);
    text->GetTextProperty()->SetBackgroundOpacity(0.6);
    text->GetTextProperty()->SetJustificationToCentered();
    text->GetTextProperty()->SetVerticalJustificationToCentered();
    text->PickableOff();
    text->VisibilityOff();
    renderer.AddActor2D(text);
  }
}

void PathGlyph::show(const Scene& scene, const LightPaths& paths, int emphasized) {
  hide();
  start_lines(*lines_);
  start_lines(*emphasized_);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  std::size_t slot = 0;
  for (std::size_t k = paths.paths.size(); k-- > 0;) {  // the strongest on top
    const LightPath& path = paths.paths[k];
    if (path.patches.size() < 2) {
      continue;
    }
    add_line(*lines_, scene, path);
    // The square root makes weak paths visible beside strong ones.
    const double strength =
        std::sqrt(luminance(path.contribution) / luminance(paths.paths.front().contribution));
    const auto gray = static_cast<unsigned char>(70 + std::lround(185 * std::min(strength, 1.0)));
    colors->InsertNextTuple3(gray, gray, gray * 0.85);
  }
  lines_->GetCellData()->SetScalars(colors);
  lines_->Modified();
  for (std::size_t k = 0; k < paths.paths.size() && slot + 1 < labels_.size(); ++k) {
    if (paths.paths[k].patches.size() > 1 && static_cast<int>(k) != emphasized) {
      label(slot++, scene, paths, k);
    }
  }
  lines_actor_->VisibilityOn();
  if (emphasized >= 0 && at(paths.paths, emphasized).patches.size() > 1) {
    add_line(*emphasized_, scene, at(paths.paths, emphasized));
    label(labels_.size() - 1, scene, paths, static_cast<std::size_t>(emphasized));
    emphasized_actor_->VisibilityOn();
  }
  emphasized_->Modified();
}

void PathGlyph::label(std::size_t slot, const Scene& scene, const LightPaths& paths,
                      std::size_t path) {
  // Paths may have parts in common: their labels are at different places.
  constexpr double places[] = {0.5, 0.62, 0.38, 0.5};
  const Vec3 place = point_on(scene, paths.paths[path], at(places, slot));
  const double fraction =
      100 * luminance(paths.paths[path].contribution) / luminance(paths.radiosity);
  const QString text = QStringLiteral(" %1 % ").arg(fraction, 0, 'g', 3);
  labels_[slot]->SetInput(text.toUtf8().constData());
  labels_[slot]->GetPositionCoordinate()->SetValue(place.x, place.y, place.z);
  labels_[slot]->VisibilityOn();
}

void PathGlyph::hide() {
  lines_actor_->VisibilityOff();
  emphasized_actor_->VisibilityOff();
  for (const auto& text : labels_) {
    text->VisibilityOff();
  }
}

void PathGlyph::set_line_width(double pixels) {
  lines_actor_->GetProperty()->SetLineWidth(static_cast<float>(pixels));
  emphasized_actor_->GetProperty()->SetLineWidth(static_cast<float>(2 * pixels));
  for (const auto& text : labels_) {
    // VTK multiplies it by the density of the screen.
    text->GetTextProperty()->SetFontSize(static_cast<int>(std::lround(13 * theme::scale())));
  }
}

}  // namespace transillum::viewer
