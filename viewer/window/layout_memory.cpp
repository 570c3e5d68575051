// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/layout_memory.h"

#include <QAction>
#include <QMainWindow>
#include <QScreen>
#include <QSettings>
#include <QTimer>

#include "lessons/lesson_panel.h"
#include "scene/scene_page.h"
#include "scene/sharp_view.h"
#include "support/checked_bytes.h"
#include "window/base/dock_layouts.h"
#include "window/base/notifier.h"
#include "window/files/file_actions.h"
#include "window/menus/appearance_actions.h"

namespace transillum::viewer {

namespace {

// Title bar and borders are known only once the window is on the screen.
constexpr QSize room_for_frame(16, 48);

}  // namespace

LayoutMemory::LayoutMemory(const WindowFrame& frame, DockLayouts& docks,
                           AppearanceActions& appearance, FileActions& files, LessonPanel& lessons)
    : QObject(&frame.window),
      frame_(frame),
      docks_(docks),
      appearance_(appearance),
      files_(files),
      lessons_(lessons) {}

void LayoutMemory::fit_into_screen(const QSize& wanted) {
  frame_.window.resize(wanted.boundedTo(frame_.window.screen()->availableSize() - room_for_frame));
}

/// Panels that are laid out for the first time can make the window larger than the screen.
void LayoutMemory::fit_once_shown() {
  connect(&frame_.state.scene, &OpenScene::scene_shown, this, [this] {
    QTimer::singleShot(0, this, [this] {
      const QMainWindow& window = frame_.window;
      const QSize room = window.screen()->availableSize();
      const bool fits = window.frameSize().boundedTo(room) == window.frameSize();
      if (!fits && !window.isMaximized() && !window.isFullScreen()) {
        fit_into_screen(window.size());
      }
    });
  });
}

void LayoutMemory::restore() {
  fit_into_screen(frame_.window.size());
  fit_once_shown();
  QSettings settings;
  frame_.state.breakpoints.load(settings);
  frame_.page.turntable_action()->setChecked(settings.value("scene/turntable", false).toBool());
  frame_.page.sharp()->action()->setChecked(settings.value("scene/sharp", true).toBool());
  files_.load(settings);
  lessons_.load(settings);
  const auto geometry = without_checksum(settings.value("window/geometry").toByteArray());
  if (geometry) {
    frame_.window.restoreGeometry(*geometry);
  }
  // The saved state may not fit after an update of Qt or of the docks.
  const bool fits = docks_.load(settings);
  if (!fits) {
    docks_.arrange(Layout::inspect);
  }
  appearance_.load(settings);  // may show parts of the layout
  if (!fits && settings.contains("window/state")) {
    // The message is shown later: opening the first scene dismisses messages.
    QTimer::singleShot(0, this, [this] {
      frame_.notifier.show_warnings(
          {tr("The saved layout is damaged, or of another version; the usual one is used")});
    });
  }
}

void LayoutMemory::save() {
  QSettings settings;
  settings.setValue("window/geometry", with_checksum(frame_.window.saveGeometry()));
  docks_.save(settings);
  frame_.state.breakpoints.save(settings);
  appearance_.save(settings);
  settings.setValue("scene/turntable", frame_.page.turntable_action()->isChecked());
  settings.setValue("scene/sharp", frame_.page.sharp()->action()->isChecked());
  files_.save(settings);
  lessons_.save(settings);
}

}  // namespace transillum::viewer
