// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <vector>

#include "lessons/lesson.h"

class QAction;
class QComboBox;
class QLabel;
class QMenu;
class QTextBrowser;

namespace transillum::viewer {

/// The lessons there are, and the page of one: its text, and the ways to the next and the previous
/// page.
class LessonPanel : public QWidget {
  Q_OBJECT

 public:
  explicit LessonPanel(std::vector<Lesson> lessons, QWidget* parent = nullptr);

  void add_to(QMenu& menu);
  /// A lesson of a file: it comes first in the list from now on.
  void add(Lesson lesson);
  const std::vector<Lesson>& lessons() const { return lessons_; }

  /// Counted from 0; -1: no lesson.
  int lesson() const { return lesson_; }
  int page() const { return page_; }
  void show_page(int lesson, int page);
  /// Takes the application's font anew.
  void refresh() { show_state(); }

 signals:
  /// The window is to show what the page tells.
  void page_shown(const transillum::viewer::ViewState& state);
  void open_clicked();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void fill_list();
  /// Over the ends to the lessons beside.
  void turn(int pages);
  int pages_of(int lesson) const;
  void show_state();

  std::vector<Lesson> lessons_;
  int lesson_ = -1, page_ = 0;
  QComboBox* list_;
  QLabel *title_, *place_;
  QTextBrowser* text_;
  QAction *previous_, *next_, *again_, *open_;
};

}  // namespace transillum::viewer
