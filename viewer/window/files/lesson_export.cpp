// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Export of a lesson: the window itself shows each page, so that the file has what a class saw. The
// answers to questions are computed on a worker thread.
#include "window/files/lesson_export.h"

#include <QAction>
#include <QBuffer>
#include <QDockWidget>
#include <QMainWindow>
#include <QProgressDialog>
#include <QPushButton>
#include <QSaveFile>
#include <QScrollArea>
#include <set>
#include <utility>

#include "lessons/lesson_panel.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "support/failure_text.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/dialogs.h"
#include "window/base/notifier.h"

namespace transillum::viewer {

namespace {

constexpr int poll_ms = 40;
constexpr int quiet_polls = 3;  // the window may be between two requests
constexpr int widest_picture = 900;

/// The picture of a widget as PNG, without the buttons over it.
QByteArray png_of(QWidget& widget) {
  QList<QPushButton*> over;
  for (QPushButton* button :
       widget.findChildren<QPushButton*>(QString(), Qt::FindDirectChildrenOnly)) {
    if (!widget.layout() && button->isVisible()) {
      button->hide();
      over << button;
    }
  }
  QImage picture = widget.grab().toImage();
  for (QPushButton* button : over) {
    button->show();
  }
  if (picture.width() > widest_picture) {
    picture = picture.scaledToWidth(widest_picture, Qt::SmoothTransformation);
  }
  QByteArray png;
  QBuffer buffer(&png);
  buffer.open(QIODevice::WriteOnly);
  picture.save(&buffer, "PNG");
  return png;
}

}  // namespace

LessonExport::LessonExport(const WindowFrame& frame, LessonPanel& lessons,
                           std::function<bool()> settled)
    : QObject(&frame.window),
      frame_(frame),
      lessons_(lessons),
      settled_(std::move(settled)),
      action_(new QAction(tr("Export the lesson…"), this)),
      solver_(*this, [this](const QuestionRequest&, const std::shared_ptr<const Solved>& solved,
                            const QString& error) {
        if (solved) {
          pages_.back().solved = *solved;
          show_next();
          return;
        }
        end();
        fail(error);
      }) {
  action_->setObjectName("lesson_export");
  action_->setToolTip(tr("Write text, pictures and maps of all pages as one HTML file"));
  poll_.setInterval(poll_ms);
  connect(&poll_, &QTimer::timeout, this, &LessonExport::take_when_settled);
  connect(action_, &QAction::triggered, this, &LessonExport::choose);
  const auto enable = [this] {
    enable_if(*action_, lessons_.lesson() >= 0, tr("No lesson is open"));
  };
  connect(&lessons_, &LessonPanel::page_shown, this, enable);
  enable();
}

void LessonExport::choose() {
  if (busy() || lessons_.lesson() < 0) {
    frame_.notifier.show_failure(tr("Choose the lesson to export first."));
    return;
  }
  const QString path = ask_where_to_write(&frame_.window, tr("Export the lesson"),
                                          tr("Web pages (*.html)"), QStringLiteral("lesson.html"));
  if (!path.isEmpty()) {
    export_to(path);
  }
}

void LessonExport::export_to(const QString& path) {
  path_ = path;
  lesson_ = lessons_.lesson();
  page_before_ = lessons_.page();
  pages_.clear();
  const auto count = static_cast<int>(at(lessons_.lessons(), lesson_).pages.size());
  progress_ =
      named("lesson_export_progress", new QProgressDialog(tr("Showing and taking the pages…"),
                                                          tr("Cancel"), 0, count, &frame_.window));
  progress_->setWindowTitle(tr("Export the lesson"));
  progress_->setMinimumDuration(0);
  connect(progress_, &QProgressDialog::canceled, this, [this] {
    end();
    emit failed(tr("The export was canceled."));
  });
  progress_->setValue(0);
  show_next();
}

void LessonExport::show_next() {
  const auto& pages = at(lessons_.lessons(), lesson_).pages;
  if (pages_.size() == pages.size()) {
    finish();
    return;
  }
  progress_->setValue(static_cast<int>(pages_.size()));
  quiet_ = 0;
  lessons_.show_page(lesson_, static_cast<int>(pages_.size()));
  poll_.start();
}

void LessonExport::take_when_settled() {
  quiet_ = settled_() ? quiet_ + 1 : 0;
  if (quiet_ >= quiet_polls) {
    poll_.stop();
    take_page();
  }
}

std::vector<PanelPicture> LessonExport::panels_of(const Lesson::Page& page) const {
  // The page has maps as vectors, and the others are about the window.
  const std::set<std::string> omitted{"map", "section", "timeline", "lesson", "move", "event"};
  std::vector<PanelPicture> pictures;
  for (const std::string& panel : page.state.panels) {
    const auto* dock =
        frame_.window.findChild<QDockWidget*>(QString::fromStdString(panel + "_dock"));
    if (!dock || omitted.contains(panel)) {
      continue;
    }
    QWidget* shown = dock->widget();
    if (const auto* scrolling = qobject_cast<QScrollArea*>(shown)) {
      shown = scrolling->widget();  // all of it
    }
    pictures.push_back({dock->windowTitle(), png_of(*shown)});
  }
  return pictures;
}

void LessonExport::take_page() {
  ShownPage shown;
  shown.page = at(lessons_.lessons(), lesson_).pages[pages_.size()];
  shown.picture = png_of(*frame_.page.scene_view());
  shown.panels = panels_of(shown.page);
  if (shown.page.state.focus && frame_.state.focus.map()) {
    shown.map = frame_.state.focus.map();
    const Focus& focus = frame_.state.focus;
    shown.whole = !focus.at_step();
    shown.step = {focus.picture_step(), shown.whole ? Phase::after : focus.phase(),
                  shown.page.state.labels};
    shown.patch_colors = frame_.state.colors.patch_colors();
  }
  pages_.push_back(std::move(shown));
  const auto& question = pages_.back().page.question;
  if (!question || !frame_.state.scene.loaded()) {
    show_next();
    return;
  }
  solver_.request({frame_.state.scene.loaded(), *question});
}

void LessonExport::finish() {
  const QString path = path_;
  const QString title = QString::fromStdString(at(lessons_.lessons(), lesson_).title);
  const QByteArray html = lesson_html(title, pages_);
  end();
  QSaveFile file(path);
  if (!file.open(QIODevice::WriteOnly) || file.write(html) < 0 || !file.commit()) {
    fail(path + ": " + file.errorString());
    return;
  }
  frame_.notifier.show_written(path);
  emit written(path);
}

void LessonExport::fail(const QString& message) {
  frame_.notifier.show_failure(message);
  emit failed(message);
}

void LessonExport::end() {
  solver_.clear();
  poll_.stop();
  pages_.clear();
  path_.clear();
  progress_->disconnect(this);
  progress_->close();
  progress_->deleteLater();
  progress_ = nullptr;
  lessons_.show_page(lesson_, page_before_);
}

}  // namespace transillum::viewer
