// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Colors, fonts, style sheet and icons of the application. The icons are the SVG files of icons/,
// compiled in as resources.
#include "widgets/theme.h"

#include <QApplication>
#include <QFile>
#include <QFontInfo>
#include <QIconEngine>
#include <QPainter>
#include <QPalette>
#include <QProxyStyle>
#include <QScreen>
#include <QStyleOption>
#include <QSvgRenderer>
#include <QToolButton>
#include <QWidget>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>

#include "transillum/at.h"

// Q_INIT_RESOURCE must not be in a namespace; a static library's resources need it.
static void find_resources() { Q_INIT_RESOURCE(icons); }

namespace transillum::viewer::theme {

namespace {

constexpr int type_size = 13;  // pixels
constexpr int tool_icon_size = 20;

// The size of the projected text depends on its fraction of the screen.
double projector_scale() {
  constexpr double of_full_hd = 1.4, least = 1.2, most = 2;
  const QWidget* window = QApplication::activeWindow();
  const QScreen* screen = window ? window->screen() : QGuiApplication::primaryScreen();
  const double fraction =
      std::min(screen->size().width() / 1920.0, screen->size().height() / 1080.0);
  return std::clamp(of_full_hd * fraction, least, most);
}

Appearance current;
std::atomic<double> line_scale = 1;
QColor disabled_ink;

QColor mixed(const QColor& a, const QColor& b, double fraction_of_b) {
  const auto mix = [fraction_of_b](int x, int y) {
    return static_cast<int>(std::lround((1 - fraction_of_b) * x + fraction_of_b * y));
  };
  return {mix(a.red(), b.red()), mix(a.green(), b.green()), mix(a.blue(), b.blue())};
}

/// Fills a checked box: Fusion's marks can hardly be seen in dark panels.
void draw_check_box(QPainter& painter, const QRect& rect, QStyle::State state) {
  const bool enabled = state & QStyle::State_Enabled;
  const QColor edge = enabled ? ink_dim : disabled_ink;
  const QColor fill = enabled ? accent : disabled_ink;
  const double size = std::min(rect.width(), rect.height());
  QRectF box(0, 0, size - 1, size - 1);
  box.moveCenter(QRectF(rect).center());
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const bool marked = state & (QStyle::State_On | QStyle::State_NoChange);
  painter.setPen(QPen(marked ? fill : edge, std::max(1.0, size / 13)));
  painter.setBrush(marked ? fill : paper);
  painter.drawRoundedRect(box, size / 6, size / 6);
  if (marked) {
    painter.setPen(QPen(paper, size / 7, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    const auto at = [&](double x, double y) {
      return QPointF(box.left() + x * box.width(), box.top() + y * box.height());
    };
    if (state & QStyle::State_On) {
      painter.drawPolyline(QPolygonF({at(0.24, 0.52), at(0.43, 0.71), at(0.78, 0.3)}));
    } else {
      painter.drawLine(at(0.27, 0.5), at(0.73, 0.5));
    }
  }
  painter.restore();
}

/// A button that is on or pressed.
void draw_pressed_button(QPainter& painter, const QStyleOption& option) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor button = option.palette.color(QPalette::Button);
  const bool enabled = option.state & QStyle::State_Enabled;
  const QColor color = enabled ? accent : disabled_ink;
  painter.setPen(color);
  painter.setBrush(mixed(button, color, current.dark ? 0.4 : 0.22));
  painter.drawRoundedRect(QRectF(option.rect).adjusted(0.5, 0.5, -0.5, -0.5), 2, 2);
  painter.restore();
}

/// Side of the triangle on a button that opens a menu, pixels.
int menu_triangle() { return scaled(8); }

/// Whether a button opens a menu wherever it is pressed.
bool opens_menu(const QStyleOption* option) {
  const auto* button = qstyleoption_cast<const QStyleOptionToolButton*>(option);
  return button != nullptr && (button->features & QStyleOptionToolButton::HasMenu) &&
         !(button->features & QStyleOptionToolButton::MenuButtonPopup);
}

/// Scales icons and indicators with the font; marks active buttons and boxes, and buttons that open
/// a menu, so that they are recognized in every appearance.
class ScaledStyle : public QProxyStyle {
 public:
  ScaledStyle() : QProxyStyle(QStringLiteral("Fusion")) {}

  int pixelMetric(PixelMetric metric, const QStyleOption* option,
                  const QWidget* widget) const override {
    switch (metric) {
      case PM_ToolBarIconSize:
        return scaled(tool_icon_size);
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

  int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                QStyleHintReturn* more) const override {
    return hint == SH_DialogButtonBox_ButtonsHaveIcons
               ? 0
               : QProxyStyle::styleHint(hint, option, widget, more);
  }

  /// Room for the triangle of a button that opens a menu.
  QSize sizeFromContents(ContentsType type, const QStyleOption* option, const QSize& contents,
                         const QWidget* widget) const override {
    const QSize size = QProxyStyle::sizeFromContents(type, option, contents, widget);
    return type == CT_ToolButton && opens_menu(option) ? size + QSize(scaled(4), 0) : size;
  }

  /// Fusion's triangle in the corner of a button with a menu has two pixels; this one lies beside
  /// the text, in its margin.
  void drawComplexControl(ComplexControl control, const QStyleOptionComplex* option,
                          QPainter* painter, const QWidget* widget) const override {
    if (control != CC_ToolButton || !opens_menu(option)) {
      QProxyStyle::drawComplexControl(control, option, painter, widget);
      return;
    }
    QStyleOptionToolButton plain(*qstyleoption_cast<const QStyleOptionToolButton*>(option));
    plain.features &= ~QStyleOptionToolButton::HasMenu;
    QProxyStyle::drawComplexControl(control, &plain, painter, widget);
    const int size = menu_triangle();
    plain.rect = QRect(option->rect.right() - size - scaled(3),
                       option->rect.center().y() - size / 2 + scaled(1), size, size);
    drawPrimitive(PE_IndicatorArrowDown, &plain, painter, widget);
  }

  /// A text that is too long ends in an ellipsis; Qt cuts it at both ends.
  void drawControl(ControlElement element, const QStyleOption* option, QPainter* painter,
                   const QWidget* widget) const override {
    const auto* button = qstyleoption_cast<const QStyleOptionToolButton*>(option);
    if (element != CE_ToolButtonLabel || button == nullptr || !button->icon.isNull()) {
      QProxyStyle::drawControl(element, option, painter, widget);
      return;
    }
    QStyleOptionToolButton fitting(*button);
    if (const auto* tool = qobject_cast<const QToolButton*>(widget); tool && tool->menu()) {
      fitting.rect.setRight(fitting.rect.right() - menu_triangle());
    }
    fitting.text = button->fontMetrics.elidedText(button->text, Qt::ElideRight,
                                                  fitting.rect.width(), Qt::TextShowMnemonic);
    QProxyStyle::drawControl(element, &fitting, painter, widget);
  }

  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override {
    const bool pressed = option->state & (State_On | State_Sunken);
    if (element == PE_IndicatorCheckBox || element == PE_IndicatorItemViewItemCheck) {
      draw_check_box(*painter, option->rect, option->state);
    } else if (pressed && (element == PE_PanelButtonCommand || element == PE_PanelButtonTool)) {
      draw_pressed_button(*painter, *option);
    } else {
      QProxyStyle::drawPrimitive(element, option, painter, widget);
    }
  }
};

// The files of icons/, in the order of enum Icon.
constexpr const char* icon_files[] = {"open",           "run",
                                      "pause",          "one_direction",
                                      "one_iteration",  "stop",
                                      "frame",          "warning",
                                      "error",          "close",
                                      "scene",          "step_on",
                                      "step_back",      "phase_on",
                                      "next_event",     "previous_event",
                                      "next_exchange",  "previous_exchange",
                                      "next_direction", "previous_direction",
                                      "newest",         "study",
                                      "info",           "close"};
static_assert(std::size(icon_files) == static_cast<std::size_t>(Icon::clear) + 1);

// The SVG text of an icon, in which "currentColor" stands for its color.
QByteArray icon_source(Icon which) {
  find_resources();
  QFile file(QStringLiteral(":/icons/%1.svg").arg(QLatin1String(at(icon_files, which))));
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

QByteArray colored(QByteArray svg, const QColor& color) {
  return svg.replace("currentColor", color.name().toLatin1());
}

QColor color_of(Icon which) {
  switch (which) {
    case Icon::run:
      return good;
    case Icon::stop:
    case Icon::error:
      return current.dark ? QColor(0xe0, 0x5a, 0x5a) : QColor(0xb9, 0x2d, 0x2d);
    case Icon::warning:
      return current.dark ? QColor(0xe0, 0x9a, 0x30) : QColor(0xb3, 0x6b, 0x00);
    case Icon::info:
      return current.dark ? accent : QColor(0x2f, 0x6f, 0xb5);
    default:
      return ink;
  }
}

/// Renders an icon in the size and the current color on each use, so that it follows the
/// appearance and the screen's resolution.
class SvgIcon : public QIconEngine {
 public:
  explicit SvgIcon(Icon which) : which_(which), source_(icon_source(which)) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State) override {
    const double size = std::min(rect.width(), rect.height());
    QRectF square(0, 0, size, size);
    square.moveCenter(QRectF(rect).center());
    const QColor& color = mode == QIcon::Disabled ? disabled_ink : color_of(which_);
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    if (mode == QIcon::Disabled) {
      painter->setOpacity(source_.contains('#') ? 0.5 : 1);  // the icon has its own colors
    }
    QSvgRenderer(colored(source_, color)).render(painter, square);
    painter->restore();
  }
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    QPixmap picture(size);
    picture.fill(Qt::transparent);
    QPainter painter(&picture);
    paint(&painter, QRect(QPoint(), size), mode, state);
    return picture;
  }
  QIconEngine* clone() const override { return new SvgIcon(which_); }

 private:
  Icon which_;
  QByteArray source_;
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
    exchange_ink = inside;
    good = {0x52, 0xc4, 0x86};
    hover = {0x36, 0x3d, 0x47};
    title = {0x2d, 0x32, 0x3a};
    finished = {0x41, 0x56, 0x74};
    disabled_ink = {0x7a, 0x82, 0x8d};
  } else {
    window = {0xf4, 0xf5, 0xf7};
    paper = {0xff, 0xff, 0xff};
    ink = {0x1b, 0x21, 0x2a};
    ink_dim = {0x5a, 0x64, 0x72};
    rule = {0xd3, 0xd8, 0xde};
    accent = {0x1f, 0x66, 0xc2};
    warm = {0xb3, 0x4a, 0x00};
    exchange_ink = inside.darker(140);
    good = {0x1a, 0x7f, 0x4b};
    hover = {0xe3, 0xe8, 0xef};
    title = {0xe6, 0xe9, 0xee};
    finished = {0xb9, 0xcc, 0xe6};
    disabled_ink = {0xb4, 0xba, 0xc2};
  }
  if (!appearance.projector) {
    return;
  }
  // In a lit room, grays are hard to distinguish on a projector.
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
  if (current.dark) {
    palette.setColor(QPalette::Light, rule);  // the line under tabs
  }
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    palette.setColor(QPalette::Disabled, role, disabled_ink.darker(current.dark ? 90 : 118));
  }
  return palette;
}

/// Bars across the scene, tinted by their kind.
QString banner_style() {
  QString sheet = QStringLiteral(R"(
    transillum--viewer--Banner QPushButton { background: %1; color: %2; border-radius: 4px;
      padding: 4px 12px; }
    transillum--viewer--Banner QPushButton:disabled { color: %3; }
    transillum--viewer--Banner QPushButton::menu-indicator { subcontrol-position: right center;
      right: 3px; }
  )")
                      .arg(paper.name(), ink.name(), disabled_ink.name());
  for (const auto& [kind, icon] :
       {std::pair{"error", Icon::error}, {"warning", Icon::warning}, {"offer", Icon::info}}) {
    const QColor color = color_of(icon);
    sheet += QStringLiteral(R"(
    transillum--viewer--Banner[kind="%1"] { background: %2; border: none;
      border-bottom: 1px solid %3; }
    transillum--viewer--Banner[kind="%1"] QPushButton { border: 1px solid %3; }
    transillum--viewer--Banner[kind="%1"] QPushButton:hover { border-color: %4; }
  )")
                 .arg(QLatin1String(kind), mixed(paper, color, current.dark ? 0.25 : 0.12).name(),
                      mixed(paper, color, 0.45).name(), color.name());
  }
  return sheet;
}

QString style_sheet(const QPalette& application_palette) {
  return QStringLiteral(R"(
    QToolBar { border: none; border-bottom: 1px solid %1; padding: 3px 6px; spacing: 4px; }
    QToolBar QToolButton { padding: 4px 9px 4px 6px; border-radius: 4px; }
    QToolBar QToolButton:hover:enabled { background: %2; }
    QToolBar QToolButton:pressed { background: %1; }
    QToolBar QToolButton[workspace="true"] { padding: 5px 14px; font-weight: bold; }
    QToolBar QToolButton[workspace="true"]:checked { background: %4; color: %5; }
    QMainWindow > QTabBar::tab { background: %3; color: %6; padding: 5px 8px 4px 8px;
      border: none; border-right: 1px solid %1; border-top: 3px solid %3; }
    QMainWindow > QTabBar::tab:hover { background: %2; }
    QMainWindow > QTabBar::tab:selected { background: %7; color: %8; border-top: 3px solid %4; }
    QStatusBar { border-top: 1px solid %1; }
    QStatusBar::item { border: none; }
    QDockWidget, QLabel[strong="true"] { font-weight: bold; }
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
    QPushButton[segment="true"] { border: 1px solid %1; border-radius: 4px; padding: 5px 2px;
      background: %7; }
    QPushButton[segment="true"]:hover:enabled { background: %2; }
    QPushButton[segment="true"]:focus { border-color: %4; }
    QPushButton[segment="true"]:checked { border-color: %4; color: %4; font-weight: bold; }
    QLineEdit[chosen="true"] { color: %4; font-weight: bold; }
    QPushButton[primary="true"] { border: 1px solid %4; border-radius: 4px; padding: 7px;
      background: %4; color: %5; }
    QPushButton[primary="true"]:hover { border-color: %8; }
    QPushButton[primary="true"]:focus { border-color: %8; }
    QPushButton[primary="true"]:disabled { background: %3; border-color: %1; color: %6; }
  )")
      .arg(rule.name(), hover.name(), title.name(), accent.name(),
           application_palette.color(QPalette::HighlightedText).name(), ink_dim.name(),
           paper.name(), ink.name());
}

}  // namespace

QIcon icon(Icon which) { return QIcon(new SvgIcon(which)); }

double scale() { return line_scale.load(std::memory_order_relaxed); }

int scaled(int pixels) { return static_cast<int>(std::lround(pixels * scale())); }

const Appearance& appearance() { return current; }

void apply(QApplication& application, const Appearance& appearance) {
  current = appearance;
  line_scale = appearance.projector ? projector_scale() : 1;
  set_colors(appearance);
  application.setStyle(new ScaledStyle);
  const QPalette palette = make_palette();
  application.setPalette(palette);
  QFont font = application.font();
  const QFont preferred(QStringLiteral("DejaVu Sans"));
  if (QFontInfo(preferred).family() == preferred.family()) {
    font.setFamily(preferred.family());
  }
  font.setPixelSize(scaled(type_size));
  application.setFont(font);
  application.setStyleSheet(style_sheet(palette) + banner_style());
}

}  // namespace transillum::viewer::theme
