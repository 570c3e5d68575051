// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// VTK interpolates colors of corners, but the color of a mean is not the mean of colors: neither
// with a gamma, nor with a color map, nor where values are below 0 or too bright. So the values go
// through the vertex shader, and the fragment shader does what ColorScale::color() does. Blocks of
// VTK's shaders for polygons are replaced. A geometry shader, which VTK adds for edges and thick
// lines, passes the values on ("VSOut" is then renamed in the fragment shader). VTK declares the
// sampler "actortexture" for the texture of an actor, and without its texture coordinates does
// nothing else with it.
#include "scene/linear_surface.h"

#include <vtkCellArray.h>
#include <vtkDataObject.h>
#include <vtkImageData.h>
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
  vec3 lightValue = lightVSOutput.rgb;
  if (lightMark > 3.5) {
    lightValue = lightVSOutput.b * texture(actortexture, lightVSOutput.rg).rgb;
  }
  vec3 shownColor = lightMark == 2.0 || lightMark == 3.0 ? lightOmittedColor
                                                         : color_of_light(lightValue);
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

std::array<float, 4> tuple_of(const Rgb& value, bool dimmed) {
  const float dim = dimmed ? 1 : 0;
  if (std::isnan(value.r)) {
    return {0, 0, 0, dim + 2};
  }
  return {static_cast<float>(value.r), static_cast<float>(value.g), static_cast<float>(value.b),
          dim};
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
      actor_(vtkSmartPointer<vtkActor>::New()),
      texture_(vtkSmartPointer<vtkTexture>::New()) {
  mapper_->ScalarVisibilityOff();
  mapper_->SetInputData(surface_);
  mapper_->MapDataArrayToVertexAttribute(attribute_name, values_name,
                                         vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  actor_->SetMapper(mapper_);
  actor_->SetProperty(&property);
  actor_->VisibilityOff();
  replace_shaders(*actor_->GetShaderProperty());
  texture_->SetColorModeToDirectScalars();
  texture_->InterpolateOn();
  texture_->RepeatOff();
  texture_->EdgeClampOn();
  load(nullptr);
  actor_->SetTexture(texture_);
  renderer.AddActor(actor_);
}

void LinearSurface::show_scene(std::shared_ptr<const Scene> scene) {
  scene_ = std::move(scene);
  hidden_.assign(scene_->patches().size(), false);
  made_ = false;
  load(nullptr);
  hide();
}

/// The texture shares the memory of the map.
void LinearSurface::load(std::shared_ptr<const LightMap> map) {
  if (map && map == map_) {
    return;
  }
  vtkNew<vtkFloatArray> values;
  values->SetNumberOfComponents(3);
  vtkNew<vtkImageData> image;
  if (map) {
    const auto& radiosity = map->radiosity();
    constexpr int keeps_memory = 1;
    values->SetArray(const_cast<float*>(radiosity.data()->data()),
                     static_cast<vtkIdType>(3 * radiosity.size()), keeps_memory);
    image->SetDimensions(map->width(), map->height(), 1);
  } else {
    values->InsertNextTuple3(0, 0, 0);
    image->SetDimensions(1, 1, 1);
  }
  image->GetPointData()->SetScalars(values);
  texture_->SetInputData(image);
  map_ = std::move(map);
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
  show(colors.scale(), [&](PatchId patch, const Vec3& point) {
    return tuple_of(colors.value_at(patch, point), !dimmed.empty() && at(dimmed, patch));
  });
}

void LinearSurface::show(const ColorChoice& colors, std::shared_ptr<const LightMap> map,
                         double factor, const std::function<bool(PatchId)>& without_map) {
  load(std::move(map));
  show(colors.scale(), [&](PatchId patch, const Vec3& point) {
    if (without_map(patch)) {
      return tuple_of(colors.value_at(patch, point), false);
    }
    const auto [x, y] = map_->place(patch, point);
    return Tuple{static_cast<float>(x / map_->width()), static_cast<float>(y / map_->height()),
                 static_cast<float>(factor), 4};
  });
}

void LinearSurface::show(const ColorScale& scale,
                         const std::function<Tuple(PatchId, const Vec3&)>& light_at) {
  if (!made_) {
    make_points();
  }
  vtkIdType next = 0;
  for (const Piece& piece : scene_->pieces()) {
    if (at(hidden_, piece.patch)) {
      continue;
    }
    for (const PointId corner : scene_->corners(piece)) {
      light_->SetTypedTuple(next++, light_at(piece.patch, scene_->point(corner)).data());
    }
  }
  light_->Modified();
  surface_->Modified();
  set_scale(*actor_->GetShaderProperty()->GetFragmentCustomUniforms(), scale);
  actor_->VisibilityOn();
}

}  // namespace transillum::viewer
