// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lessons/lesson.h"
#include "model/snapshot.h"
#include "state/map_sketch.h"

class QAction;
class QComboBox;
class QLabel;
class QLayout;
class QMenu;
class QSettings;
class QUndoStack;

namespace transillum::viewer {

class ControlWidget;
class Focus;
class MaterialEdits;
class PageText;
class QuestionBox;
class Selection;
class Tally;

/// The list of lessons, and one page of the current lesson with buttons to the previous and next.
class LessonPanel : public QWidget {
  Q_OBJECT

 public:
  /// The references must outlive the panel.
  LessonPanel(std::vector<Lesson> lessons, Selection& selection, Focus& focus, MaterialEdits& edits,
              QWidget* parent = nullptr);

  void add_to(QMenu& menu);
  /// Inserts a lesson, read from a file, at the top of the list.
  void add(Lesson lesson);
  const std::vector<Lesson>& lessons() const { return lessons_; }

  /// The number of the lesson, from 0; -1 if no lesson is shown.
  int lesson() const { return lesson_; }
  int page() const { return page_; }
  /// Nothing happens where the guard refuses.
  void show_page(int lesson, int page);
  /// Continues a lesson at the last page that was shown; begins it where all were.
  void continue_lesson(int lesson);
  /// How many pages of a lesson, from the first, have been turned to, also in earlier sessions.
  int pages_seen(int lesson) const;
  void save(QSettings& settings) const;
  void load(const QSettings& settings);
  /// The guard is asked before each page whether the window's state may be replaced.
  void set_guard(std::function<bool()> guard) { guard_ = std::move(guard); }
  QuestionBox& question() { return *question_; }
  /// Sets the folder for tallies of lessons that cannot be kept beside their file. If it is empty,
  /// tallies are not kept at all. To be called before the first page is shown.
  void set_tally_folder(const QString& folder) { tally_folder_ = folder; }
  /// Controls in the text show the options of the run.
  void show_snapshot(const SolverSnapshot& snapshot);
  /// To be called when another scene is opened: it does not have what the page names.
  void leave_scene();
  /// To be called after the application's font has changed.
  void refresh() { show_state(); }

 signals:
  /// The window is to show `state`, the state of the new page.
  void page_shown(const transillum::viewer::ViewState& state);
  void open_clicked();
  /// The window is to solve with another value of an option; PageControl::target and values.
  void option_chosen(const std::string& name, const std::string& value);
  /// The panel of errors is to show these runs.
  void errors_wanted(const transillum::viewer::ErrorRuns& runs);
  /// The scene and the map are to mark what the page names, and what the symbol under the pointer
  /// stands for.
  void callouts_shown(const std::vector<transillum::viewer::Callout>& callouts);
  /// The pointer is at a symbol of a formula, given by its first letter; empty if it is at no
  /// symbol.
  void symbol_pointed(const QString& symbol);
  /// @param panel  is to get most of the window; if empty, all panels get their usual sizes
  void enlarged(const std::string& panel);
  void sketched(const transillum::viewer::MapSketch& sketch);
  void failed(const QString& message);
  /// Passes QuestionBox::values_hidden() on.
  void values_hidden(bool hidden);

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
  /// The lesson before (-1) or after (1) the open one: within the first hour its next one, while
  /// there is one.
  int neighbor(int step) const;
  void show_state();
  QString list_of_lessons() const;
  /// "First hour, 1 of 5"; empty for other lessons.
  QString place_text(int lesson) const;
  /// Minutes and what the lesson needs; empty if its file does not say.
  QString needs_text(int lesson) const;
  void keep_tallies();
  void show_question();
  void point_at(const QString& link);
  void show_text(const Lesson::Page& page);
  /// The window's font, enlarged by `scale`.
  QFont text_font(double scale) const;
  void set_text_scale(double scale);
  void fit_text();
  bool is_cut_off() const;
  /// Scrolls the page on a projector. @returns false at its end
  bool scroll_on();
  std::shared_ptr<Tally> tally_of(const Lesson& lesson);
  /// Keeps a tally in its file, or in memory only, as keep_ says.
  void keep(Tally& tally, const Lesson& lesson);

  std::vector<Lesson> lessons_;
  QString tally_folder_;
  QString tally_failure_;                                  ///< to be reported
  std::map<std::string, std::shared_ptr<Tally>> tallies_;  ///< by the lesson's file
  int lesson_ = -1, page_ = 0;
  bool fits_text_ = false;                 ///< within fit_text()
  std::map<std::string, int> pages_seen_;  ///< by the lesson's file
  std::function<bool()> guard_ = [] { return true; };
  QComboBox* list_;
  QLabel *title_, *page_number_;
  Selection& selection_;
  Focus& focus_;
  MaterialEdits& edits_;
  PageText* text_;
  std::vector<ControlWidget*> controls_;  ///< in the text shown
  RunOptions options_;                    ///< options of the newest snapshot
  QuestionBox* question_;
  QAction *previous_, *next_, *again_, *open_, *keep_;
};

}  // namespace transillum::viewer
