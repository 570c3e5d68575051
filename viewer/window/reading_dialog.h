// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QDialog>

#include "model/run_options.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;

namespace transillum::viewer {

/// Asks how the file of a scene is read: the unit of its lengths, orientation and joining of faces.
class ReadingDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param input  shown at first; values that the dialog does not ask for stay as they are
  ReadingDialog(const QString& file, const SceneInput& input, QWidget* parent = nullptr);

  SceneInput input() const;

 private:
  void fill_units();
  void show_scale();

  SceneInput base_;
  QComboBox *unit_, *orient_, *join_;
  QDoubleSpinBox* scale_;
  QCheckBox* photometric_;
};

}  // namespace transillum::viewer
