// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Highlights the fragment of a step in the 3-D view, and dims the patches of later steps. Input: a
// recorded map and a step of it.
#include "scene/step_glyph.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include "transillum/at.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

vtkSmartPointer<vtkActor> actor_on_top(vtkPolyData* data, const QColor& color, double units,
                                       vtkRenderer& renderer) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(0, units);
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0, units);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(color.redF(), color.greenF(), color.blueF());
  actor->PickableOff();
  actor->VisibilityOff();
  renderer.AddActor(actor);
  return actor;
}

}  // namespace

StepGlyph::StepGlyph(vtkRenderer& renderer)
    : polygon_(vtkSmartPointer<vtkPolyData>::New()), loop_(vtkSmartPointer<vtkPolyData>::New()) {
  // Depth offsets that put the glyph in front of the whole scene.
  fill_ = actor_on_top(polygon_, theme::processed, -1e5, renderer);
  fill_->GetProperty()->SetOpacity(0.55);
  fill_->ForceOpaqueOn();  // like DirectionGlyph
  halo_ = actor_on_top(loop_, Qt::black, -1.1e5, renderer);
  border_ = actor_on_top(loop_, theme::processed, -1.2e5, renderer);
}

void StepGlyph::show(const RecordedMap& map, std::int32_t step) {
  const BspTree& tree = *map.loaded->tree;
  const auto& fragment = tree.fragment(at(map.record().order, step));
  vtkNew<vtkPoints> points;
  std::vector<vtkIdType> corners;
  for (const BspTree::Corner& corner : tree.corners(fragment)) {
    const Vec3& p = at(tree.points(), corner.point);
    corners.push_back(points->InsertNextPoint(p.x, p.y, p.z));
  }
  vtkNew<vtkCellArray> polygon, loop;
  polygon->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
  corners.push_back(corners.front());
  loop->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
  polygon_->SetPoints(points);
  polygon_->SetPolys(polygon);
  loop_->SetPoints(points);
  loop_->SetLines(loop);
  for (vtkActor* actor : {fill_.Get(), halo_.Get(), border_.Get()}) {
    actor->VisibilityOn();
  }
}

void StepGlyph::hide() {
  for (vtkActor* actor : {fill_.Get(), halo_.Get(), border_.Get()}) {
    actor->VisibilityOff();
  }
}

void StepGlyph::set_line_width(double pixels) {
  halo_->GetProperty()->SetLineWidth(static_cast<float>(2 * pixels));
  border_->GetProperty()->SetLineWidth(static_cast<float>(pixels));
}

Vec3 center_of_step(const RecordedMap& map, std::int32_t step) {
  const BspTree& tree = *map.loaded->tree;
  const auto corners = tree.corners(tree.fragment(at(map.record().order, step)));
  Vec3 sum;
  for (const BspTree::Corner& corner : corners) {
    sum = sum + at(tree.points(), corner.point);
  }
  return (1.0 / static_cast<double>(corners.size())) * sum;
}

std::vector<bool> later_patches(const RecordedMap& map, std::int32_t step) {
  const auto& patches = map.record().step_patch;
  std::vector<bool> is_later(map.loaded->scene->patches().size(), false);
  for (std::int32_t k = step + 1; k < std::ssize(patches); ++k) {
    at(is_later, at(patches, k)) = true;
  }
  return is_later;
}

void dim_patches(const std::vector<bool>& dimmed, std::vector<Color8>& colors) {
  const int background[3] = {theme::scene_background.red(), theme::scene_background.green(),
                             theme::scene_background.blue()};
  for (std::size_t p = 0; p < colors.size(); ++p) {
    if (!dimmed[p]) {
      continue;
    }
    Color8& color = colors[p];
    // Gray and dark, but still visible against the background.
    const int gray = (2 * color[0] + 5 * color[1] + color[2]) / 8;
    for (std::size_t c = 0; c < 3; ++c) {
      color[c] = static_cast<unsigned char>(background[c] + 14 + (gray - background[c]) / 5);
    }
  }
}

}  // namespace transillum::viewer
