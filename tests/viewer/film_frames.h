// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QImage>
#include <QString>
#include <cmath>
#include <memory>
#include <vector>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

namespace transillum::viewer::test {

/// A film as it is decoded.
struct DecodedFilm {
  std::vector<QImage> frames;
  double per_second = 0;
};

/// Decodes all pictures of a film; none where it cannot be read.
inline DecodedFilm decoded_film(const QString& path) {
  DecodedFilm film;
  AVFormatContext* container = nullptr;
  if (avformat_open_input(&container, path.toLocal8Bit(), nullptr, nullptr) < 0) {
    return film;
  }
  avformat_find_stream_info(container, nullptr);
  const AVStream& stream = *container->streams[0];
  film.per_second = av_q2d(stream.avg_frame_rate);
  AVCodecContext* decoder = avcodec_alloc_context3(avcodec_find_decoder(stream.codecpar->codec_id));
  avcodec_parameters_to_context(decoder, stream.codecpar);
  avcodec_open2(decoder, nullptr, nullptr);
  AVPacket* packet = av_packet_alloc();
  AVFrame* frame = av_frame_alloc();
  for (bool more = true; more;) {
    more = av_read_frame(container, packet) >= 0;
    avcodec_send_packet(decoder, more ? packet : nullptr);
    av_packet_unref(packet);
    while (avcodec_receive_frame(decoder, frame) >= 0) {
      QImage image(frame->width, frame->height, QImage::Format_RGB32);
      SwsContext* converter =
          sws_getContext(frame->width, frame->height, static_cast<AVPixelFormat>(frame->format),
                         frame->width, frame->height, AV_PIX_FMT_RGB32,
                         SWS_BICUBIC | SWS_ACCURATE_RND, nullptr, nullptr, nullptr);
      const int* matrix = sws_getCoefficients(SWS_CS_ITU709);
      sws_setColorspaceDetails(converter, matrix, 0, matrix, 1, 0, 1 << 16, 1 << 16);
      std::uint8_t* rows[] = {image.bits()};
      const int stride[] = {static_cast<int>(image.bytesPerLine())};
      sws_scale(converter, frame->data, frame->linesize, 0, frame->height, rows, stride);
      sws_freeContext(converter);
      film.frames.push_back(image);
    }
  }
  av_frame_free(&frame);
  av_packet_free(&packet);
  avcodec_free_context(&decoder);
  avformat_close_input(&container);
  return film;
}

/// The mean difference of two pictures of the same size, levels of 255; infinite otherwise.
inline double mean_difference(const QImage& a, const QImage& b) {
  if (a.isNull() || a.size() != b.size()) {
    return HUGE_VAL;
  }
  double sum = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
      sum += std::abs(qRed(p) - qRed(q)) + std::abs(qGreen(p) - qGreen(q)) +
             std::abs(qBlue(p) - qBlue(q));
    }
  }
  return sum / 3 / a.width() / a.height();
}

}  // namespace transillum::viewer::test
