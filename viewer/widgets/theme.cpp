// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "widgets/theme.h"

#include <QApplication>
#include <QFontInfo>
#include <QIconEngine>
#include <QPainter>
#include <QPainterPath>
#include <QPalette>
#include <QProxyStyle>
#include <QScreen>
#include <QWidget>
#include <algorithm>
#include <atomic>
#include <cmath>

namespace transillum::viewer::theme {

namespace {

constexpr int type_size = 13;  // pixels
constexpr int tool_size = 20;  // of an icon

// How large type is on the wall depends on its share of the screen.
double projector_scale() {
  constexpr double of_full_hd = 1.4, least = 1.2, most = 2;
  const QWidget* window = QApplication::activeWindow();
  const QScreen* screen = window ? window->screen() : QGuiApplication::primaryScreen();
  const double share = std::min(screen->size().width() / 1920.0, screen->size().height() / 1080.0);
  return std::clamp(of_full_hd * share, least, most);
}

/// What is drawn beside type grows with it.
class ScaledStyle : public QProxyStyle {
 public:
  ScaledStyle() : QProxyStyle(QStringLiteral("Fusion")) {}

  int pixelMetric(PixelMetric metric, const QStyleOption* option,
                  const QWidget* widget) const override {
    switch (metric) {
      case PM_ToolBarIconSize:
        return scaled(tool_size);
      case PM_ButtonIconSize:
        return scaled(18);
      case PM_IndicatorWidth:
      case PM_IndicatorHeight:
      case PM_ExclusiveIndicatorWidth:
      case PM_ExclusiveIndicatorHeight:
        return scaled(QProxyStyle::pixelMetric(metric, option, widget));
      default:
        return QProxyStyle::pixelMetric(metric, option, widget);
    }
  }
};

Appearance current;
std::atomic<double> line_scale = 1;
QColor faded;  // what cannot be used now

QPolygonF triangle(double left, double right) {
  return {{QPointF(left, 5), QPointF(right, 12), QPointF(left, 19)}};
}

void draw_chevron(QPainter& painter, double x) {
  painter.drawPolyline(QPolygonF({{x, 6}, {x + 6, 12}, {x, 18}}));
}

Icon mirrored(Icon which) {
  switch (which) {
    case Icon::step_back:
      return Icon::step_on;
    case Icon::previous_event:
      return Icon::next_event;
    case Icon::previous_exchange:
      return Icon::next_exchange;
    case Icon::previous_direction:
      return Icon::next_direction;
    default:
      return which;
  }
}

// On a square of 24 by 24.
void draw(QPainter& painter, Icon which, const QColor& color) {
  const QPen line(color, 2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin);
  painter.setPen(Qt::NoPen);
  painter.setBrush(color);
  switch (which) {
    case Icon::open: {
      painter.setPen(line);
      painter.setBrush(Qt::NoBrush);
      painter.drawPolyline(QPolygonF({{3, 18}, {3, 6}, {9, 6}, {11, 8.5}, {19, 8.5}, {19, 11}}));
      painter.drawPolygon(QPolygonF({{3, 18.5}, {6.5, 11.5}, {22, 11.5}, {18.5, 18.5}}));
      break;
    }
    case Icon::run:
      painter.drawPolygon(triangle(7, 19));
      break;
    case Icon::pause:
      painter.drawRoundedRect(QRectF(6, 5, 4.2, 14), 1, 1);
      painter.drawRoundedRect(QRectF(13.8, 5, 4.2, 14), 1, 1);
      break;
    case Icon::one_direction:
      painter.drawPolygon(triangle(5, 15));
      painter.drawRoundedRect(QRectF(16.5, 5, 3, 14), 1, 1);
      break;
    case Icon::one_iteration:
      painter.drawPolygon(triangle(2, 9.5));
      painter.drawPolygon(triangle(10, 17.5));
      painter.drawRoundedRect(QRectF(18.7, 5, 3, 14), 1, 1);
      break;
    case Icon::stop:
      painter.drawRoundedRect(QRectF(6, 6, 12, 12), 1.5, 1.5);
      break;
    case Icon::frame:
      painter.setPen(line);
      for (int corner = 0; corner < 4; ++corner) {
        painter.drawLine(QPointF(4, 9), QPointF(4, 4));
        painter.drawLine(QPointF(4, 4), QPointF(9, 4));
        painter.translate(12, 12);
        painter.rotate(90);
        painter.translate(-12, -12);
      }
      painter.setPen(Qt::NoPen);
      painter.drawEllipse(QPointF(12, 12), 2.6, 2.6);
      break;
    case Icon::warning:
    case Icon::error:
      painter.drawEllipse(QPointF(12, 12), 10, 10);
      painter.setPen(QPen(Qt::white, 2.6, Qt::SolidLine, Qt::RoundCap));
      painter.drawLine(QPointF(12, 6.8), QPointF(12, 12.6));
      painter.drawPoint(QPointF(12, 17));
      break;
    case Icon::close:
      painter.setPen(line);
      painter.drawLine(QPointF(7, 7), QPointF(17, 17));
      painter.drawLine(QPointF(17, 7), QPointF(7, 17));
      break;
    case Icon::scene: {
      painter.setPen(QPen(color, 1.6, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
      painter.setBrush(Qt::NoBrush);
      painter.drawPolygon(
          QPolygonF({{12, 3}, {20, 7.5}, {20, 16.5}, {12, 21}, {4, 16.5}, {4, 7.5}}));
      painter.drawPolyline(QPolygonF({{4, 7.5}, {12, 12}, {20, 7.5}}));
      painter.drawLine(QPointF(12, 12), QPointF(12, 21));
      break;
    }
    case Icon::step_on:
      painter.setPen(line);
      painter.setBrush(Qt::NoBrush);
      draw_chevron(painter, 9);
      break;
    case Icon::phase_on:
      painter.drawEllipse(QPointF(5, 12), 2, 2);
      painter.drawEllipse(QPointF(12, 12), 2, 2);
      painter.drawEllipse(QPointF(19, 12), 2, 2);
      break;
    case Icon::next_event:
      painter.setBrush(selection);
      painter.drawEllipse(QPointF(6, 12), 3.6, 3.6);
      painter.setPen(line);
      painter.setBrush(Qt::NoBrush);
      draw_chevron(painter, 14);
      break;
    case Icon::next_exchange:
      painter.setPen(line);
      painter.drawLine(QPointF(6, 5), QPointF(6, 19));
      painter.drawPolyline(QPolygonF({{2.5, 8.5}, {6, 5}, {9.5, 8.5}}));
      painter.setBrush(Qt::NoBrush);
      draw_chevron(painter, 14);
      break;
    case Icon::next_direction:
      painter.setPen(line);
      painter.setBrush(Qt::NoBrush);
      draw_chevron(painter, 7);
      painter.drawLine(QPointF(17.5, 6), QPointF(17.5, 18));
      break;
    case Icon::newest:
      painter.drawPolygon(triangle(3, 11));
      painter.drawPolygon(triangle(11, 19));
      painter.drawRoundedRect(QRectF(19, 5, 2.6, 14), 1, 1);
      break;
    case Icon::study:
      painter.setPen(line);
      painter.setBrush(Qt::NoBrush);
      painter.drawPolyline(QPolygonF({{4, 4}, {4, 20}, {20, 20}}));
      painter.drawPolyline(QPolygonF({{8, 6}, {12, 9.5}, {16, 14.5}, {20, 16}}));
      break;
    case Icon::step_back:
    case Icon::previous_event:
    case Icon::previous_exchange:
    case Icon::previous_direction:
      painter.translate(24, 0);
      painter.scale(-1, 1);
      draw(painter, mirrored(which), color);
      break;
  }
}

QColor color_of(Icon which) {
  switch (which) {
    case Icon::run:
      return good;
    case Icon::stop:
    case Icon::error:
      return current.dark ? QColor(0xe0, 0x5a, 0x5a) : QColor(0xb9, 0x2d, 0x2d);
    case Icon::warning:
      return {0xb3, 0x6b, 0x00};
    default:
      return ink;
  }
}

class DrawnIcon : public QIconEngine {
 public:
  explicit DrawnIcon(Icon which) : which_(which) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State) override {
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    const int size = std::min(rect.width(), rect.height());
    painter->translate(QRectF(rect).center() - QPointF(size, size) / 2);
    painter->scale(size / 24.0, size / 24.0);
    draw(*painter, which_, mode == QIcon::Disabled ? faded : color_of(which_));
    painter->restore();
  }
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    QPixmap picture(size);
    picture.fill(Qt::transparent);
    QPainter painter(&picture);
    paint(&painter, QRect(QPoint(), size), mode, state);
    return picture;
  }
  QIconEngine* clone() const override { return new DrawnIcon(which_); }

 private:
  Icon which_;
};

void set_colors(const Appearance& appearance) {
  if (appearance.dark) {
    window = {0x23, 0x27, 0x2e};
    paper = {0x1a, 0x1d, 0x22};
    ink = {0xe8, 0xeb, 0xef};
    ink_dim = {0xa4, 0xad, 0xb8};
    rule = {0x41, 0x48, 0x52};
    accent = {0x6a, 0xa8, 0xf0};
    warm = {0xff, 0x9a, 0x45};
    good = {0x52, 0xc4, 0x86};
    hover = {0x36, 0x3d, 0x47};
    title = {0x2d, 0x32, 0x3a};
    faded = {0x7a, 0x82, 0x8d};
  } else {
    window = {0xf4, 0xf5, 0xf7};
    paper = {0xff, 0xff, 0xff};
    ink = {0x1b, 0x21, 0x2a};
    ink_dim = {0x5a, 0x64, 0x72};
    rule = {0xd3, 0xd8, 0xde};
    accent = {0x1f, 0x66, 0xc2};
    warm = {0xd9, 0x5f, 0x02};
    good = {0x1a, 0x7f, 0x4b};
    hover = {0xe3, 0xe8, 0xef};
    title = {0xe6, 0xe9, 0xee};
    faded = {0xb4, 0xba, 0xc2};
  }
  if (!appearance.projector) {
    return;
  }
  // A projector in a lit room makes grays one.
  ink = appearance.dark ? QColor(Qt::white) : QColor(Qt::black);
  ink_dim = appearance.dark ? QColor(0xd0, 0xd6, 0xdd) : QColor(0x33, 0x3b, 0x46);
  rule = appearance.dark ? rule.lighter(130) : rule.darker(125);
}

QPalette make_palette() {
  QPalette palette;
  palette.setColor(QPalette::Window, window);
  palette.setColor(QPalette::WindowText, ink);
  palette.setColor(QPalette::Base, paper);
  palette.setColor(QPalette::AlternateBase, window);
  palette.setColor(QPalette::Text, ink);
  palette.setColor(QPalette::PlaceholderText, ink_dim);
  palette.setColor(QPalette::Button, current.dark ? hover : QColor(0xfb, 0xfb, 0xfc));
  palette.setColor(QPalette::ButtonText, ink);
  palette.setColor(QPalette::BrightText, ink);
  palette.setColor(QPalette::ToolTipBase, paper);
  palette.setColor(QPalette::ToolTipText, ink);
  palette.setColor(QPalette::Highlight, accent);
  palette.setColor(QPalette::HighlightedText, current.dark ? paper : QColor(Qt::white));
  palette.setColor(QPalette::Link, accent);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    palette.setColor(QPalette::Disabled, role, faded.darker(current.dark ? 90 : 118));
  }
  return palette;
}

QString style_sheet() {
  return QStringLiteral(R"(
    QToolBar { border: none; border-bottom: 1px solid %1; padding: 3px 6px; spacing: 4px; }
    QToolBar QToolButton { padding: 4px 9px 4px 6px; border-radius: 4px; }
    QToolBar QToolButton:hover:enabled { background: %2; }
    QToolBar QToolButton:pressed { background: %1; }
    QStatusBar { border-top: 1px solid %1; }
    QStatusBar::item { border: none; }
    QDockWidget { font-weight: bold; }
    QDockWidget::title { background: %3; padding: 6px 8px; }
    QDockWidget::close-button, QDockWidget::float-button { subcontrol-position: right center;
      subcontrol-origin: padding; position: absolute; width: 16px; height: 16px; padding: 0;
      border: none; background: transparent; icon-size: 12px; }
    QDockWidget::close-button { right: 8px; }
    QDockWidget::float-button { right: 30px; }
    QDockWidget::close-button:hover, QDockWidget::float-button:hover { background: %1; }
    QMainWindow::separator { background: %1; width: 4px; height: 4px; }
    QMainWindow::separator:hover { background: %4; }
    QToolTip { border: 1px solid %1; padding: 4px; }
  )")
      .arg(rule.name(), hover.name(), title.name(), accent.name());
}

}  // namespace

QIcon icon(Icon which) { return QIcon(new DrawnIcon(which)); }

double scale() { return line_scale.load(std::memory_order_relaxed); }

int scaled(int pixels) { return static_cast<int>(std::lround(pixels * scale())); }

const Appearance& appearance() { return current; }

void apply(QApplication& application, const Appearance& wished) {
  current = wished;
  line_scale = wished.projector ? projector_scale() : 1;
  set_colors(wished);
  application.setStyle(new ScaledStyle);
  application.setPalette(make_palette());
  QFont font = application.font();
  const QFont wished_font(QStringLiteral("DejaVu Sans"));
  if (QFontInfo(wished_font).family() == wished_font.family()) {
    font.setFamily(wished_font.family());
  }
  font.setPixelSize(scaled(type_size));
  application.setFont(font);
  application.setStyleSheet(style_sheet());
}

}  // namespace transillum::viewer::theme
