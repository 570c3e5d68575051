// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QDockWidget>
#include <QTableView>

#include "patches/patch_table.h"
#include "solved_window.h"
#include "state/camera_views.h"

namespace transillum::viewer::test {

/// A solved window with shortcuts to its parts.
struct Inspected : SolvedWindow {
  using SolvedWindow::SolvedWindow;

  template <class Widget>
  Widget* part(const char* name) const {
    return window->findChild<Widget*>(name);
  }
  bool raise(const char* name) const {
    auto* dock = part<QDockWidget>(name);
    dock->show();
    dock->raise();
    return wait_for([dock] { return dock->widget()->isVisible(); });
  }
  const PatchTable& table(const char* name) const {
    return *qobject_cast<PatchTable*>(part<QTableView>(name)->model());
  }
  bool has_form_factors() const {
    return wait_for([this] { return window->snapshot()->form_factors != nullptr; });
  }
  double fraction_in_own_color() const {
    return test::fraction_in_own_color(*scene_view, window->colors);
  }
};

inline double distance_of(const ViewPoint& a, const ViewPoint& b) { return norm(a.eye - b.eye); }

}  // namespace transillum::viewer::test
