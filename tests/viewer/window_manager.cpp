// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window_manager.h"

#include <QFileInfo>
#include <QProcessEnvironment>
#include <chrono>

#include "support/wait_until.h"

namespace transillum::viewer::test {

WindowManager::WindowManager(const QString& program) {
  const QString begun = folder_.filePath("begun");
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  for (const char* variable : {"XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME"}) {
    environment.insert(variable, folder_.path());
  }
  process_.setProcessEnvironment(environment);
  process_.setProcessChannelMode(QProcess::ForwardedChannels);
  // Openbox runs the command when it manages the display.
  process_.start(program, {"--startup", "touch " + begun});
  runs_ = process_.waitForStarted() &&
          testing::wait_until([&] { return QFileInfo::exists(begun); }, std::chrono::seconds(20));
}

WindowManager::~WindowManager() {
  process_.terminate();
  process_.waitForFinished();
}

}  // namespace transillum::viewer::test
