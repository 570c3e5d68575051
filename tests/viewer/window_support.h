// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QVTKOpenGLNativeWidget.h>

#include <QAbstractAnimation>
#include <QAbstractButton>
#include <QAbstractSpinBox>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QImage>
#include <QLineEdit>
#include <QMenuBar>
#include <QMouseEvent>
#include <QSet>
#include <QSlider>
#include <QStandardPaths>
#include <QSurfaceFormat>
#include <QTabBar>
#include <QTest>
#include <QTimer>
#include <algorithm>
#include <cstdlib>
#include <functional>

#include "map/map_canvas.h"
#include "map/map_view.h"
#include "registered.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "scene/sharp_view.h"
#include "solve/settings_panel.h"
#include "support/number_text.h"
#include "widgets/banner.h"
#include "widgets/theme.h"
#include "window/files/file_actions.h"
#include "window/main_window.h"

namespace transillum::viewer::test {

/// Lets the event loop run until `condition` holds. The limit is for busy machines, on which the
/// solver's thread, of a low priority, waits long for a processor.
inline bool wait_for(const std::function<bool()>& condition, int milliseconds = 120000) {
  return QTest::qWaitFor(condition, milliseconds);
}

/// Handles what has been posted, and what that posts: layouts, queued calls, repaints.
inline void handle_posted() { QCoreApplication::processEvents(); }

/// Number of clearly different colors in a picture, at 16 levels per channel.
inline int color_count(const QImage& image) {
  QSet<QRgb> colors;
  for (int y = 0; y < image.height(); y += 2) {
    for (int x = 0; x < image.width(); x += 2) {
      colors.insert(image.pixel(x, y) & 0xfff0f0f0);
    }
  }
  return static_cast<int>(colors.size());
}

/// The fraction of pixels that are close to `color`.
inline double fraction_of(const QImage& image, const QColor& color) {
  qint64 close = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const QColor pixel = image.pixelColor(x, y);
      close += std::abs(pixel.red() - color.red()) + std::abs(pixel.green() - color.green()) +
                   std::abs(pixel.blue() - color.blue()) <
               24;
    }
  }
  return static_cast<double>(close) / (image.width() * image.height());
}

/// The number of pixels that differ between two pictures; -1 if their sizes differ.
inline int different_pixels(const QImage& a, const QImage& b) {
  if (a.size() != b.size()) {
    return -1;
  }
  int count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      count += a.pixel(x, y) != b.pixel(x, y);
    }
  }
  return count;
}

/// Whether a patch, or none, is drawn at a point of the scene and around it.
inline bool is_inside(const SceneView& view, const QPoint& point, PatchId patch) {
  constexpr int margin = 4;
  const QPoint around[] = {{margin, 0}, {-margin, 0}, {0, margin}, {0, -margin}};
  return std::all_of(std::begin(around), std::end(around),
                     [&](const QPoint& offset) { return view.patch_at(point + offset) == patch; });
}

/// The fraction of points inside patches, or inside the background, whose pixels have the color
/// that `color_of` gives for the patch, or no_patch. It is 0 if there are no such points.
inline double fraction_in_color(const SceneView& view,
                                const std::function<QColor(PatchId)>& color_of) {
  const QImage picture = view.canvas()->grab().toImage();
  const double scale = 1.0 * picture.width() / view.canvas()->width();
  int points = 0, right = 0;
  for (int y = 8; y < view.canvas()->height() - 8; y += 9) {
    for (int x = 8; x < view.canvas()->width() - 8; x += 9) {
      const PatchId patch = view.patch_at({x, y});
      if (!is_inside(view, {x, y}, patch)) {
        continue;
      }
      const QColor pixel = picture.pixelColor(static_cast<int>((x + 0.5) * scale),
                                              static_cast<int>((y + 0.5) * scale));
      const QColor color = color_of(patch);
      ++points;
      constexpr int rounding = 2;
      right +=
          std::max({std::abs(pixel.red() - color.red()), std::abs(pixel.green() - color.green()),
                    std::abs(pixel.blue() - color.blue())}) <= rounding;
    }
  }
  return points > 0 ? 1.0 * right / points : 0.0;
}

/// The fraction of points of the scene's picture that have the color of their patch, or of the
/// background: nearly 1 where the picture has these colors, patches and camera. Lines and the plane
/// of the direction cover some.
inline double fraction_in_own_color(const SceneView& view, const ColorChoice& colors) {
  return fraction_in_color(view, [&colors](PatchId patch) {
    if (patch == no_patch) {
      return theme::scene_background;
    }
    const Color8& color = colors.patch_colors()[static_cast<std::size_t>(patch)];
    return QColor(color[0], color[1], color[2]);
  });
}

/// Drags from a point with the left button, in `steps` movements. Unlike QTest::mouseMove(), this
/// does not move the pointer of the screen, whose events arrive at any time.
inline void drag(QWidget& canvas, const QPoint& from, const QPoint& by, int steps = 4) {
  QTest::mousePress(&canvas, Qt::LeftButton, {}, from);
  for (int k = 1; k <= steps; ++k) {
    const QPoint place = from + k * by / steps;
    QMouseEvent move(QEvent::MouseMove, place, canvas.mapToGlobal(place), Qt::LeftButton,
                     Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&canvas, &move);
  }
  QTest::mouseRelease(&canvas, Qt::LeftButton, {}, from + by);
}

/// A window that remembers nothing, with the state that it shows, which outlives it. Sharp pictures
/// are off, so that patches have their own colors, and faces are not divided unasked.
struct TestWindow : SharedState, MainWindow {
  TestWindow() : MainWindow(static_cast<SharedState&>(*this), false) {
    views().page.sharp()->action()->setChecked(false);
    files().set_divides(false);
  }

  void set_options(const SolveOptions& solve, const SceneOptions& scene_options) {
    views().settings.set_options(solve, scene_options);
  }
  /// Opens and solves a scene, with the options of the settings panel. The map and the timeline,
  /// which the layout in use may close, are shown with the first scene.
  void open(const QString& spec, Goal goal = {Goal::Kind::finished}) {
    if (!scene.loaded()) {
      views().docks.bring_to_front("timeline");
      views().docks.bring_to_front("map");
    }
    scene.open(spec.toStdString(), views().settings.options(), goal);
  }
  std::shared_ptr<const SolverSnapshot> snapshot() const { return scene.snapshot(); }
  QString banner_text() { return views().page.banner()->text(); }
};

/// Whether a part of the window is about to change by itself: Qt moves docks by animations, and
/// panels refresh after pauses, for which their timers run.
inline bool changes_later(const QWidget& window) {
  const auto animations = window.findChildren<QAbstractAnimation*>();
  const auto timers = window.findChildren<QTimer*>();
  return std::any_of(animations.begin(), animations.end(),
                     [](const QAbstractAnimation* animation) {
                       return animation->state() == QAbstractAnimation::Running;
                     }) ||
         std::any_of(timers.begin(), timers.end(), [](const QTimer* timer) {
           return timer->isSingleShot() && timer->isActive();
         });
}

/// Waits until the solver is idle, every view shows the newest state in its place, and the scene
/// has its final picture; three times, with what has been posted in between: a view may be about to
/// ask for a picture.
inline bool comes_to_rest(const TestWindow& window, int milliseconds = 120000) {
  const auto* view = window.findChild<SceneView*>();
  int checks = 0;
  return wait_for(
      [&] {
        checks = window.settled() && view->at_rest() && !changes_later(window) ? checks + 1 : 0;
        return checks == 3;
      },
      milliseconds);
}

inline std::unique_ptr<TestWindow> make_window(const SolveOptions& options) {
  auto window = std::make_unique<TestWindow>();
  window->set_options(options, {});
  window->show();
  (void)QTest::qWaitForWindowExposed(window.get());
  return window;
}
/// A window with small settings, so that a test takes little time.
inline std::unique_ptr<TestWindow> make_window(int directions = 32) {
  return make_window(SolveOptions{.directions = directions, .first_shot = {}});
}

/// The controls of a window as it is on the screen: buttons, fields, sliders,
/// tabs and the titles of menus.
inline QStringList controls_of(const QWidget& window) {
  QStringList found;
  for (const QWidget* part : window.findChildren<QWidget*>()) {
    const bool on_screen = part->window() == &window && part->isVisible() && part->isEnabled() &&
                           !part->visibleRegion().isEmpty();
    if (!on_screen) {
      continue;
    }
    const QWidget* around = part->parentWidget();
    const bool of_field =
        qobject_cast<const QComboBox*>(around) || qobject_cast<const QAbstractSpinBox*>(around);
    if (const auto* bar = qobject_cast<const QTabBar*>(part)) {
      for (int k = 0; k < bar->count(); ++k) {
        found << "tab " + bar->tabText(k);
      }
    } else if (const auto* menus = qobject_cast<const QMenuBar*>(part)) {
      for (const QAction* menu : menus->actions()) {
        found << "menu " + menu->text();
      }
    } else if (const auto* button = qobject_cast<const QAbstractButton*>(part)) {
      found << "button " + button->objectName() + ' ' + button->text();
    } else if (qobject_cast<const QComboBox*>(part) ||
               qobject_cast<const QAbstractSpinBox*>(part) || qobject_cast<const QSlider*>(part) ||
               (qobject_cast<const QLineEdit*>(part) && !of_field)) {
      found << "field " + part->objectName();
    }
  }
  return found;
}

/// Saves a picture for inspection, in the folder named by TRANSILLUM_PICTURES, if it is set.
inline void save_picture(QWidget& window, const QString& name) {
  const QString folder = qEnvironmentVariable("TRANSILLUM_PICTURES");
  if (!folder.isEmpty()) {
    handle_posted();
    window.grab().save(QStringLiteral("%1/%2.png").arg(folder, name));
  }
}

/// Runs a test with Qt set up as main.cpp does.
template <class Test>
int run_as_viewer(int argc, char** argv) {
  QStandardPaths::setTestModeEnabled(true);
  QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs);  // tests enter names in Qt's
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  QApplication application(argc, argv);
  use_decimal_point();
  theme::apply(application);
  return run_without_application<Test>(argc, argv);
}

}  // namespace transillum::viewer::test
