// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <QVTKOpenGLNativeWidget.h>

#include <QApplication>
#include <QSurfaceFormat>
#include <cstdlib>
#include <iostream>

#include "transillum/errors.h"
#include "transillum/files.h"
#include "widgets/theme.h"
#include "window/command_line.h"
#include "window/file_actions.h"
#include "window/main_window.h"
#include "window/screenshot.h"

using namespace transillum::viewer;

namespace {

// Qt would abort without saying what to do.
bool has_display() {
#ifdef __linux__
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}) {
    if (const char* value = std::getenv(name); value != nullptr && *value != '\0') {
      return true;
    }
  }
  return false;
#else
  return true;
#endif
}

void say(const QString& message) {
  std::cerr << "transillum-viewer: " << message.toStdString() << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  const ParsedCommandLine parsed = parse_command_line(argc, argv, std::cout, std::cerr);
  if (parsed.exit_now) {
    return parsed.exit_status;
  }
  if (!has_display()) {
    say("no display: set DISPLAY, or run it under xvfb-run -a");
    return 1;
  }
  const CommandLine& wish = parsed.command_line;

#if QT_VERSION < QT_VERSION_CHECK(6, 0, 0)
  QApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
#endif
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  // Qt looks for options of its own: ours are none of them.
  int qt_argc = 1;
  QApplication application(qt_argc, argv);
  QApplication::setOrganizationName("transillum");
  QApplication::setApplicationName("transillum-viewer");
  theme::apply(application);

  const bool for_screenshot = !wish.screenshot.empty();
  MainWindow window(!for_screenshot);
  window.set_options(wish.solve_options, wish.scene_options);
  int status = 0;
  std::unique_ptr<Screenshot> screenshot;
  if (for_screenshot) {
    screenshot = std::make_unique<Screenshot>(window, QString::fromStdString(wish.screenshot));
    QObject::connect(screenshot.get(), &Screenshot::done, &application, &QApplication::quit);
    const auto give_up = [&](const QString& message, int exit_status) {
      say(message);
      status = exit_status;
      application.quit();
    };
    QObject::connect(screenshot.get(), &Screenshot::failed, &application,
                     [give_up](const QString& message) { give_up(message, 1); });
    QObject::connect(
        &window, &MainWindow::failed, &application,
        [give_up](const QString& message, bool bad_input) { give_up(message, bad_input ? 2 : 1); });
  }
  window.show();
  // Who asks for nothing finds something that runs.
  const std::string scene = wish.scene.empty() && wish.lesson.empty() ? "sphere-flake" : wish.scene;
  std::optional<Goal> goal;
  if (wish.after > 0) {
    goal = Goal{Goal::Kind::passes, wish.after};
  } else if (for_screenshot && !transillum::is_result_file(scene)) {
    goal = Goal{Goal::Kind::iteration};
  }
  try {
    if (!scene.empty()) {
      window.files().open(QString::fromStdString(scene), goal);
    }
    if (!wish.lesson.empty()) {
      window.begin_lesson(wish.lesson, wish.page);
    }
  } catch (const transillum::InputError& error) {
    say(QString::fromStdString(error.what()));
    return 2;
  }
  QApplication::exec();
  return status;
}
