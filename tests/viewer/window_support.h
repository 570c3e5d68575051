// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QVTKOpenGLNativeWidget.h>

#include <QApplication>
#include <QImage>
#include <QSet>
#include <QStandardPaths>
#include <QSurfaceFormat>
#include <QTest>
#include <functional>

#include "map/map_canvas.h"
#include "map/map_view.h"
#include "registered.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "solve/settings_panel.h"
#include "support/number_text.h"
#include "widgets/banner.h"
#include "widgets/theme.h"
#include "window/file_actions.h"
#include "window/main_window.h"

namespace transillum::viewer::test {

/// Lets the event loop run until `condition` holds.
inline bool wait_for(const std::function<bool()>& condition, int milliseconds = 30000) {
  return QTest::qWaitFor(condition, milliseconds);
}

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

/// The share of pixels that are close to `color`.
inline double share_of(const QImage& image, const QColor& color) {
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

/// A window that remembers nothing, with the state that it shows, which outlives it.
struct TestWindow : SharedState, MainWindow {
  TestWindow() : MainWindow(static_cast<SharedState&>(*this), false) {}

  void set_options(const SolveOptions& solve, const SceneOptions& scene_options) {
    parts().settings.set_options(solve, scene_options);
  }
  /// Opens and solves a scene, with the options of the settings panel.
  void open(const QString& spec, Goal goal = {Goal::Kind::finished}) {
    scene.open(spec.toStdString(), parts().settings.options(), goal);
  }
  std::shared_ptr<const SolverSnapshot> snapshot() const { return scene.snapshot(); }
  QString banner_text() { return parts().page.banner()->text(); }
};

inline std::unique_ptr<TestWindow> make_window(const SolveOptions& options) {
  auto window = std::make_unique<TestWindow>();
  window->set_options(options, {});
  window->show();
  (void)QTest::qWaitForWindowExposed(window.get());
  return window;
}
/// A window with small settings, so that a test takes little time.
inline std::unique_ptr<TestWindow> make_window(int directions = 32) {
  return make_window(SolveOptions{.directions = directions});
}

/// Saves a picture for inspection, in the folder named by TRANSILLUM_PICTURES, if it is set.
inline void save_picture(QWidget& window, const QString& name) {
  const QString folder = qEnvironmentVariable("TRANSILLUM_PICTURES");
  if (!folder.isEmpty()) {
    window.grab().save(QStringLiteral("%1/%2.png").arg(folder, name));
  }
}

/// Runs a test with Qt set up as main.cpp does.
template <class Test>
int run_as_viewer(int argc, char** argv) {
  QStandardPaths::setTestModeEnabled(true);
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  QApplication application(argc, argv);
  use_decimal_point();
  theme::apply(application);
  return run_without_application<Test>(argc, argv);
}

}  // namespace transillum::viewer::test
