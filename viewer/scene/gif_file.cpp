// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Animated GIF by giflib. VTK selects the colors of each picture, since a GIF has at most 256.
#include "scene/gif_file.h"

#include <gif_lib.h>
#include <vtkImageData.h>
#include <vtkImageQuantizeRGBToIndex.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>

#include <QPainter>
#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace transillum::viewer {

namespace {

constexpr int color_count = 256, color_bits = 8;

int write_bytes(GifFileType* gif, const GifByteType* bytes, int count) {
  auto* file = static_cast<QSaveFile*>(gif->UserData);
  return static_cast<int>(file->write(reinterpret_cast<const char*>(bytes), count));
}

struct FreeColors {
  void operator()(ColorMapObject* colors) const { GifFreeMapObject(colors); }
};

/// A picture as indices of at most 256 colors.
struct IndexedPicture {
  vtkNew<vtkImageQuantizeRGBToIndex> filter;
  std::unique_ptr<ColorMapObject, FreeColors> colors;

  explicit IndexedPicture(const QImage& picture) {
    const QImage rgb = picture.convertToFormat(QImage::Format_RGB888);
    vtkNew<vtkImageData> pixels;
    pixels->SetDimensions(rgb.width(), rgb.height(), 1);
    pixels->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    auto* to = static_cast<unsigned char*>(pixels->GetScalarPointer());
    const std::size_t row = 3 * static_cast<std::size_t>(rgb.width());
    for (int y = 0; y < rgb.height(); ++y) {
      std::memcpy(to + static_cast<std::size_t>(y) * row, rgb.constScanLine(y), row);
    }
    filter->SetInputData(pixels);
    filter->SetNumberOfColors(color_count);
    filter->Update();
    std::array<GifColorType, color_count> table{};
    vtkLookupTable* found = filter->GetLookupTable();
    const vtkIdType count = std::min<vtkIdType>(found->GetNumberOfTableValues(), color_count);
    for (vtkIdType k = 0; k < count; ++k) {
      const double* color = found->GetTableValue(k);
      const auto byte = [&](int channel) {
        return static_cast<GifByteType>(qRound(255 * color[channel]));
      };
      table.at(static_cast<std::size_t>(k)) = {byte(0), byte(1), byte(2)};
    }
    colors.reset(GifMakeMapObject(color_count, table.data()));
  }
  std::vector<GifByteType> row(int y, int width) const {
    const auto* indices =
        static_cast<const unsigned short*>(filter->GetOutput()->GetScalarPointer(0, y, 0));
    std::vector<GifByteType> bytes(static_cast<std::size_t>(width));
    std::transform(indices, indices + width, bytes.begin(),
                   [](unsigned short index) { return static_cast<GifByteType>(index); });
    return bytes;
  }
};

QImage fitted(const QImage& picture, QSize size) {
  if (picture.size() == size) {
    return picture;
  }
  const QImage scaled = picture.scaled(size, Qt::KeepAspectRatio, Qt::SmoothTransformation);
  QImage whole(size, QImage::Format_RGB888);
  whole.fill(Qt::black);
  QPainter(&whole).drawImage((size.width() - scaled.width()) / 2,
                             (size.height() - scaled.height()) / 2, scaled);
  return whole;
}

}  // namespace

void GifFile::Close::operator()(GifFileType* gif) const {
  int error = 0;
  EGifCloseFile(gif, &error);
}

GifFile::GifFile(const QString& path, QSize size, int delay_ms)
    : file_(path), size_(size), delay_(std::max(2, qRound(0.1 * delay_ms))) {
  if (!file_.open(QIODevice::WriteOnly)) {
    throw std::runtime_error((path + ": " + file_.errorString()).toStdString());
  }
  int error = 0;
  gif_.reset(EGifOpen(&file_, write_bytes, &error));
  if (!gif_) {
    throw std::runtime_error(path.toStdString() + ": " + GifErrorString(error));
  }
  EGifSetGifVersion(gif_.get(), true);
  check(EGifPutScreenDesc(gif_.get(), size.width(), size.height(), color_bits, 0, nullptr));
  // Browsers and presentations repeat what has this extension.
  constexpr GifByteType repeated[] = {1, 0, 0};
  check(EGifPutExtensionLeader(gif_.get(), APPLICATION_EXT_FUNC_CODE));
  check(EGifPutExtensionBlock(gif_.get(), 11, "NETSCAPE2.0"));
  check(EGifPutExtensionBlock(gif_.get(), sizeof repeated, repeated));
  check(EGifPutExtensionTrailer(gif_.get()));
}

GifFile::~GifFile() {
  // Closing writes the end of the file, which is thrown away unless it was finished.
  file_.cancelWriting();
}

void GifFile::check(int result) const {
  if (result == GIF_ERROR || file_.error() != QFileDevice::NoError) {
    throw std::runtime_error((file_.fileName() + ": " + file_.errorString()).toStdString());
  }
}

void GifFile::add(const QImage& picture, const Cancellation& cancellation) {
  const IndexedPicture indexed(fitted(picture, size_));
  cancellation.throw_if_canceled();
  const GraphicsControlBlock control{DISPOSE_DO_NOT, false, delay_, NO_TRANSPARENT_COLOR};
  GifByteType extension[4];
  EGifGCBToExtension(&control, extension);
  check(EGifPutExtension(gif_.get(), GRAPHICS_EXT_FUNC_CODE, sizeof extension, extension));
  check(EGifPutImageDesc(gif_.get(), 0, 0, size_.width(), size_.height(), false,
                         indexed.colors.get()));
  for (int y = 0; y < size_.height(); ++y) {
    std::vector<GifByteType> row = indexed.row(y, size_.width());
    check(EGifPutLine(gif_.get(), row.data(), size_.width()));
  }
}

void GifFile::finish() {
  int error = 0;
  const int closed = EGifCloseFile(gif_.release(), &error);
  check(closed);
  if (!file_.commit()) {
    throw std::runtime_error((file_.fileName() + ": " + file_.errorString()).toStdString());
  }
}

}  // namespace transillum::viewer
