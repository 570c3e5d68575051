// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/start_control.h"

#include <QFileInfo>
#include <utility>

#include "lessons/lesson_panel.h"
#include "scene/scene_page.h"
#include "scene/start_page.h"
#include "transillum/at.h"
#include "widgets/full_screen.h"
#include "window/base/dock_layouts.h"
#include "window/files/file_actions.h"
#include "window/files/thumbnails.h"

namespace transillum::viewer {

StartControl::StartControl(const WindowFrame& frame, DockLayouts& docks, FileActions& files,
                           LessonPanel& lessons, const FullScreen& full_screen,
                           const Thumbnails* thumbnails)
    : QObject(&frame.window),
      frame_(frame),
      docks_(docks),
      files_(files),
      lessons_(lessons),
      full_screen_(full_screen),
      thumbnails_(thumbnails) {
  ScenePage& page = frame_.page;
  StartPage& start = *page.start();
  start.set_choices(
      {docks_.action(Layout::teach), docks_.action(Layout::inspect), docks_.action(Layout::debug)});
  fill_lessons();
  fill_recent();
  connect(&page, &ScenePage::start_shown, this, &StartControl::show_panels);
  connect(&docks_, &DockLayouts::uncovered, &page, &ScenePage::show_scene);
  connect(&docks_, &DockLayouts::chosen, this, &StartControl::begin);
  connect(&start, &StartPage::open_clicked, files_.open_action(), &QAction::trigger);
  connect(&start, &StartPage::lesson_clicked, this,
          [this](int lesson) { lessons_.continue_lesson(lesson); });
  connect(&start, &StartPage::built_in_clicked, this, [this](const QString& name) {
    leaves_teaching_ = true;
    files_.open_scene(name);
  });
  connect(&start, &StartPage::recent_clicked, this, [this](const QString& path) {
    leaves_teaching_ = true;
    files_.try_open(path);
  });
  connect(&frame_.state.runner, &SolveRunner::failed, this, [this] {
    if (!frame_.state.scene.loaded()) {
      frame_.page.show_start();
    }
  });
}

void StartControl::fill_lessons() {
  QVector<StartPage::LessonEntry> entries;
  const auto& lessons = lessons_.lessons();
  for (int k = 0; k < std::ssize(lessons); ++k) {
    const Lesson& lesson = at(lessons, k);
    const QString number = QString::fromStdString(lesson.file).section('-', 0, 0);
    QPixmap picture;
    if (lesson.built_in) {
      picture.load(QStringLiteral(":/pictures/card-%1.png").arg(number));
    }
    const int pages = static_cast<int>(lesson.pages.size());
    entries.push_back({QString::fromStdString(lesson.title), lesson.minutes, picture,
                       first_hour_of(lessons, k).place, 1.0 * lessons_.pages_seen(k) / pages});
  }
  const FirstHour hour = first_hour_of(lessons, 0);
  frame_.page.start()->set_lessons(
      entries,
      tr("The first hour: %1 lessons in order, %2 minutes").arg(hour.lessons).arg(hour.minutes));
}

void StartControl::fill_recent() {
  constexpr int most_files = 7;
  QVector<StartPage::RecentFile> recent;
  for (const QString& path : files_.recent()) {
    if (QFileInfo::exists(path) && recent.size() < most_files) {
      recent.push_back({path, thumbnails_ ? thumbnails_->picture_of(path) : QPixmap()});
    }
  }
  frame_.page.start()->set_recent(recent);
}

void StartControl::show_panels(bool start_shown) {
  if (start_shown && full_screen_.action()->isChecked()) {
    full_screen_.action()->trigger();
  }
  if (start_shown) {
    fill_lessons();
    fill_recent();
  }
  docks_.cover(start_shown);
  const bool leaves = !start_shown && std::exchange(leaves_teaching_, false);
  if (leaves && docks_.current() == Layout::teach) {
    docks_.choose(Layout::inspect);
  }
}

void StartControl::begin(Layout layout) {
  if (frame_.state.scene.loaded() || frame_.state.scene.is_opening()) {
    return;
  }
  switch (layout) {
    case Layout::teach:
      lessons_.show_page(0, 0);
      break;
    case Layout::inspect:
      files_.open_scene(QStringLiteral("cornell-box"));
      break;
    case Layout::debug:
      files_.set_divides(false);  // few polygons are easier to follow
      files_.open_scene(QStringLiteral("cornell-box"));
      files_.set_divides(true);
      break;
  }
}

}  // namespace transillum::viewer
