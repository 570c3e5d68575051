// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vtkNew.h>
#include <vtkProp.h>
#include <vtkTextureObject.h>

#include <QImage>
#include <memory>

class vtkOpenGLQuadHelper;

namespace transillum::viewer {

/// A picture over all that the renderer has drawn before it. It changes no depth: what is drawn
/// after it is in front of it, or hidden by the surfaces that it covers.
// VTK deletes by reference counts: its destructors are protected.
// NOLINTNEXTLINE(cppcoreguidelines-virtual-class-destructor)
class SharpLayer final : public vtkProp {
 public:
  static SharpLayer* New();
  // clang-format off
  vtkTypeMacro(SharpLayer, vtkProp)
      // clang-format on

      /// @param picture  as large as the renderer's picture, RGBA; pixels without alpha are
      /// omitted. Null hides it.
      void set_picture(const QImage& picture);
  const QImage& picture() const { return picture_; }

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

 protected:
  SharpLayer();
  ~SharpLayer() override;

 private:
  QImage picture_;
  bool loaded_ = false;  ///< the texture has picture_
  vtkNew<vtkTextureObject> texture_;
  std::unique_ptr<vtkOpenGLQuadHelper> quad_;
};

}  // namespace transillum::viewer
