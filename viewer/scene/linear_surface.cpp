// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// VTK interpolates colors of corners, but the color of a mean is not the mean of colors: neither
// with a gamma, nor with a color map, nor where values are below 0 or too bright. So the values go
// through the vertex shader, and the fragment shader does what ColorScale::color() does. Blocks of
// VTK's shaders for polygons are replaced. A geometry shader, which VTK adds for edges and thick
// lines, passes the values on ("VSOut" is then renamed in the fragment shader).
#include "scene/linear_surface.h"

#include <vtkCellArray.h>
#include <vtkDataObject.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "transillum/at.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

constexpr const char* values_name = "light";
constexpr const char* attribute_name = "lightMC";
constexpr int most_map_colors = 16;

constexpr const char* vertex_declarations = R"(
in vec4 lightMC;
out vec4 lightVSOutput;
//VTK::Color::Dec
)";
constexpr const char* geometry_declarations = R"(
in vec4 lightVSOutput[];
out vec4 lightGSOutput;
//VTK::Color::Dec
)";
constexpr const char* fragment_functions = R"(
//VTK::Color::Dec
in vec4 lightVSOutput;
vec3 color_of_map(float t) {
  float place = clamp(t, 0.0, 1.0) * float(lightMapLast);
  int below = min(int(place), lightMapLast - 1);
  return mix(lightMap[below], lightMap[below + 1], place - float(below));
}
vec3 color_of_light(vec3 b) {
  if (lightTrueColor != 0) {
    vec3 exposed = max(lightFactor * b, vec3(0.0));
    float largest = max(exposed.r, max(exposed.g, exposed.b));
    return pow(exposed / max(largest, 1.0), vec3(lightExponent));
  }
  float value = dot(lightWeights, b);
  if (lightMarksZero != 0 && value == 0.0) {
    return lightZeroColor;
  }
  if (lightLogarithmic != 0) {
    return color_of_map(value > 0.0 ? log(value / lightLow) / log(lightHigh / lightLow) : 0.0);
  }
  return color_of_map((value - lightLow) / (lightHigh - lightLow));
}
vec3 dimmed(vec3 color) {
  float gray = dot(vec3(2.0, 5.0, 1.0) / 8.0, color);
  return lightBackground + 14.0 / 255.0 + (vec3(gray) - lightBackground) / 5.0;
}
)";
constexpr const char* fragment_color = R"(
//VTK::Color::Impl
  float lightMark = floor(lightVSOutput.a + 0.5);
  vec3 shownColor = lightMark > 1.5 ? lightOmittedColor : color_of_light(lightVSOutput.rgb);
  ambientColor = vec3(0.0);
  diffuseColor = mod(lightMark, 2.0) > 0.5 ? dimmed(shownColor) : shownColor;
)";

void replace_shaders(vtkShaderProperty& shaders) {
  const std::string declarations = "//VTK::Color::Dec", color = "//VTK::Color::Impl";
  shaders.AddVertexShaderReplacement(declarations, true, vertex_declarations, false);
  shaders.AddVertexShaderReplacement(color, true, color + "\n  lightVSOutput = lightMC;\n", false);
  shaders.AddGeometryShaderReplacement(declarations, true, geometry_declarations, false);
  shaders.AddGeometryShaderReplacement(color, true,
                                       color + "\n  lightGSOutput = lightVSOutput[i];\n", false);
  shaders.AddFragmentShaderReplacement(declarations, true, fragment_functions, false);
  shaders.AddFragmentShaderReplacement(color, true, fragment_color, false);
}

std::array<float, 3> from_bytes(const Color8& color) {
  return {static_cast<float>(color[0]) / 255, static_cast<float>(color[1]) / 255,
          static_cast<float>(color[2]) / 255};
}

/// The weights of red, green and blue in the shown value.
std::array<float, 3> weights_of(const ColorScale& scale) {
  return {static_cast<float>(scale.value({1, 0, 0})), static_cast<float>(scale.value({0, 1, 0})),
          static_cast<float>(scale.value({0, 0, 1}))};
}

void set_scale(vtkUniforms& uniforms, const ColorScale& scale) {
  uniforms.SetUniformi("lightTrueColor", scale.mode == ColorMode::true_color ? 1 : 0);
  uniforms.SetUniformf("lightFactor", static_cast<float>(std::exp2(scale.exposure)));
  uniforms.SetUniformf("lightExponent", static_cast<float>(1 / scale.gamma));
  uniforms.SetUniform3f("lightWeights", weights_of(scale).data());
  uniforms.SetUniformi("lightMarksZero", scale.marks_zero ? 1 : 0);
  uniforms.SetUniform3f("lightZeroColor", from_bytes(zero_color).data());
  uniforms.SetUniform3f("lightOmittedColor", from_bytes(omitted_color).data());
  uniforms.SetUniformi("lightLogarithmic", scale.logarithmic ? 1 : 0);
  uniforms.SetUniformf("lightLow", static_cast<float>(scale.low));
  uniforms.SetUniformf("lightHigh", static_cast<float>(scale.high));
  const std::span<const Color8> samples = samples_of(scale.map);
  float map[most_map_colors][3] = {};
  for (std::size_t k = 0; k < samples.size(); ++k) {
    std::ranges::copy(from_bytes(samples[k]), map[k]);
  }
  uniforms.SetUniform3fv("lightMap", most_map_colors, map);
  uniforms.SetUniformi("lightMapLast", static_cast<int>(samples.size()) - 1);
  const QColor& background = theme::scene_background;
  const float rgb[3] = {static_cast<float>(background.redF()),
                        static_cast<float>(background.greenF()),
                        static_cast<float>(background.blueF())};
  uniforms.SetUniform3f("lightBackground", rgb);
}

}  // namespace

LinearSurface::LinearSurface(vtkRenderer& renderer, vtkProperty& property)
    : surface_(vtkSmartPointer<vtkPolyData>::New()),
      mapper_(vtkSmartPointer<vtkPolyDataMapper>::New()),
      actor_(vtkSmartPointer<vtkActor>::New()) {
  mapper_->ScalarVisibilityOff();
  mapper_->SetInputData(surface_);
  mapper_->MapDataArrayToVertexAttribute(attribute_name, values_name,
                                         vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  actor_->SetMapper(mapper_);
  actor_->SetProperty(&property);
  actor_->VisibilityOff();
  replace_shaders(*actor_->GetShaderProperty());
  renderer.AddActor(actor_);
}

void LinearSurface::show_scene(std::shared_ptr<const Scene> scene) {
  scene_ = std::move(scene);
  hidden_.assign(scene_->patches().size(), false);
  made_ = false;
  hide();
}

void LinearSurface::leave_out(const std::vector<bool>& hidden) {
  hidden_ = hidden;
  made_ = false;
}

void LinearSurface::make_points() {
  made_ = true;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  vtkNew<vtkCellArray> polygons;
  for (const Piece& piece : scene_->pieces()) {
    if (at(hidden_, piece.patch)) {
      continue;
    }
    const auto corners = scene_->corners(piece);
    polygons->InsertNextCell(static_cast<int>(corners.size()));
    for (const PointId corner : corners) {
      const Vec3& p = scene_->point(corner);
      polygons->InsertCellPoint(points->InsertNextPoint(p.x, p.y, p.z));
    }
  }
  light_ = vtkSmartPointer<vtkFloatArray>::New();
  light_->SetName(values_name);
  light_->SetNumberOfComponents(4);
  light_->SetNumberOfTuples(points->GetNumberOfPoints());
  surface_->SetPoints(points);
  surface_->SetPolys(polygons);
  surface_->GetPointData()->Initialize();
  surface_->GetPointData()->AddArray(light_);
}

void LinearSurface::show(const ColorChoice& colors, const std::vector<bool>& dimmed) {
  if (!made_) {
    make_points();
  }
  vtkIdType next = 0;
  for (const Piece& piece : scene_->pieces()) {
    if (at(hidden_, piece.patch)) {
      continue;
    }
    const float dim = !dimmed.empty() && at(dimmed, piece.patch) ? 1 : 0;
    for (const PointId corner : scene_->corners(piece)) {
      Rgb value = colors.value_at(piece.patch, scene_->point(corner));
      const bool is_omitted = std::isnan(value.r);
      if (is_omitted) {
        value = {};
      }
      const float mark = dim + (is_omitted ? 2.0F : 0.0F);
      const float tuple[4] = {static_cast<float>(value.r), static_cast<float>(value.g),
                              static_cast<float>(value.b), mark};
      light_->SetTypedTuple(next++, tuple);
    }
  }
  light_->Modified();
  surface_->Modified();
  set_scale(*actor_->GetShaderProperty()->GetFragmentCustomUniforms(), colors.scale());
  actor_->VisibilityOn();
}

}  // namespace transillum::viewer
