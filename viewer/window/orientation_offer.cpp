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

OrientationOffer::OrientationOffer(const WindowParts& parts, ViewStateApplier& applier)
    : QObject(&parts.window),
      parts_(parts),
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
                  if (request.loaded == parts_.scene.loaded()) {
                    offer();
                    parts_.notifier.show_failure(message);
                  }
                },
                Qt::QueuedConnection);
          }) {
  Banner* bar = parts_.page.orientation_bar();
  preview_ = bar->add_button("preview_turn", tr("Show what to turn"));
  turn_ = bar->add_button("turn_faces", tr("Turn them"));
  cancel_ = bar->add_button("cancel_turn", tr("Cancel"));
  connect(preview_, &QPushButton::clicked, this, &OrientationOffer::plan);
  connect(turn_, &QPushButton::clicked, this, &OrientationOffer::turn);
  connect(cancel_, &QPushButton::clicked, this, &OrientationOffer::cancel);
  connect(bar, &Banner::closed, this, [this] {
    planner_.clear();
    parts_.page.scene_view()->hide_turn();
    state_ = State::none;
  });
  connect(&parts_.scene, &OpenScene::scene_shown, this, &OrientationOffer::offer);
}

void OrientationOffer::offer() {
  planner_.clear();
  const auto loaded = parts_.scene.loaded();
  // Built-in scenes are as they are meant to be.
  const bool from_file = loaded->description && !loaded->description->files.empty();
  if (!from_file || loaded->back_share <= BackShare::worth_a_warning) {
    state_ = State::none;
    parts_.page.orientation_bar()->dismiss();
    return;
  }
  const QString percent = QString::number(std::lround(100 * loaded->back_share));
  if (parts_.scene.input().orient) {
    show(State::nothing_to_turn,
         tr("%1 % of what is seen is the back of a face, also after turning faces. "
            "Two-sided faces, in the settings, light and receive on both sides.")
             .arg(percent));
    return;
  }
  show(State::offered,
       tr("%1 % of what is seen is the back of a face, which neither emits nor reflects.")
           .arg(percent));
}

void OrientationOffer::plan() {
  show(State::planning, tr("Finding the faces to turn…"));
  planner_.request({parts_.scene.loaded()});
}

void OrientationOffer::preview(const PlanRequest& request, const OrientationPlan& plan) {
  if (request.loaded != parts_.scene.loaded() || state_ != State::planning) {
    return;  // canceled, or another scene has been opened since
  }
  if (!plan.changes()) {
    show(State::nothing_to_turn,
         tr("No faces to turn were found. Two-sided faces, in the settings, light and receive on "
            "both sides."),
         sentences_of(plan.report));
    return;
  }
  parts_.page.scene_view()->preview_turn(plan);
  show(State::previewed, changes_text(plan.report), sentences_of(plan.report));
}

void OrientationOffer::turn() {
  if (!parts_.guard.may_lose(&parts_.window, tr("Turn them"))) {
    return;
  }
  RunOptions options{parts_.settings.solve_options(), parts_.scene.options(), parts_.scene.input(),
                     parts_.settings.refinement()};
  options.input.orient = true;
  applier_.open_again(options);
}

void OrientationOffer::cancel() {
  planner_.clear();
  parts_.page.scene_view()->hide_turn();
  offer();
}

void OrientationOffer::show(State state, const QString& text, const QString& details) {
  state_ = state;
  preview_->setVisible(state == State::offered);
  turn_->setVisible(state == State::previewed);
  cancel_->setVisible(state == State::previewed || state == State::planning);
  parts_.page.orientation_bar()->show_message(Banner::Kind::offer, text, details);
}

}  // namespace transillum::viewer
