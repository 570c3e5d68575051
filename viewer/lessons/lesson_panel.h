// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <vector>

#include "lessons/lesson.h"

class QAction;
class QComboBox;
class QLabel;
class QLayout;
class QMenu;
class QTextBrowser;

namespace transillum::viewer {

/// The list of lessons, and one page of the current lesson with buttons to the previous and next.
class LessonPanel : public QWidget {
  Q_OBJECT

 public:
  explicit LessonPanel(std::vector<Lesson> lessons, QWidget* parent = nullptr);

  void add_to(QMenu& menu);
  /// Inserts a lesson, read from a file, at the top of the list.
  void add(Lesson lesson);
  const std::vector<Lesson>& lessons() const { return lessons_; }

  /// Counted from 0; -1: no lesson.
  int lesson() const { return lesson_; }
  int page() const { return page_; }
  void show_page(int lesson, int page);
  /// To be called after the application's font has changed.
  void refresh() { show_state(); }

 signals:
  /// The window is to show `state`, that of the new page.
  void page_shown(const transillum::viewer::ViewState& state);
  void open_clicked();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void make_page();
  void make_actions();
  QLayout* make_buttons();
  void fill_list();
  /// Turns pages, past the last (first) page to the next (previous) lesson.
  void turn(int pages);
  int pages_of(int lesson) const;
  void show_state();

  std::vector<Lesson> lessons_;
  int lesson_ = -1, page_ = 0;
  QComboBox* list_;
  QLabel *title_, *page_number_;
  QTextBrowser* text_;
  QAction *previous_, *next_, *again_, *open_;
};

}  // namespace transillum::viewer
