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
  /// Whether the scene allows rounds; a result file does not.
  void set_available(bool available);

 signals:
  void changed();

 private:
  void show_limits();

  bool available_ = true;
  RefineChoice base_;  ///< with all digits of what the controls show
  QComboBox* by_;      ///< none, then the values of RefineBy
  QSpinBox* patches_;
  QLineEdit* until_;  ///< percent; empty without a limit
  QWidget* limits_;
};

}  // namespace transillum::viewer
