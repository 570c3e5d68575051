// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QImage>
#include <QSaveFile>
#include <QSize>
#include <QString>
#include <memory>

#include "transillum/cancellation.h"

struct GifFileType;

namespace transillum::viewer {

/// An animated GIF that is repeated without end, written picture by picture, whole or not at all:
/// it is missing until finish().
///
/// Threads: any, one at a time.
class GifFile {
 public:
  /// @param path  an existing file is replaced by finish()
  /// @param size  of all pictures, pixels, each at most 65535
  /// @param delay_ms  between two pictures; stored in hundredths of a second, at least two
  /// @throws std::runtime_error
  GifFile(const QString& path, QSize size, int delay_ms);
  ~GifFile();
  GifFile(const GifFile&) = delete;
  GifFile& operator=(const GifFile&) = delete;

  /// Adds a picture, in the 256 colors that fit it best. One of another size is scaled, on black.
  /// @throws std::runtime_error, Canceled
  void add(const QImage& picture, const Cancellation& cancellation = {});
  /// @throws std::runtime_error
  void finish();

 private:
  struct Close {
    void operator()(GifFileType* gif) const;
  };
  void check(int result) const;

  QSaveFile file_;
  const QSize size_;
  const int delay_;  ///< hundredths of a second
  std::unique_ptr<GifFileType, Close> gif_;
};

}  // namespace transillum::viewer
