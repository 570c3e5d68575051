// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <QVTKOpenGLNativeWidget.h>

#include <QApplication>
#include <QSurfaceFormat>
#include <cstdlib>
#include <iostream>

#include "solve/settings_panel.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "widgets/theme.h"
#include "window/command_line.h"
#include "window/file_actions.h"
#include "window/main_window.h"
#include "window/screenshot.h"

using namespace transillum::viewer;

namespace {

// Without a display Qt aborts with a message that names no remedy.
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

void print_error(const QString& message) {
  std::cerr << "transillum-viewer: " << message.toStdString() << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  const ParsedCommandLine parsed = parse_command_line(argc, argv, std::cout, std::cerr);
  if (parsed.exit_now) {
    return parsed.exit_status;
  }
  if (!has_display()) {
    print_error("no display: set DISPLAY, or run it under xvfb-run -a");
    return 1;
  }
  const CommandLine& command_line = parsed.command_line;

#if QT_VERSION < QT_VERSION_CHECK(6, 0, 0)
  QApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
#endif
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  // Qt would take arguments that it knows; ours are not for it.
  int qt_argc = 1;
  QApplication application(qt_argc, argv);
  QApplication::setOrganizationName("transillum");
  QApplication::setApplicationName("transillum-viewer");
  theme::apply(application);

  const bool for_screenshot = !command_line.screenshot.empty();
  SharedState state;
  MainWindow window(state, !for_screenshot);
  window.parts().settings.set_options(command_line.solve_options, command_line.scene_options);
  int status = 0;
  std::unique_ptr<Screenshot> screenshot;
  if (for_screenshot) {
    screenshot = std::make_unique<Screenshot>(
        window, [&] { return window.settled(); }, QString::fromStdString(command_line.screenshot));
    QObject::connect(screenshot.get(), &Screenshot::done, &application, &QApplication::quit);
    const auto give_up = [&](const QString& message, int exit_status) {
      print_error(message);
      status = exit_status;
      application.quit();
    };
    QObject::connect(screenshot.get(), &Screenshot::failed, &application,
                     [give_up](const QString& message) { give_up(message, 1); });
    QObject::connect(
        &state.runner, &SolveRunner::failed, &application,
        [give_up](const QString& message, bool bad_input) { give_up(message, bad_input ? 2 : 1); });
  }
  window.show();
  // Without arguments, start with a scene that is being solved.
  const std::string scene = command_line.scene.empty() && command_line.lesson.empty()
                                ? "sphere-flake"
                                : command_line.scene;
  std::optional<Goal> goal;
  if (command_line.after > 0) {
    goal = Goal{Goal::Kind::passes, command_line.after};
  } else if (for_screenshot && !transillum::is_result_file(scene)) {
    goal = Goal{Goal::Kind::iteration};
  }
  try {
    if (!scene.empty()) {
      window.files().open(QString::fromStdString(scene), goal);
    }
    if (!command_line.lesson.empty()) {
      window.files().open_lesson(command_line.lesson, command_line.page);
    }
  } catch (const transillum::InputError& error) {
    print_error(QString::fromStdString(error.what()));
    return 2;
  }
  QApplication::exec();
  return status;
}
