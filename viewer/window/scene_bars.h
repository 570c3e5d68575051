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
#include "transillum/run_options.h"
#include "transillum/solids.h"
#include "window/base/window_views.h"

class QMenu;
class QPushButton;

namespace transillum::viewer {

class Banner;
class MaterialPanel;
class ViewStateApplier;
struct MarkedFaces;

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

/// A bar that offers to change the faces of a scene: it shows which, and changes them.
class ChangeOffer : public QObject {
  Q_OBJECT

 protected:
  /// The texts of a bar, and the names of its buttons.
  struct Texts {
    const char *preview_name, *preview, *change_name, *change, *cancel_name, *finding;
  };
  /// The references must outlive this object. The constructor of each derived class calls listen().
  ChangeOffer(const WindowFrame& frame, SettingsPanel& settings, ViewStateApplier& applier,
              Banner& bar, const Texts& texts);
  void listen();

  /// Shows the offer for the open scene, or nothing.
  virtual void offer() = 0;
  virtual void request_plan() = 0;
  virtual void forget_plan() = 0;
  virtual void set_change(SceneInput& input) const = 0;

  enum class State { none, offered, planning, previewed, nothing_to_change };
  void show(State state, const QString& text, const QString& details = {});
  void preview(const MarkedFaces& faces, const QString& text, const QString& details);
  /// Whether the scene is of a file: built-in scenes are as they are meant to be.
  bool is_of_file() const;

  WindowFrame frame_;
  Banner& bar_;

 private:
  void plan();
  void change();
  void leave();

  SettingsPanel& settings_;
  ViewStateApplier& applier_;
  QString finding_;
  State state_ = State::none;
  QPushButton *preview_, *change_, *cancel_;
};

/// The bar above a scene in which more than a tenth of the surface that light meets is the back of
/// faces: they can be turned.
class OrientationOffer : public ChangeOffer {
  Q_OBJECT

 public:
  OrientationOffer(const WindowFrame& frame, SettingsPanel& settings, ViewStateApplier& applier);

 private:
  void offer() override;
  void request_plan() override { planner_.request(frame_.state.scene.loaded()); }
  void forget_plan() override { planner_.clear(); }
  void set_change(SceneInput& input) const override { input.orient = true; }
  void show_plan(const OrientationPlan& plan);

  NewestResult<std::shared_ptr<const LoadedScene>, OrientationPlan> planner_;
};

/// The bar above a scene of which more than a twentieth lies inside or against other closed parts:
/// they can be united.
class SolidsOffer : public ChangeOffer {
  Q_OBJECT

 public:
  SolidsOffer(const WindowFrame& frame, SettingsPanel& settings, ViewStateApplier& applier);

 private:
  void offer() override;
  void request_plan() override { planner_.request(frame_.state.scene.loaded()); }
  void forget_plan() override { planner_.clear(); }
  void set_change(SceneInput& input) const override { input.unite_solids = true; }
  void show_plan(const SolidsReport& report);

  double share_ = 0;  ///< result of share_inside_solids() for the open scene
  NewestResult<std::shared_ptr<const LoadedScene>, double> measurement_;
  NewestResult<std::shared_ptr<const LoadedScene>, SolidsReport> planner_;
};

}  // namespace transillum::viewer
