// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Figures. One function draws the layout, in units of 1/96 inch for text of 10 points; the formats
// differ in the device that it draws on.
#include "window/files/figure.h"
#include "window/files/whole_file.h"

#include <fmt/format.h>

#include <QBuffer>
#include <QFileInfo>
#include <QFontMetricsF>
#include <QPainter>
#include <QPdfWriter>
#include <QSvgGenerator>
#include <algorithm>
#include <cmath>
#include <span>

#include "colors/color_bar.h"
#include "map/map_canvas.h"
#include "map/map_view.h"
#include "scene/scene_view.h"
#include "solve/convergence_view.h"
#include "transillum/errors.h"
#include "widgets/log_chart.h"

namespace transillum::viewer {

namespace {

constexpr int least_side = 16, largest_side = 16384;  ///< pixels
constexpr double units_per_inch = 96, pixels_per_inch = 300;
constexpr double usual_points = 10, font_pixels = 13, title_pixels = 17;
constexpr double margin = 12, gap = 12, bar_width = 128;

/// The places of a figure, in its units.
struct FigurePlaces {
  double unit = 1;  ///< pixels
  QSizeF size;
  QRectF title, scene, bar, map, chart;

  FigurePlaces(const FigurePlan& plan, bool has_bar) {
    unit =
        plan.text_points / usual_points * (plan.centimeters ? pixels_per_inch / units_per_inch : 1);
    size = QSizeF(plan.pixels()) / unit;
    QRectF room(margin, margin, size.width() - 2 * margin, size.height() - 2 * margin);
    if (!plan.title.isEmpty()) {
      title = QRectF(room.left(), room.top(), room.width(), 1.4 * title_pixels);
      room.setTop(title.bottom() + gap);
    }
    const bool with_bar = plan.scene && has_bar;
    const int count = plan.scene + plan.map + plan.chart;
    const double width =
        (room.width() - (count - 1) * gap - (with_bar ? bar_width : 0)) / std::max(count, 1);
    const auto take = [&](double wide) {
      const QRectF box(room.left(), room.top(), wide, room.height());
      room.setLeft(box.right() + gap);
      return box;
    };
    if (plan.scene) {
      scene = take(width);
    }
    if (with_bar) {
      room.setLeft(scene.right());
      bar = take(bar_width);
    }
    if (plan.map) {
      map = take(width);
    }
    if (plan.chart) {
      chart = take(width);
    }
  }
  QSize pixels(const QRectF& box) const {
    return {std::max(1, qRound(unit * box.width())), std::max(1, qRound(unit * box.height()))};
  }
};

bool has_bar(const FigurePlan& plan, const ColorChoice& colors) {
  return plan.explained && ColorBarSheet::applies(colors);
}

/// Draws charts as vectors, with text as text.
class PainterDevice : public ChartDevice {
 public:
  /// @param font  its family and style
  PainterDevice(QPainter& painter, const QFont& font) : painter_(painter), font_(font) {}

  void fill(std::span<const ChartPoint> corners, const ChartColor& color) override {
    painter_.setPen(Qt::NoPen);
    painter_.setBrush(color_of(color));
    painter_.drawPolygon(polygon_of(corners));
  }
  void stroke(std::span<const ChartPoint> points, bool closed, const ChartColor& color,
              double width, std::span<const double> dashes) override {
    QPen pen(color_of(color), width, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin);
    QVector<qreal> pattern;
    for (const double length : dashes) {
      pattern << length / width;  // Qt's unit
    }
    if (!pattern.isEmpty()) {
      pen.setDashPattern(pattern);
    }
    painter_.setPen(pen);
    painter_.setBrush(Qt::NoBrush);
    closed ? painter_.drawPolygon(polygon_of(points)) : painter_.drawPolyline(polygon_of(points));
  }
  void text(const std::string& text, const ChartPoint& at, double align, const ChartText& look,
            bool upward) override {
    font_.setPixelSize(qRound(look.size));
    font_.setBold(look.bold);
    const QFontMetricsF metrics(font_);
    const QString line = QString::fromStdString(text);
    painter_.save();
    painter_.setFont(font_);
    painter_.setPen(color_of(look.color));
    painter_.translate(at.x, at.y);
    painter_.rotate(upward ? -90 : 0);
    painter_.drawText(QPointF(-align * metrics.horizontalAdvance(line),
                              (metrics.ascent() - metrics.descent()) / 2),
                      line);
    painter_.restore();
  }
  void clip(const ChartArea& area) override {
    painter_.save();
    painter_.setClipRect(QRectF(QPointF(area.left, area.top), QPointF(area.right, area.bottom)));
  }
  void clip_nothing() override { painter_.restore(); }

 private:
  static QColor color_of(const ChartColor& color) { return {color.red, color.green, color.blue}; }
  static QPolygonF polygon_of(std::span<const ChartPoint> points) {
    QPolygonF polygon;
    for (const ChartPoint& point : points) {
      polygon << QPointF(point.x, point.y);
    }
    return polygon;
  }

  QPainter& painter_;
  QFont font_;
};

/// Draws a figure in units of its layout.
class FigurePainting {
 public:
  FigurePainting(QPainter& painter, const FigurePlan& plan, const FigureViews& views)
      : painter_(painter),
        plan_(plan),
        views_(views),
        layout_(plan, has_bar(plan, views.colors)),
        is_dark_(plan.background == FigurePlan::Background::dark) {
    font_.setPixelSize(static_cast<int>(font_pixels));
    ink_ = is_dark_ ? theme::on_dark : QColor(26, 26, 31);
    paper_ = is_dark_ ? theme::scene_background : QColor(Qt::white);
    if (plan.background == FigurePlan::Background::transparent) {
      paper_.setAlpha(0);
    }
  }

  void paint(const QImage& sharp) {
    painter_.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
    if (paper_.alpha() > 0) {
      painter_.fillRect(QRectF(QPointF(0, 0), layout_.size), paper_);
    }
    paint_title();
    if (plan_.scene) {
      const SceneView::SceneLook look{layout_.pixels(layout_.scene), paper_, layout_.unit,
                                      plan_.direction, sharp};
      painter_.drawImage(layout_.scene, views_.scene.picture(look));
    }
    if (!layout_.bar.isNull()) {
      at(layout_.bar, [&] {
        const QColor dim = is_dark_ ? theme::on_dark_dim : QColor(90, 94, 102);
        ColorBarSheet{views_.colors, layout_.bar.size(), font_, ink_, dim}.draw(painter_);
      });
    }
    if (plan_.map) {
      at(layout_.map,
         [&] { views_.map.draw(painter_, layout_.map.size(), ink_, plan_.explained); });
    }
    if (plan_.chart) {
      paint_charts();
    }
  }

 private:
  template <class Draw>
  void at(const QRectF& box, Draw draw) {
    painter_.save();
    painter_.translate(box.topLeft());
    painter_.setFont(font_);
    draw();
    painter_.restore();
  }

  void paint_title() {
    if (plan_.title.isEmpty()) {
      return;
    }
    QFont font = font_;
    font.setBold(true);
    font.setPixelSize(static_cast<int>(title_pixels));
    painter_.setFont(font);
    painter_.setPen(ink_);
    painter_.drawText(
        layout_.title, Qt::AlignHCenter | Qt::AlignVCenter,
        QFontMetricsF(font).elidedText(plan_.title, Qt::ElideRight, layout_.title.width()));
  }

  void paint_charts() {
    std::vector<LineChart> charts = views_.charts.charts();
    QRectF box = layout_.chart;
    box.setHeight(box.height() / static_cast<double>(charts.size()));
    for (LineChart& chart : charts) {
      ChartStyle& style = chart.style;
      style.ink = chart_color(ink_);
      style.dim = chart_color(ink_);
      style.paper = chart_color(paper_);
      style.grid = is_dark_ ? ChartColor{60, 66, 74} : ChartColor{219, 222, 227};
      style.font = font_.family().toStdString();
      at(box, [&] {
        PainterDevice device(painter_, font_);
        draw_chart(chart, box.width(), box.height(), device);
      });
      box.translate(0, box.height());
    }
  }

  QPainter& painter_;
  const FigurePlan& plan_;
  const FigureViews& views_;
  const FigurePlaces layout_;
  const bool is_dark_;
  QFont font_;
  QColor ink_, paper_;
};

void paint(QPaintDevice& device, double scale, const FigurePlan& plan, const FigureViews& views,
           const QImage& sharp) {
  QPainter painter(&device);
  painter.scale(scale, scale);
  FigurePainting(painter, plan, views).paint(sharp);
}

QByteArray figure_bytes(const QString& ending, const FigurePlan& plan, const FigureViews& views,
                        const QImage& sharp) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  const FigurePlaces layout(plan, has_bar(plan, views.colors));
  const QSize pixels = plan.pixels();
  if (ending == QLatin1String("png")) {
    const bool transparent = plan.background == FigurePlan::Background::transparent;
    QImage image(pixels, transparent ? QImage::Format_ARGB32 : QImage::Format_RGB32);
    image.fill(transparent ? Qt::transparent : Qt::white);
    paint(image, layout.unit, plan, views, sharp);
    const double inches = plan.centimeters ? pixels_per_inch : units_per_inch;
    image.setDotsPerMeterX(qRound(inches / 0.0254));
    image.setDotsPerMeterY(image.dotsPerMeterX());
    image.save(&buffer, "PNG");
  } else if (ending == QLatin1String("svg")) {
    QSvgGenerator svg;
    svg.setOutputDevice(&buffer);
    svg.setResolution(static_cast<int>(plan.centimeters ? pixels_per_inch : units_per_inch));
    svg.setSize(pixels);
    svg.setViewBox(QRect(QPoint(0, 0), pixels));
    svg.setTitle(plan.title.toHtmlEscaped());  // Qt writes it as it is
    paint(svg, layout.unit, plan, views, sharp);
  } else {
    QPdfWriter pdf(&buffer);
    const double inches = plan.centimeters ? pixels_per_inch : units_per_inch;
    pdf.setPageSize(QPageSize(QSizeF(pixels) / inches, QPageSize::Inch, {}, QPageSize::ExactMatch));
    pdf.setPageMargins({});
    pdf.setResolution(static_cast<int>(pixels_per_inch));
    pdf.setTitle(plan.title);
    paint(pdf, layout.unit * pixels_per_inch / inches, plan, views, sharp);
  }
  return bytes;
}

}  // namespace

QSize FigurePlan::pixels() const {
  const QSizeF exact = centimeters ? size / 2.54 * pixels_per_inch : size;
  // Sizes out of range are reported by validate().
  const auto side = [](double pixels) {
    return static_cast<int>(std::lround(std::clamp(pixels, 0.0, 1e6)));
  };
  return {side(exact.width()), side(exact.height())};
}

QSize FigurePlan::scene_pixels(bool has_bar) const {
  const FigurePlaces layout(*this, explained && has_bar);
  return layout.pixels(layout.scene);
}

void FigurePlan::validate() const {
  const QSize sides = pixels();
  if (std::min(sides.width(), sides.height()) < least_side ||
      std::max(sides.width(), sides.height()) > largest_side) {
    throw InputError(fmt::format("a figure of {} x {} pixels: each side must have {} to {}",
                                 sides.width(), sides.height(), least_side, largest_side));
  }
  if (!scene && !map && !chart) {
    throw InputError("a figure shows the scene, the map or the charts: none is chosen");
  }
}

void write_figure(const QString& path, const FigurePlan& plan, const FigureViews& views,
                  const QImage& sharp) {
  plan.validate();
  const QString ending = QFileInfo(path).suffix().toLower();
  if (!QStringList{"png", "svg", "pdf"}.contains(ending)) {
    throw InputError(path.toStdString() + ": the name of a figure must end in .png, .svg or .pdf");
  }
  write_whole(path, figure_bytes(ending, plan, views, sharp));
}

}  // namespace transillum::viewer
