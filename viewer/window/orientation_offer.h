// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>

#include "support/request_worker.h"
#include "window/window_parts.h"

class QPushButton;

namespace transillum {
struct OrientationPlan;
}

namespace transillum::viewer {

class ViewStateApplier;

/// The bar above a scene in which more than a tenth of the surface that light meets is the back of
/// faces. It shows which faces would be turned, and turns them.
class OrientationOffer : public QObject {
  Q_OBJECT

 public:
  /// The references must outlive this object.
  OrientationOffer(const WindowFrame& frame, SettingsPanel& settings, ViewStateApplier& applier);

 private:
  enum class State { none, offered, planning, previewed, nothing_to_turn };
  struct PlanRequest {
    std::shared_ptr<const LoadedScene> loaded;
  };

  void offer();
  void plan();
  void preview(const PlanRequest& request, const OrientationPlan& plan);
  void turn();
  void cancel();
  void show(State state, const QString& text, const QString& details = {});

  WindowFrame frame_;
  SettingsPanel& settings_;
  ViewStateApplier& applier_;
  QPushButton *preview_, *turn_, *cancel_;
  State state_ = State::none;
  RequestWorker<PlanRequest> planner_;
};

}  // namespace transillum::viewer
