// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QDialog>
#include <vector>

#include "window/files/film_plan.h"

class QComboBox;
class QDoubleSpinBox;

namespace transillum::viewer {

/// Asks what a film shows.
class FilmDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param plan  the first values of the fields; its size is the size of the window
  /// @param has_map  whether a direction can be stepped through
  /// @param missing  changes that cannot be filmed now
  FilmDialog(const FilmPlan& plan, bool has_map, const std::vector<FilmPlan::Over>& missing,
             QWidget* parent = nullptr);

  FilmPlan plan() const;

 private:
  QComboBox *show_, *over_, *size_;
  QDoubleSpinBox* speed_;
};

}  // namespace transillum::viewer
