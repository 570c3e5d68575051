// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QElapsedTimer>
#include <QFrame>
#include <QTimer>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "lessons/question_solver.h"
#include "lessons/tally.h"
#include "model/snapshot.h"
#include "state/focus.h"
#include "state/map_sketch.h"
#include "state/selection.h"

class QAction;
class QButtonGroup;
class QGridLayout;
class QLabel;
class QLineEdit;
class QProgressBar;
class QToolButton;
class QUndoStack;
class QVBoxLayout;

namespace transillum::viewer {

class LogChart;

/// The question of a lesson's page: takes a prediction, and on Reveal shows what the program
/// computes, and the tally of the class.
class QuestionBox : public QFrame {
  Q_OBJECT

 public:
  /// The open scene if the page is about it; else null.
  using SceneSource = std::function<std::shared_ptr<const LoadedScene>(const ViewState& page)>;

  QuestionBox(Selection& selection, Focus& focus, QWidget* parent = nullptr);

  void set_scene_source(SceneSource source) { scene_ = std::move(source); }
  /// Counting and resetting can be undone there. If it is null, they cannot be undone.
  void set_undo_stack(QUndoStack* undo) { undo_ = undo; }
  /// Shows the question of a page; hides the box if it has none. The prediction, and what is
  /// revealed, are dropped.
  /// @param tally of the lesson; must outlive its use here
  void show_page(std::shared_ptr<const Lesson::Page> page, int number,
                 std::shared_ptr<Tally> tally);

  /// When the run of the page is over, the answer is computed while the page is read. Turning the
  /// page cancels that.
  void show_run(RunState run);
  /// To be called after a change of the tally.
  void refresh() { show_state(); }
  /// To be called when another scene is opened: cancels the computation.
  void leave_scene();

  /// The font of the question and its answers; buttons keep theirs. To be called after a change of
  /// the appearance.
  void set_text_font(const QFont& font);
  /// Gives its parts their places now.
  void lay_out();

  /// Where a corner in the scene is asked for, takes the point in which a line of sight meets the
  /// plane of the patch asked about, whatever is in front of it. Far from the patch, says so.
  void take_ray(const Vec3& begin, const Vec3& direction);

  /// Reveal, count and reset, for a menu.
  std::vector<QAction*> actions() const { return {reveal_, count_, reset_}; }
  const GivenAnswer& answer() const { return answer_; }
  /// The argument of the last values_hidden().
  bool hides_values() const { return hides_values_; }
  /// Whether the answer has been computed, for Reveal to show at once.
  bool ready() const { return computed_ != nullptr; }
  /// The result of Reveal; null before Reveal.
  const Solved* solved() const { return solved_ ? &*solved_ : nullptr; }
  /// The answer to a question for a patch, after Reveal.
  std::optional<PatchId> right_patch() const;

 signals:
  /// The answer is shown; the window is to show `state`.
  void revealed(const transillum::viewer::ViewState& state);
  void then_shown();  ///< solved() has changed: Question::then is to be shown or hidden
  void sketched(const transillum::viewer::MapSketch& sketch);
  void surface_sketched(const transillum::viewer::SceneSketch& sketch);
  /// The values of the step shown are to be hidden, since the question asks for one of them, or to
  /// be shown again.
  void values_hidden(bool hidden);
  void failed(const QString& message);

 private:
  void make_actions();
  void make_widgets();
  QLayout* make_buttons();
  QToolButton* text_button(QAction& action);
  void fill_answers();
  void add_choice(int k);
  void add_number();
  void add_drawing();
  void add_chart();
  void show_chart();
  QString given_text() const;
  void take_patch(PatchId patch);
  void take_point();
  void drop_point();
  void set_answer(GivenAnswer answer);
  void clear_answer();
  void reveal();
  /// Nothing happens if it has begun, or if the scene of the page is not open.
  void compute();
  void cancel();
  void show_computed();
  void show_progress();
  void ask_again();
  void show_solved(const Solved& solved);
  void select_right();
  void count();
  void set_counts(const AnswerCounts& counts, const QString& what);
  std::string label_of_answer() const;
  QString label_of(const Question::Choice& choice) const;
  QString tally_text(const AnswerCounts& counts) const;
  void show_state();
  void show_choices(const AnswerCounts& counts);
  void send_sketch();
  SceneSketch surface_sketch() const;

  Selection& selection_;
  Focus& focus_;
  SceneSource scene_;
  QUndoStack* undo_ = nullptr;
  std::shared_ptr<const Lesson::Page> page_;
  int page_number_ = 0;
  std::shared_ptr<Tally> tally_;
  GivenAnswer answer_;
  std::optional<Solved> solved_;

  QVBoxLayout* layout_;
  QLabel *ask_, *result_, *counts_;
  QWidget* answers_ = nullptr;
  QButtonGroup* choices_ = nullptr;
  /// The widgets beside the button of a choice; all but the text are shown after Reveal.
  struct ChoiceRow {
    QLabel *mark, *text, *value;
    QProgressBar* bar;
  };
  std::vector<ChoiceRow> rows_;
  QLineEdit* number_ = nullptr;
  QLabel* given_ = nullptr;  ///< the answer as text, of a patch or an area
  QToolButton* drop_ = nullptr;
  LogChart* chart_ = nullptr;
  QAction *reveal_, *count_, *reset_;
  bool hides_values_ = false;
  QProgressBar* progress_;
  QTimer progress_timer_;
  QElapsedTimer time_;                         ///< since the computation began
  std::shared_ptr<std::atomic<double>> done_;  ///< its finished fraction
  std::shared_ptr<const Solved> computed_;     ///< before and after Reveal
  QString failure_;                            ///< why the computation failed
  bool runs_ = false;                          ///< a run is loading or running
  bool waits_ = false;                         ///< Reveal waits for the computation
  QuestionSolver solver_;
};

}  // namespace transillum::viewer
