// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/window_image.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkWindowToImageFilter.h>

namespace transillum::viewer {

QImage image_of_window(vtkRenderWindow& window, int scale) {
  vtkNew<vtkWindowToImageFilter> filter;
  filter->SetInput(&window);
  filter->SetScale(scale);
  filter->ReadFrontBufferOff();
  filter->SetInputBufferTypeToRGB();
  filter->Update();
  vtkImageData* pixels = filter->GetOutput();
  const int* size = pixels->GetDimensions();
  const auto* bytes = static_cast<const uchar*>(pixels->GetScalarPointer());
  if (!bytes) {
    return {};
  }
  // VTK stores the bottom row first.
  return QImage(bytes, size[0], size[1], 3 * size[0], QImage::Format_RGB888).mirrored();
}

}  // namespace transillum::viewer
