// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/chart_picture.h"

#include <QFontInfo>
#include <QWidget>

#include "widgets/theme.h"

namespace transillum::viewer {

ChartColor chart_color(const QColor& color) {
  const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
  return {byte(color.red()), byte(color.green()), byte(color.blue())};
}

ChartStyle chart_style(const QWidget& widget) {
  const QFontInfo font(widget.font());
  ChartStyle style;
  style.paper = chart_color(theme::paper);
  style.ink = chart_color(theme::ink);
  style.dim = chart_color(theme::ink_dim);
  style.grid = chart_color(theme::rule);
  style.font = font.family().toStdString();
  style.title_size = style.text_size = style.label_size = font.pixelSize();
  style.bold_title = true;
  style.margin = 8;
  style.line_width = 1;
  style.framed = true;
  return style;
}

ChartArea paint_chart(const LineChart& chart, QImage& picture, const QSize& pixels, double scale) {
  picture = QImage(pixels, QImage::Format_RGB32);
  if (picture.isNull()) {
    return {};
  }
  return transillum::paint_chart(chart,
                                 {reinterpret_cast<std::uint32_t*>(picture.bits()), pixels.width(),
                                  pixels.height(), picture.bytesPerLine() / 4},
                                 scale);
}

}  // namespace transillum::viewer
