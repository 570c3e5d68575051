// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QDialog>
#include <QString>
#include <memory>

#include "model/requests/unlit_view.h"
#include "state/camera_views.h"
#include "support/newest_result.h"
#include "transillum/files.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;

namespace transillum::viewer {

/// Asks how a result is exported for programs that show its colors, with a preview of the picture
/// that they will show.
class ColorExportDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param view  of the preview
  /// @param up  the vertical of the scene
  ColorExportDialog(std::shared_ptr<const SolverSnapshot> snapshot, const ViewPoint& view,
                    const Vec3& up, QWidget* parent = nullptr);

  /// The ending of the chosen format, such as ".glb".
  QString ending() const;
  DisplayOptions display() const;
  /// Whether the preview has been drawn.
  bool ready() const { return view_ != nullptr; }

 private:
  QLabel* make_picture();
  void make_fields(const Vec3& up);
  double exposure() const;
  void show_state();

  std::shared_ptr<const UnlitView> view_;  ///< null until it has been computed
  QLabel *picture_, *note_;
  QComboBox *format_, *up_;
  QCheckBox *automatic_, *light_map_;
  QDoubleSpinBox* exposure_;
  NewestResult<UnlitRequest, UnlitView> preview_;
};

}  // namespace transillum::viewer
