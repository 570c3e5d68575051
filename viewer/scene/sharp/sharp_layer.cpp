// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/sharp/sharp_layer.h"

#include <vtkObjectFactory.h>
#include <vtkOpenGLQuadHelper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkRenderer.h>
#include <vtkShaderProgram.h>

namespace transillum::viewer {

namespace {

constexpr unsigned depth_test =
    0x0B71;  // GL_DEPTH_TEST; VTK's versions have it in different headers

// A part of a large picture is drawn as a tile. The first row of a QImage is the upper one.
constexpr const char* fragment_shader = R"(
//VTK::System::Dec
//VTK::Output::Dec
in vec2 texCoord;
uniform sampler2D sharpPicture;
uniform vec4 sharpTile;
void main() {
  vec2 place = mix(sharpTile.xy, sharpTile.zw, texCoord);
  vec4 color = texture(sharpPicture, vec2(place.x, 1.0 - place.y));
  if (color.a < 0.5) {
    discard;
  }
  gl_FragData[0] = vec4(color.rgb, 1.0);
}
)";

}  // namespace

vtkStandardNewMacro(SharpLayer);

SharpLayer::SharpLayer() {
  VisibilityOff();
  PickableOff();
}

SharpLayer::~SharpLayer() = default;

void SharpLayer::set_picture(const QImage& picture) {
  picture_ = picture;
  loaded_ = false;
  SetVisibility(!picture.isNull());
}

int SharpLayer::RenderOpaqueGeometry(vtkViewport* viewport) {
  auto* window =
      vtkOpenGLRenderWindow::SafeDownCast(static_cast<vtkRenderer*>(viewport)->GetRenderWindow());
  if (!loaded_) {
    texture_->SetContext(window);
    texture_->Create2DFromRaw(static_cast<unsigned>(picture_.width()),
                              static_cast<unsigned>(picture_.height()), 4, VTK_UNSIGNED_CHAR,
                              const_cast<uchar*>(picture_.constBits()));
    texture_->SetMinificationFilter(vtkTextureObject::Nearest);
    texture_->SetMagnificationFilter(vtkTextureObject::Nearest);
    loaded_ = true;
  }
  if (!quad_) {
    quad_ = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, fragment_shader, nullptr);
  } else {
    window->GetShaderCache()->ReadyShaderProgram(quad_->Program);
  }
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable depth(state, depth_test);
  state->vtkglDisable(depth_test);
  texture_->Activate();
  const double* tile = window->GetTileViewport();
  const float corners[4] = {static_cast<float>(tile[0]), static_cast<float>(tile[1]),
                            static_cast<float>(tile[2]), static_cast<float>(tile[3])};
  quad_->Program->SetUniform4f("sharpTile", corners);
  quad_->Program->SetUniformi("sharpPicture", texture_->GetTextureUnit());
  quad_->Render();
  texture_->Deactivate();
  return 1;
}

void SharpLayer::ReleaseGraphicsResources(vtkWindow* window) {
  quad_ = nullptr;
  texture_->ReleaseGraphicsResources(window);
  loaded_ = false;
  vtkProp::ReleaseGraphicsResources(window);
}

}  // namespace transillum::viewer
