// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Films by FFmpeg's libraries: libswscale turns pictures into the encoder's colors, libavcodec
// compresses them, libavformat writes the container through QSaveFile.
#include "film/film_file.h"

#include <QFileInfo>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "film/palette.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

namespace transillum::viewer {

namespace {

struct Format {
  const char* ending;
  AVCodecID codec;
  AVPixelFormat pixels;
  std::initializer_list<std::pair<const char*, const char*>> options;
};
// Constant quality, with lines of one pixel still sharp; fast rather than small.
const Format formats[] = {
    {"webm",
     AV_CODEC_ID_VP9,
     AV_PIX_FMT_YUV420P,
     {{"deadline", "realtime"}, {"cpu-used", "7"}, {"row-mt", "1"}, {"crf", "20"}}},
    {"mp4", AV_CODEC_ID_H264, AV_PIX_FMT_YUV420P, {{"preset", "veryfast"}, {"crf", "17"}}},
    {"gif", AV_CODEC_ID_GIF, AV_PIX_FMT_PAL8, {}}};

const Format* format_of(const QString& path) {
  const QString ending = QFileInfo(path).suffix().toLower();
  const auto* found = std::find_if(std::begin(formats), std::end(formats), [&](const Format& f) {
    return ending == QLatin1String(f.ending);
  });
  return found == std::end(formats) ? nullptr : found;
}

// FFmpeg 7 has made the bytes constant.
using BytesToWrite =
    std::conditional_t<(LIBAVFORMAT_VERSION_MAJOR >= 61), const std::uint8_t*, std::uint8_t*>;

int write_bytes(void* file, BytesToWrite bytes, int count) {
  const auto written =
      static_cast<QSaveFile*>(file)->write(reinterpret_cast<const char*>(bytes), count);
  return written == count ? count : AVERROR(EIO);
}

std::int64_t seek(void* file, std::int64_t offset, int whence) {
  auto* device = static_cast<QSaveFile*>(file);
  if (whence == AVSEEK_SIZE) {
    return device->size();
  }
  const std::int64_t from = whence == SEEK_CUR   ? device->pos()
                            : whence == SEEK_END ? device->size()
                                                 : 0;
  return device->seek(from + offset) ? device->pos() : AVERROR(EIO);
}

QImage fitted(const QImage& picture, QSize size) {
  if (picture.size() == size) {
    return picture.convertToFormat(QImage::Format_RGB32);
  }
  const QImage scaled = picture.scaled(size, Qt::KeepAspectRatio, Qt::SmoothTransformation);
  QImage whole(size, QImage::Format_RGB32);
  whole.fill(Qt::black);
  QPainter(&whole).drawImage((size.width() - scaled.width()) / 2,
                             (size.height() - scaled.height()) / 2, scaled);
  return whole;
}

}  // namespace

void FilmFile::Free::operator()(AVCodecContext* encoder) const { avcodec_free_context(&encoder); }
void FilmFile::Free::operator()(AVFormatContext* container) const {
  avformat_free_context(container);
}
void FilmFile::Free::operator()(AVFrame* frame) const { av_frame_free(&frame); }
void FilmFile::Free::operator()(AVIOContext* bytes) const {
  av_freep(&bytes->buffer);
  avio_context_free(&bytes);
}
void FilmFile::Free::operator()(AVPacket* packet) const { av_packet_free(&packet); }
void FilmFile::Free::operator()(SwsContext* converter) const { sws_freeContext(converter); }

FilmFile::FilmFile(const QString& path, QSize size, double per_second)
    : file_(path), size_(size), packet_(av_packet_alloc()) {
  av_log_set_level(AV_LOG_ERROR);  // encoders write statistics to the terminal
  if (!format_of(path)) {
    fail(QStringLiteral("the name of a film must end in .webm, .mp4 or .gif"));
  }
  if (!file_.open(QIODevice::WriteOnly)) {
    fail(file_.errorString());
  }
  open_encoder(per_second);
  open_container();
}

FilmFile::~FilmFile() { file_.cancelWriting(); }

void FilmFile::open_encoder(double per_second) {
  const Format& format = *format_of(file_.fileName());
  const AVCodec* codec = avcodec_find_encoder(format.codec);
  if (!codec) {
    fail(QStringLiteral("this system's libavcodec cannot write %1")
             .arg(QString::fromLatin1(avcodec_get_name(format.codec))));
  }
  encoder_.reset(avcodec_alloc_context3(codec));
  encoder_->width = size_.width();
  encoder_->height = size_.height();
  encoder_->pix_fmt = format.pixels;
  encoder_->framerate = av_d2q(per_second, 1000);
  encoder_->time_base = av_inv_q(encoder_->framerate);
  if (format.codec == AV_CODEC_ID_GIF) {
    encoder_->time_base = {std::max(2, static_cast<int>(std::lround(100 / per_second))), 100};
  } else {
    encoder_->colorspace = AVCOL_SPC_BT709;
    encoder_->color_primaries = AVCOL_PRI_BT709;
    encoder_->color_trc = AVCOL_TRC_BT709;
    encoder_->color_range = AVCOL_RANGE_MPEG;
    converter_.reset(sws_getContext(size_.width(), size_.height(), AV_PIX_FMT_RGB32, size_.width(),
                                    size_.height(), format.pixels, SWS_BICUBIC | SWS_ACCURATE_RND,
                                    nullptr, nullptr, nullptr));
    if (!converter_) {
      fail(QStringLiteral("%1 x %2 pixels are no size of a film")
               .arg(size_.width())
               .arg(size_.height()));
    }
    const int* matrix = sws_getCoefficients(SWS_CS_ITU709);
    sws_setColorspaceDetails(converter_.get(), matrix, 1, matrix, 0, 0, 1 << 16, 1 << 16);
  }
  encoder_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  encoder_->thread_count = 0;  // one thread per processor
  for (const auto& [name, value] : format.options) {
    // Another encoder of the same format may not have the option.
    av_opt_set(encoder_->priv_data, name, value, 0);
  }
  check(avcodec_open2(encoder_.get(), codec, nullptr));
}

void FilmFile::open_container() {
  AVFormatContext* container = nullptr;
  check(avformat_alloc_output_context2(&container, nullptr, format_of(file_.fileName())->ending,
                                       nullptr));
  container_.reset(container);
  constexpr int buffer_size = 1 << 16;
  bytes_.reset(avio_alloc_context(static_cast<unsigned char*>(av_malloc(buffer_size)), buffer_size,
                                  1, &file_, nullptr, write_bytes, seek));
  container_->pb = bytes_.get();
  AVStream* stream = avformat_new_stream(container, nullptr);
  stream->time_base = encoder_->time_base;
  stream->avg_frame_rate = encoder_->framerate;
  check(avcodec_parameters_from_context(stream->codecpar, encoder_.get()));
  check(avformat_write_header(container, nullptr));
  frame_.reset(av_frame_alloc());
  frame_->format = encoder_->pix_fmt;
  frame_->width = size_.width();
  frame_->height = size_.height();
  frame_->color_range = encoder_->color_range;
  frame_->colorspace = encoder_->colorspace;
  check(av_frame_get_buffer(frame_.get(), 0));
}

void FilmFile::fill_frame(const QImage& picture) {
  check(av_frame_make_writable(frame_.get()));
  const QImage rgb = fitted(picture, size_);
  if (converter_) {
    const std::uint8_t* rows[] = {rgb.constBits()};
    const int stride[] = {static_cast<int>(rgb.bytesPerLine())};
    sws_scale(converter_.get(), rows, stride, 0, size_.height(), frame_->data, frame_->linesize);
    return;
  }
  const QImage indexed = with_palette(rgb);
  for (int y = 0; y < size_.height(); ++y) {
    std::memcpy(frame_->data[0] + static_cast<std::ptrdiff_t>(y) * frame_->linesize[0],
                indexed.constScanLine(y), static_cast<std::size_t>(size_.width()));
  }
  const QVector<QRgb> colors = indexed.colorTable();
  std::memcpy(frame_->data[1], colors.constData(), sizeof(QRgb) * colors.size());
}

void FilmFile::add(const QImage& picture, const Cancellation& cancellation) {
  cancellation.throw_if_canceled();
  fill_frame(picture);
  cancellation.throw_if_canceled();
  frame_->pts = pictures_++;
  encode(frame_.get());
}

// Compresses a picture, or without one, all that the encoder still holds.
void FilmFile::encode(const AVFrame* frame) {
  check(avcodec_send_frame(encoder_.get(), frame));
  while (true) {
    const int received = avcodec_receive_packet(encoder_.get(), packet_.get());
    if (received == AVERROR(EAGAIN) || received == AVERROR_EOF) {
      return;
    }
    check(received);
    packet_->duration = 1;
    av_packet_rescale_ts(packet_.get(), encoder_->time_base, container_->streams[0]->time_base);
    check(av_interleaved_write_frame(container_.get(), packet_.get()));
  }
}

void FilmFile::finish() {
  encode(nullptr);
  check(av_write_trailer(container_.get()));
  avio_flush(bytes_.get());
  check(bytes_->error);
  if (!file_.commit()) {
    fail(file_.errorString());
  }
}

int FilmFile::check(int result) const {
  if (result < 0) {
    if (file_.error() != QFileDevice::NoError) {
      fail(file_.errorString());
    }
    char reason[AV_ERROR_MAX_STRING_SIZE] = {};
    av_strerror(result, reason, sizeof reason);
    fail(QString::fromLocal8Bit(reason));
  }
  return result;
}

void FilmFile::fail(const QString& reason) const {
  throw std::runtime_error((file_.fileName() + ": " + reason).toStdString());
}

}  // namespace transillum::viewer
