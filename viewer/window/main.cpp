// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <QVTKOpenGLNativeWidget.h>
#include <malloc.h>

#include <QIcon>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QSurfaceFormat>
#include <QTimer>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "scene/scene_page.h"
#include "solve/settings_panel.h"
#include "support/failure_text.h"
#include "support/number_text.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "widgets/theme.h"
#include "window/application.h"
#include "window/base/view_state_applier.h"
#include "window/command_line.h"
#include "window/files/file_actions.h"
#include "window/files/lesson_export.h"
#include "window/files/recovery.h"
#include "window/files/screenshot.h"
#include "window/main_window.h"
#include "window/vertical_control.h"

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

/// Handles Qt's messages until display and OpenGL are known to work. Qt's only fatal error is a
/// display that it cannot use; it would print several lines and abort.
void exit_without_display(QtMsgType type, const QMessageLogContext&, const QString&) {
  if (type == QtFatalMsg) {
    print_error(QStringLiteral("no display: cannot open \"%1\"; set DISPLAY, or run it under "
                               "xvfb-run -a")
                    .arg(qEnvironmentVariable(qEnvironmentVariableIsSet("QT_QPA_PLATFORM")
                                                  ? "QT_QPA_PLATFORM"
                                                  : "DISPLAY")));
    std::_Exit(1);
  }
}

/// Whether an OpenGL context that VTK can use can be made. On X11, VTK needs GLX; Qt alone could
/// also use EGL.
bool has_opengl() {
  QOffscreenSurface surface;
  surface.create();
  QOpenGLContext context;
  if (!context.create() || !context.makeCurrent(&surface) ||
      context.format().version() < qMakePair(3, 2)) {
    return false;
  }
#if QT_VERSION < QT_VERSION_CHECK(6, 0, 0)
  return QGuiApplication::platformName() != QLatin1String("xcb") ||
         QByteArray(context.nativeHandle().typeName()) == "QGLXNativeContext";
#else
  return true;
#endif
}

/// Ends the program after an exception that has left a function that must not throw; even the
/// report may fail.
[[noreturn]] void end_with_line() {
  const char* text = "unknown error";
  try {
    if (std::current_exception()) {
      throw;
    }
  } catch (const std::bad_alloc&) {
    text = "not enough memory";
  } catch (const std::exception& error) {
    text = error.what();
  } catch (...) {
  }
  std::fprintf(stderr, "transillum-viewer: %s\n", text);
  std::_Exit(1);
}

std::optional<Goal> goal_of(const CommandLine& command_line) {
  if (command_line.after > 0) {
    return Goal{Goal::Kind::passes, command_line.after};
  }
  return std::nullopt;
}

/// Prepares a program that is to write one file and exit: a failure that prevents this is printed,
/// and ends the event loop. @returns what to call with other failures and the exit status for them
std::function<void(const QString&, int)> exit_on_failure(MainWindow& window,
                                                         const SolveRunner& runner) {
  const auto fail = [failed = std::make_shared<bool>(false)](const QString& message,
                                                             int exit_status) {
    if (!std::exchange(*failed, true)) {
      print_error(message);
      QApplication::exit(exit_status);
    }
  };
  QObject::connect(
      &runner, &SolveRunner::failed, qApp,
      [fail](const QString& message, bool bad_input) { fail(message, bad_input ? 2 : 1); });
  // The call is made later: before the event loop, exit() has no effect.
  QObject::connect(
      &window.applier(), &ViewStateApplier::unreachable, qApp,
      [fail](const QString& message) { fail(message, 2); }, Qt::QueuedConnection);
  return fail;
}

/// Writes a screenshot once the window is settled; that ends the event loop.
std::unique_ptr<Screenshot> take_screenshot(MainWindow& window, const std::string& path,
                                            const std::function<void(const QString&, int)>& fail) {
  auto screenshot = std::make_unique<Screenshot>(
      window, [&window] { return window.settled(); }, QString::fromStdString(path));
  QObject::connect(screenshot.get(), &Screenshot::done, qApp, &QApplication::quit);
  QObject::connect(screenshot.get(), &Screenshot::failed, qApp,
                   [fail](const QString& message) { fail(message, 1); });
  return screenshot;
}

/// Writes the lesson that is open, from within the event loop; that ends it.
void export_lesson(MainWindow& window, const std::string& path,
                   const std::function<void(const QString&, int)>& fail) {
  auto* exporter = window.findChild<LessonExport*>();
  QObject::connect(exporter, &LessonExport::written, qApp, &QApplication::quit);
  QObject::connect(exporter, &LessonExport::failed, qApp,
                   [fail](const QString& message) { fail(message, 1); });
  QTimer::singleShot(0, exporter,
                     [exporter, path] { exporter->export_to(QString::fromStdString(path)); });
}

/// @throws InputError where a session or a lesson cannot be read
void open_arguments(MainWindow& window, const CommandLine& command_line) {
  if (command_line.up) {
    window.findChild<VerticalControl*>()->prefer(*command_line.up);
  }
  if (!command_line.scene.empty()) {
    window.views().page.show_scene();
    window.files().set_divides(command_line.first_look);
    window.files().open(QString::fromStdString(command_line.scene), goal_of(command_line),
                        command_line.options.input, command_line.reading_given);
  }
  window.files().set_divides(true);
  if (!command_line.lesson.empty()) {
    window.files().open_lesson(command_line.lesson, command_line.page);
  }
}

/// Closes the window, and leaves unsaved faces to the next program; prints where unsaved notes are,
/// or why they could not be saved.
void end_by_signal(MainWindow& window, int number) {
  if (auto* recovery = window.findChild<Recovery*>()) {
    recovery->leave_faces();
  }
  try {
    if (const QString notes = window.close_without_questions(); !notes.isEmpty()) {
      print_error(QStringLiteral("the notes are in %1").arg(notes));
    }
  } catch (const std::exception& error) {
    print_error(QStringLiteral("the notes could not be saved: ") + failure_text(error));
  }
  QApplication::exit(128 + number);
}

/// Shows the window until it is closed. @returns the exit status
int run(Application& application, const CommandLine& command_line) {
  EndingSignals signals_of_user;
  const bool for_screenshot = !command_line.screenshot.empty();
  const bool for_file = for_screenshot || !command_line.lesson_file.empty();
  SharedState state;
  MainWindow window(state, !for_file);
  window.views().settings.set_options(command_line.options);
  QObject::connect(&signals_of_user, &EndingSignals::received, &window,
                   [&window](int number) { end_by_signal(window, number); });
  std::unique_ptr<Screenshot> screenshot;
  std::function<void(const QString&, int)> fail;
  if (for_file) {
    fail = exit_on_failure(window, state.runner);
  }
  if (for_screenshot) {
    screenshot = take_screenshot(window, command_line.screenshot, fail);
  }
  window.show();
  try {
    open_arguments(window, command_line);
    if (!command_line.lesson_file.empty()) {
      export_lesson(window, command_line.lesson_file, fail);
    }
  } catch (const transillum::InputError& error) {
    print_error(QString::fromStdString(error.what()));
    return 2;
  }
  application.on_failure = [&](const QString& message) {
    if (for_file) {
      print_error(message);
      std::_Exit(1);
    }
    window.show_failure(message);
  };
  const int status = QApplication::exec();
  application.on_failure = nullptr;
  return signals_of_user.number() > 0 ? 128 + signals_of_user.number() : status;
}

}  // namespace

int main(int argc, char** argv) {
  std::set_terminate(end_with_line);
  // Freed lists of one phase go back to the system before the next: a tenth less memory. The C
  // library would raise its threshold with each large one, and have heaps for each thread.
  mallopt(M_MMAP_THRESHOLD, 128 << 10);
  mallopt(M_ARENA_MAX, 2);
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
  const QtMessageHandler usual_handler = qInstallMessageHandler(exit_without_display);
  Application application(qt_argc, argv);
  const bool can_draw = has_opengl();
  qInstallMessageHandler(usual_handler);
  if (!can_draw) {
    print_error(
        "no OpenGL 3.2 on this display: install a driver, such as Mesa's software renderer "
        "(package libgl1-mesa-dri)");
    return 1;
  }
  use_decimal_point();
  QApplication::setOrganizationName("transillum");
  QApplication::setApplicationName("transillum-viewer");
  QGuiApplication::setDesktopFileName("org.transillum.Viewer");
  QApplication::setWindowIcon(QIcon(":/icons/transillum-viewer.svg"));
  theme::apply(application);
  try {
    return run(application, command_line);
  } catch (const std::exception& error) {
    print_error(failure_text(error));
    return 1;
  }
}
