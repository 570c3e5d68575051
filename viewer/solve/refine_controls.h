// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "model/run_options.h"

class QComboBox;
class QLineEdit;
class QSpinBox;

namespace transillum::viewer {

/// Controls of rounds of refinement: the criterion, and below it, if there is one, the limits.
class RefineControls : public QWidget {
  Q_OBJECT

 public:
  explicit RefineControls(QWidget* parent = nullptr);

  RefineChoice choice() const;
  void set_choice(const RefineChoice& choice);
  /// Sets what the solve allows.
  /// @param available  whether patches may be divided: not where a result file is shown
  /// @param total  whether a total error takes the place of rounds; the number of patches limits it
  void set_available(bool available, bool total);
  /// The choice in some words.
  QString state() const;

 signals:
  void changed();

 private:
  void show_limits();

  bool available_ = true, total_ = false;
  RefineChoice base_;  ///< with all digits of what the controls show
  QComboBox* by_;      ///< none, then the values of RefineBy
  QSpinBox* patches_;
  QLineEdit* until_;  ///< percent; empty without a limit
};

}  // namespace transillum::viewer
