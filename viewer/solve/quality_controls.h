// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <array>

#include "transillum/solve_options.h"

class QComboBox;
class QGridLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace transillum::viewer {

/// How accurate a solve is to be: a draft of few passes, one of two usual accuracies, another
/// accuracy in percent, or a number of directions where no accuracy is asked for.
class QualityControls : public QWidget {
  Q_OBJECT

 public:
  explicit QualityControls(QWidget* parent = nullptr);

  /// Sets the directions and the goal of `solve`.
  void set_options(const SolveOptions& solve);
  /// Sets whether the accuracy is about the sum of all errors.
  void set_total(bool total);
  /// Writes directions, replicas of a draft and the goal; members of the goal that have no control
  /// stay.
  void write_to(SolveOptions& solve) const;
  /// Whether the accuracy limits the sum of all errors.
  bool total() const;
  int directions() const;
  /// The choice of the error that the accuracy limits, to be placed elsewhere.
  QComboBox* accuracy_of() const { return accuracy_of_; }
  /// The choices of one button each.
  enum class Choice { draft, normal, fine };
  static constexpr int choice_count = 3;
  /// These options with another choice.
  SolveOptions with(SolveOptions solve, Choice choice) const;
  /// Shows a text below the button of a choice: the time of such a solve. Empty for none.
  void show_cost(Choice choice, const QString& text);
  /// Shows what has an effect.
  /// @param takes_directions  whether the engine has directions
  /// @param conflict  why the accuracy cannot be combined with other settings; empty if it can
  void show_state(bool takes_directions, const QString& conflict);

 signals:
  void changed();
  /// A draft is chosen, which has no replicas.
  void draft_chosen();

 private:
  void add_buttons();
  QGridLayout* make_choices();
  void add_accuracy_of();
  void choose(double percent);
  void choose_draft();
  void choose_number();
  void mark_choice();
  AccuracyGoal goal() const;

  AccuracyGoal base_;  ///< with all digits of what the controls show
  QPushButton *draft_, *normal_, *fine_;
  std::array<QLabel*, choice_count> costs_;  ///< below these, in this order
  QPushButton* by_number_;  ///< pressed where neither a draft nor an accuracy is asked for
  QLineEdit* accuracy_;     ///< percent; empty if not asked for
  QLabel* percent_;         ///< its unit
  QComboBox* accuracy_of_;
  QSpinBox* directions_;
  QLabel* note_;
  QWidget* passes_;  ///< the row of by_number_ and directions_
};

}  // namespace transillum::viewer
