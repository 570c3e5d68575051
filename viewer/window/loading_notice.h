// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QTimer>

#include "window/window_parts.h"

namespace transillum::viewer {

/// The bar above the scene while another one is loaded. It shows the present task, its progress,
/// and a button that cancels. The title of the window names the scene that is loaded.
class LoadingNotice : public QObject {
  Q_OBJECT

 public:
  /// The objects that `parts` refers to must outlive this object.
  explicit LoadingNotice(const WindowFrame& frame);

 private:
  void show_state(RunState state);
  void show();

  WindowFrame frame_;
  QString phase_, title_before_, loading_title_;
  double share_ = -1;  ///< the arguments of SolveRunner::load_progressed()
  QTimer delay_;       ///< a scene that loads at once needs no bar
};

}  // namespace transillum::viewer
