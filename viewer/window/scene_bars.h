// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// What the bars above the scene say and offer.
#pragma once

#include <QObject>
#include <QTimer>
#include <memory>
#include <optional>

#include "support/newest_result.h"
#include "transillum/orientation.h"
#include "window/base/window_views.h"

class QMenu;
class QPushButton;

namespace transillum::viewer {

class MaterialPanel;
class ViewStateApplier;

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

/// The bar above a scene in which nothing emits. It says so, lets the user make the selected face,
/// its material or its group emit, and opens the control of the sky. It is hidden once anything
/// emits.
class LightOffer : public QObject {
  Q_OBJECT

 public:
  /// The references must outlive this object.
  LightOffer(const WindowFrame& frame, DockLayouts& docks, SettingsPanel& settings,
             MaterialPanel& materials, ViewStateApplier& applier);

  /// Says that nothing is solved without light, also if the user has closed the bar.
  /// @param why SolveOptions::why_dark()
  void show_refusal(const QString& why);
  /// Gives a target an exitance, and shows its sliders.
  /// @param target  as in MaterialEdits
  void make_emit(const std::string& target);

 private:
  void update();
  /// Opens the control of the sky.
  void ask_for_sky();
  void fill_menu();
  void add_target(const QString& text, const std::string& target);

  WindowFrame frame_;
  DockLayouts& docks_;
  SettingsPanel& settings_;
  MaterialPanel& materials_;
  ViewStateApplier& applier_;
  QMenu* menu_;
  QPushButton* sky_;
  bool closed_ = false;  ///< by the user, for the open scene
  /// The snapshot before a solve that was refused; nothing where none was.
  std::optional<std::shared_ptr<const SolverSnapshot>> refused_;
  QString why_refused_;
};

/// The bar above a scene in which more than a tenth of the surface that light meets is the back of
/// faces. It shows which faces would be turned, and turns them.
class OrientationOffer : public QObject {
  Q_OBJECT

 public:
  /// The references must outlive this object.
  OrientationOffer(const WindowFrame& frame, SettingsPanel& settings, ViewStateApplier& applier);

 private:
  enum class State { none, offered, planning, previewed, nothing_to_turn };
  void offer();
  void plan();
  void preview(const OrientationPlan& plan);
  void turn();
  void cancel();
  void show(State state, const QString& text, const QString& details = {});

  WindowFrame frame_;
  SettingsPanel& settings_;
  ViewStateApplier& applier_;
  QPushButton *preview_, *turn_, *cancel_;
  State state_ = State::none;
  NewestResult<std::shared_ptr<const LoadedScene>, OrientationPlan> planner_;
};

}  // namespace transillum::viewer
