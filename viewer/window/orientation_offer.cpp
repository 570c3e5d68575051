// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/orientation_offer.h"

#include <QMainWindow>
#include <QMetaObject>
#include <QPushButton>
#include <QStringList>
#include <cmath>

#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "solve/settings_panel.h"
#include "support/number_text.h"
#include "transillum/orientation.h"
#include "widgets/banner.h"
#include "window/notifier.h"
#include "window/view_state_applier.h"
#include "window/work_guard.h"

namespace transillum::viewer {

namespace {

QString changes_text(const OrientationReport& report) {
  const auto count = [](std::int64_t number) { return QString::number(number); };
  QStringList parts;
  if (report.faces_turned > 0) {
    parts << OrientationOffer::tr("%1 of %2 faces would be turned (orange)")
                 .arg(count(report.faces_turned), count(report.faces));
  }
  if (report.faces_two_sided > 0) {
    parts << OrientationOffer::tr("%1 would become two-sided (blue)")
                 .arg(count(report.faces_two_sided));
  }
  return parts.join(OrientationOffer::tr(", ")) + '.';
}

QString sentences_of(const OrientationReport& report) {
  QStringList lines;
  for (const std::string& sentence : report.sentences) {
    lines << QString::fromStdString(sentence);
  }
  return lines.join('\n');
}

}  // namespace

OrientationOffer::OrientationOffer(const WindowFrame& frame, SettingsPanel& settings,
                                   ViewStateApplier& applier)
    : QObject(&frame.window),
      frame_(frame),
      settings_(settings),
      applier_(applier),
      planner_(
          [this](const PlanRequest& request, const Cancellation& cancellation) {
            const OrientationPlan plan =
                plan_orientation(*request.loaded->description, 0, cancellation);
            QMetaObject::invokeMethod(
                this, [this, request, plan] { preview(request, plan); }, Qt::QueuedConnection);
          },
          [this](const PlanRequest& request, const QString& message) {
            QMetaObject::invokeMethod(
                this,
                [this, request, message] {
                  if (request.loaded == frame_.state.scene.loaded()) {
                    offer();
                    frame_.notifier.show_failure(message);
                  }
                },
                Qt::QueuedConnection);
          }) {
  Banner* bar = frame_.page.orientation_bar();
  preview_ = bar->add_button("preview_turn", tr("Show what to turn"));
  turn_ = bar->add_button("turn_faces", tr("Turn them"));
  cancel_ = bar->add_button("cancel_turn", tr("Cancel"));
  connect(preview_, &QPushButton::clicked, this, &OrientationOffer::plan);
  connect(turn_, &QPushButton::clicked, this, &OrientationOffer::turn);
  connect(cancel_, &QPushButton::clicked, this, &OrientationOffer::cancel);
  connect(bar, &Banner::closed, this, [this] {
    planner_.clear();
    frame_.page.scene_view()->hide_turn();
    state_ = State::none;
  });
  connect(&frame_.state.scene, &OpenScene::scene_shown, this, &OrientationOffer::offer);
}

void OrientationOffer::offer() {
  planner_.clear();
  const auto loaded = frame_.state.scene.loaded();
  // Built-in scenes are as they are meant to be.
  const bool from_file = loaded->description && !loaded->description->files.empty();
  if (!from_file || loaded->back_share <= BackShare::worth_a_warning) {
    state_ = State::none;
    frame_.page.orientation_bar()->dismiss();
    return;
  }
  const QString percent = QString::number(std::lround(100 * loaded->back_share));
  if (frame_.state.scene.input().orient) {
    show(State::nothing_to_turn,
         tr("%1 % of the surface that light meets is the back of faces, even after turning faces. "
            "Two-sided faces, in the settings, emit and receive on both sides.")
             .arg(percent));
    return;
  }
  show(State::offered,
       tr("%1 % of the surface that light meets is the back of faces, which neither emits nor "
          "reflects.")
           .arg(percent));
}

void OrientationOffer::plan() {
  show(State::planning, tr("Finding the faces to turn…"));
  planner_.request({frame_.state.scene.loaded()});
}

void OrientationOffer::preview(const PlanRequest& request, const OrientationPlan& plan) {
  if (request.loaded != frame_.state.scene.loaded() || state_ != State::planning) {
    return;  // canceled, or another scene has been opened since
  }
  if (!plan.changes()) {
    show(State::nothing_to_turn,
         tr("No faces to turn were found. Two-sided faces, in the settings, emit and receive on "
            "both sides."),
         sentences_of(plan.report));
    return;
  }
  frame_.page.scene_view()->preview_turn(plan);
  show(State::previewed, changes_text(plan.report), sentences_of(plan.report));
}

void OrientationOffer::turn() {
  if (!frame_.guard.may_lose(&frame_.window, tr("Turn them"))) {
    return;
  }
  RunOptions options{settings_.solve_options(), frame_.state.scene.options(),
                     frame_.state.scene.input(), settings_.refinement()};
  options.input.orient = true;
  applier_.open_again(options);
}

void OrientationOffer::cancel() {
  planner_.clear();
  frame_.page.scene_view()->hide_turn();
  offer();
}

void OrientationOffer::show(State state, const QString& text, const QString& details) {
  state_ = state;
  preview_->setVisible(state == State::offered);
  turn_->setVisible(state == State::previewed);
  cancel_->setVisible(state == State::previewed || state == State::planning);
  frame_.page.orientation_bar()->show_message(Banner::Kind::offer, text, details);
}

}  // namespace transillum::viewer
