// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QImage>
#include <QSaveFile>
#include <QSize>
#include <QString>
#include <cstdint>
#include <memory>

#include "transillum/cancellation.h"

struct AVCodecContext;
struct AVFormatContext;
struct AVFrame;
struct AVIOContext;
struct AVPacket;
struct SwsContext;

namespace transillum::viewer {

/// A film, written picture by picture, whole or not at all: the file is missing until finish().
/// The ending of its name gives the format: WebM with VP9, MP4 with H.264, or a GIF that is
/// repeated without end.
///
/// Threads: any, one at a time.
class FilmFile {
 public:
  /// @param path  ends in .webm, .mp4 or .gif; an existing file is replaced by finish()
  /// @param size  of all pictures, pixels; see even()
  /// @param per_second  pictures, above 0; a GIF stores the time between two in hundredths of a
  /// second, at least two
  /// @throws std::runtime_error
  FilmFile(const QString& path, QSize size, double per_second);
  ~FilmFile();
  FilmFile(const FilmFile&) = delete;
  FilmFile& operator=(const FilmFile&) = delete;

  /// The largest size within `size` that all formats can store: its numbers are even.
  static QSize even(QSize size) { return {size.width() & ~1, size.height() & ~1}; }

  /// Adds a picture. One of another size is scaled, on black.
  /// @throws std::runtime_error, Canceled
  void add(const QImage& picture, const Cancellation& cancellation = {});
  /// @throws std::runtime_error
  void finish();

 private:
  struct Free {
    void operator()(AVCodecContext* encoder) const;
    void operator()(AVFormatContext* container) const;
    void operator()(AVFrame* frame) const;
    void operator()(AVIOContext* bytes) const;
    void operator()(AVPacket* packet) const;
    void operator()(SwsContext* converter) const;
  };
  template <class Type>
  using Owned = std::unique_ptr<Type, Free>;

  void open_encoder(double per_second);
  void open_container();
  void fill_frame(const QImage& picture);
  void encode(const AVFrame* frame);
  /// @returns `result`, which is no error
  int check(int result) const;
  [[noreturn]] void fail(const QString& reason) const;

  QSaveFile file_;
  const QSize size_;
  Owned<AVIOContext> bytes_;
  Owned<AVFormatContext> container_;
  Owned<AVCodecContext> encoder_;
  Owned<SwsContext> converter_;  ///< null for GIF
  Owned<AVFrame> frame_;
  Owned<AVPacket> packet_;
  std::int64_t pictures_ = 0;
};

}  // namespace transillum::viewer
