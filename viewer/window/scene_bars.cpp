// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/scene_bars.h"

#include <QFileInfo>
#include <QMainWindow>
#include <QMenu>
#include <QPushButton>
#include <QStringList>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "patches/material_panel.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "scene/start_page.h"
#include "solve/settings_panel.h"
#include "support/number_text.h"
#include "transillum/orientation.h"
#include "widgets/banner.h"
#include "widgets/build.h"
#include "window/base/dock_layouts.h"
#include "window/base/notifier.h"
#include "window/base/open_scene.h"
#include "window/base/view_state_applier.h"

namespace transillum::viewer {

namespace {

/// Each bar that comes and goes moves the picture, and has it drawn again.
constexpr int delay_ms = 1000;

}  // namespace

LoadingNotice::LoadingNotice(const WindowFrame& frame) : QObject(&frame.window), frame_(frame) {
  delay_.setSingleShot(true);
  delay_.setInterval(delay_ms);
  QPushButton* cancel = frame_.page.loading_bar()->add_button("cancel_loading", tr("Cancel"));
  cancel->setToolTip(tr("Stop loading and keep the open scene (Esc)"));
  connect(cancel, &QPushButton::clicked, &frame_.state.runner, &SolveRunner::stop);
  connect(frame_.page.loading_bar(), &Banner::closed, &frame_.state.runner, &SolveRunner::stop);
  connect(&delay_, &QTimer::timeout, this, &LoadingNotice::show);
  connect(&frame_.state.runner, &SolveRunner::state_changed, this, &LoadingNotice::show_state);
  connect(&frame_.state.runner, &SolveRunner::load_progressed, this,
          [this](const QString& phase, double fraction) {
            phase_ = phase;
            share_ = fraction;
            if (!title_before_.isEmpty()) {
              show();
            }
          });
}

void LoadingNotice::show_state(RunState state) {
  if (state == RunState::loading) {
    delay_.start();
    return;
  }
  delay_.stop();
  frame_.page.loading_bar()->dismiss();
  frame_.page.start()->set_loading({});
  // Otherwise the new scene has set it.
  if (!title_before_.isEmpty() && frame_.window.windowTitle() == loading_title_) {
    frame_.window.setWindowTitle(title_before_);
  }
  title_before_.clear();
}

void LoadingNotice::show() {
  const QString name =
      QFileInfo(QString::fromStdString(frame_.state.scene.requested_spec())).fileName();
  if (title_before_.isEmpty()) {
    title_before_ = frame_.window.windowTitle();
    loading_title_ = tr("Loading %1 – transillum").arg(name);
    frame_.window.setWindowTitle(loading_title_);
    frame_.page.start()->set_loading(name);
  }
  const QString text =
      share_ < 0 ? phase_
                 : tr("%1: %2 %").arg(phase_, QString::number(static_cast<int>(100 * share_)));
  frame_.page.loading_bar()->show_message(Banner::Kind::offer, text);
}

namespace {

constexpr double first_exitance = 10;  // W/m²; the exposure follows it

}  // namespace

LightOffer::LightOffer(const WindowFrame& frame, DockLayouts& docks, SettingsPanel& settings,
                       MaterialPanel& materials, ViewStateApplier& applier)
    : QObject(&frame.window),
      frame_(frame),
      docks_(docks),
      settings_(settings),
      materials_(materials),
      applier_(applier) {
  Banner* bar = frame_.page.light_bar();
  QPushButton* button = bar->add_button("make_emit", tr("Make it emit"));
  menu_ = new QMenu(button);
  button->setMenu(menu_);
  sky_ = bar->add_button("make_sky", tr("Sky"));
  sky_->setToolTip(tr("Set the exitance of the sky, in Solve settings"));
  connect(sky_, &QPushButton::clicked, this, &LightOffer::ask_for_sky);
  connect(menu_, &QMenu::aboutToShow, this, &LightOffer::fill_menu);
  connect(bar, &Banner::closed, this, [this] { closed_ = true; });
  connect(&frame_.state.scene, &OpenScene::scene_shown, this, [this] {
    closed_ = false;
    refused_.reset();
    update();
  });
  connect(&frame_.state.relighting.edits(), &MaterialEdits::changed, this, &LightOffer::update);
  connect(&frame_.state.scene, &OpenScene::snapshot_shown, this, &LightOffer::update);
  connect(&frame_.state.selection, &Selection::changed, this, &LightOffer::update);
}

void LightOffer::update() {
  Banner& bar = *frame_.page.light_bar();
  const auto snapshot = frame_.state.scene.snapshot();
  // States of a short solve may be skipped, but it has a snapshot of its own.
  if (refused_ && *refused_ != snapshot) {
    refused_.reset();
  }
  const bool sky = !refused_ && snapshot &&
                   (snapshot->options.sky.is_set() || snapshot->options.sky.sun.below_horizon);
  if (closed_ || sky || !frame_.state.scene.loaded() ||
      frame_.state.relighting.edits().has_light()) {
    bar.dismiss();
    return;
  }
  const bool may_have_sky = settings_.may_have_sky();
  enable_if(*sky_, may_have_sky,
            tr("No sky lights this scene: it is closed, or the engine has no directions"));
  const bool selected = frame_.state.selection.patch() != no_patch;
  const QString state = refused_ ? tr("Not solved: %1.").arg(why_refused_)
                                 : tr("No light: the scene is shown in neutral light.");
  const QString offer = selected ? tr("Make the selected face, material or group emit")
                                 : tr("Click a face to make it emit");
  bar.show_message(
      Banner::Kind::offer,
      (may_have_sky ? tr("%1 %2, or set a sky or a sun.") : tr("%1 %2.")).arg(state, offer));
}

void LightOffer::show_refusal(const QString& why) {
  why_refused_ = why;
  refused_ = frame_.state.scene.snapshot();
  closed_ = false;
  update();
}

void LightOffer::ask_for_sky() {
  docks_.bring_to_front("settings");
  settings_.ask_for_sky();
}

void LightOffer::fill_menu() {
  menu_->clear();
  const auto loaded = frame_.state.scene.loaded();
  const PatchId patch = frame_.state.selection.patch();
  std::vector<std::string> targets;
  for (const TargetKind kind : {TargetKind::face, TargetKind::material, TargetKind::group}) {
    if (patch != no_patch) {
      targets.push_back(MaterialEdits::target_of(*loaded->scene, kind, patch));
    }
  }
  if (targets.empty()) {
    menu_->addAction(tr("Click a face in the scene to choose it"))->setEnabled(false);
  }
  for (const std::string& target : targets) {
    if (!target.empty()) {
      add_target(target_text(target), target);
    }
  }
  if (!loaded->description) {
    return;
  }
  const std::string suggested =
      frame_.state.relighting.edits().with_kind(suggested_light(*loaded->description));
  if (std::find(targets.begin(), targets.end(), suggested) == targets.end()) {
    menu_->addSeparator();
    add_target(tr("%1 (suggested)").arg(target_text(suggested)), suggested);
  }
}

void LightOffer::add_target(const QString& text, const std::string& target) {
  menu_->addAction(text, this, [this, target] { make_emit(target); });
}

void LightOffer::make_emit(const std::string& target) {
  constexpr Rgb white{first_exitance, first_exitance, first_exitance};
  const auto snapshot = frame_.state.scene.snapshot();
  if (snapshot && !snapshot->form_factors_fit && frame_.state.scene.loaded()->description) {
    // Form factors that exceed the memory limit cannot give light: only a new solve can.
    if (!frame_.guard.may_lose(&frame_.window, tr("Make it emit"))) {
      return;
    }
    RunOptions options = settings_.options();
    options.scene = frame_.state.scene.options();
    options.input = frame_.state.scene.input();
    options.input.changes.push_back({target, {}, white});
    applier_.open_again(options);
    return;
  }
  MaterialEdits& edits = frame_.state.relighting.edits();
  edits.begin_drag();
  edits.set_exitance(target, white);
  materials_.show_target(target);
  docks_.bring_to_front("material");
}

namespace {

QString changes_text(const OrientationReport& report) {
  const auto count = [](std::int64_t number) { return count_text(number); };
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

QString lines_of(const std::vector<std::string>& sentences) {
  QStringList lines;
  for (const std::string& sentence : sentences) {
    lines << QString::fromStdString(sentence);
  }
  return lines.join('\n');
}

}  // namespace

ChangeOffer::ChangeOffer(const WindowFrame& frame, SettingsPanel& settings,
                         ViewStateApplier& applier, Banner& bar, const Texts& texts)
    : QObject(&frame.window),
      frame_(frame),
      bar_(bar),
      settings_(settings),
      applier_(applier),
      finding_(tr(texts.finding)) {
  preview_ = bar.add_button(texts.preview_name, tr(texts.preview));
  change_ = bar.add_button(texts.change_name, tr(texts.change));
  cancel_ = bar.add_button(texts.cancel_name, tr("Cancel"));
}

void ChangeOffer::listen() {
  connect(preview_, &QPushButton::clicked, this, &ChangeOffer::plan);
  connect(change_, &QPushButton::clicked, this, &ChangeOffer::change);
  connect(cancel_, &QPushButton::clicked, this, [this] {
    leave();
    offer();
  });
  connect(&bar_, &Banner::closed, this, &ChangeOffer::leave);
  connect(&frame_.state.scene, &OpenScene::scene_shown, this, [this] {
    forget_plan();
    offer();
  });
  // Marks and plans belong to the patches before.
  connect(&frame_.state.scene, &OpenScene::patches_changed, this, [this] {
    if (state_ == State::planning || state_ == State::previewed) {
      leave();
      offer();
    }
  });
  // Another bar marks its faces.
  connect(frame_.page.scene_view(), &SceneView::preview_replaced, this, [this] {
    if (state_ == State::previewed) {
      offer();
    }
  });
}

bool ChangeOffer::is_of_file() const {
  const auto loaded = frame_.state.scene.loaded();
  return loaded->description && !loaded->description->files.empty();
}

void ChangeOffer::plan() {
  show(State::planning, finding_);
  request_plan();
}

void ChangeOffer::preview(const MarkedFaces& faces, const QString& text, const QString& details) {
  frame_.page.scene_view()->preview(faces);
  show(State::previewed, text, details);
}

void ChangeOffer::change() {
  if (!frame_.guard.may_lose(&frame_.window, change_->text())) {
    return;
  }
  RunOptions options = settings_.options();
  options.scene = frame_.state.scene.options();
  options.input = frame_.state.scene.input();
  set_change(options.input);
  applier_.open_again(options);
}

void ChangeOffer::leave() {
  forget_plan();
  if (state_ == State::previewed) {
    frame_.page.scene_view()->hide_preview();
  }
  state_ = State::none;
}

void ChangeOffer::show(State state, const QString& text, const QString& details) {
  state_ = state;
  preview_->setVisible(state == State::offered);
  change_->setVisible(state == State::previewed);
  cancel_->setVisible(state == State::previewed || state == State::planning);
  if (state == State::none) {
    bar_.dismiss();
  } else {
    bar_.show_message(Banner::Kind::offer, text, details);
  }
}

OrientationOffer::OrientationOffer(const WindowFrame& frame, SettingsPanel& settings,
                                   ViewStateApplier& applier)
    : ChangeOffer(
          frame, settings, applier, *frame.page.orientation_bar(),
          {"preview_turn", QT_TR_NOOP("Show what to turn"), "turn_faces", QT_TR_NOOP("Turn them"),
           "cancel_turn", QT_TR_NOOP("Finding the faces to turn…")}),
      planner_(
          *this,
          [](const std::shared_ptr<const LoadedScene>& loaded, const Cancellation& cancellation) {
            return plan_orientation(*loaded->description, 0, cancellation);
          },
          [this](const std::shared_ptr<const LoadedScene>& loaded,
                 const std::shared_ptr<const OrientationPlan>& plan, const QString& error) {
            if (loaded != frame_.state.scene.loaded()) {
              return;  // another scene has been opened since
            }
            if (plan) {
              show_plan(*plan);
            } else {
              offer();
              frame_.notifier.show_failure(error);
            }
          }) {
  listen();
}

void OrientationOffer::offer() {
  const double backs = frame_.state.scene.loaded()->back_fraction;
  if (!is_of_file() || backs <= BackFraction::worth_a_warning) {
    show(State::none, {});
    return;
  }
  const QString percent = QString::number(std::lround(100 * backs));
  if (frame_.state.scene.input().orient) {
    show(State::nothing_to_change,
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

void OrientationOffer::show_plan(const OrientationPlan& plan) {
  const QString details = lines_of(plan.report.sentences);
  if (!plan.changes()) {
    show(State::nothing_to_change,
         tr("No faces to turn were found. Two-sided faces, in the settings, emit and receive on "
            "both sides."),
         details);
    return;
  }
  MarkedFaces faces;
  faces.inside_turned = true;
  for (std::size_t f = 0; f < plan.numbers.size(); ++f) {
    if (plan.turned[f]) {
      faces.inside.push_back(plan.numbers[f]);
    } else if (plan.two_sided[f]) {
      faces.outside.push_back(plan.numbers[f]);
    }
  }
  std::sort(faces.inside.begin(), faces.inside.end());
  std::sort(faces.outside.begin(), faces.outside.end());
  preview(faces, changes_text(plan.report), details);
}

namespace {

/// Share of the area above which a bar offers to unite solids, as `info` does.
constexpr double least_inside = 0.05;
/// More faces take too long to measure unasked.
constexpr std::size_t most_faces = 200'000;

using Loaded = std::shared_ptr<const LoadedScene>;

}  // namespace

SolidsOffer::SolidsOffer(const WindowFrame& frame, SettingsPanel& settings,
                         ViewStateApplier& applier)
    : ChangeOffer(frame, settings, applier, *frame.page.solids_bar(),
                  {"preview_union", QT_TR_NOOP("Show what goes"), "unite_solids",
                   QT_TR_NOOP("Unite them"), "cancel_union", QT_TR_NOOP("Uniting solids…")}),
      measurement_(
          *this,
          [](const Loaded& loaded, const Cancellation& cancellation) {
            return share_inside_solids(*loaded->description, cancellation);
          },
          [this](const Loaded& loaded, const std::shared_ptr<const double>& share, const QString&) {
            // The patches may be others by now.
            if (share && is_same_origin(loaded, frame_.state.scene.loaded())) {
              share_ = *share;
              offer();
            }
          }),
      planner_(
          *this,
          [](const Loaded& loaded, const Cancellation& cancellation) {
            SceneDescription description = *loaded->description;
            return unite_solids(description, cancellation);
          },
          [this](const Loaded& loaded, const std::shared_ptr<const SolidsReport>& plan,
                 const QString& error) {
            if (loaded != frame_.state.scene.loaded()) {
              return;
            }
            if (plan) {
              show_plan(*plan);
            } else {
              offer();
              frame_.notifier.show_failure(error);
            }
          }) {
  // Before listen(), whose slot makes the offer.
  connect(&frame_.state.scene, &OpenScene::scene_shown, this, [this] {
    share_ = 0;
    measurement_.clear();
    const Loaded loaded = frame_.state.scene.loaded();
    if (is_of_file() && !frame_.state.scene.input().unite_solids &&
        loaded->description->face_count() <= most_faces) {
      measurement_.request(loaded);
    }
  });
  listen();
}

void SolidsOffer::offer() {
  if (share_ <= least_inside) {
    show(State::none, {});
    return;
  }
  show(State::offered,
       tr("%1 % of the surface lies inside or against other closed parts, where no light reaches.")
           .arg(std::lround(100 * share_)));
}

void SolidsOffer::show_plan(const SolidsReport& report) {
  const QString details = lines_of(report.sentences);
  if (report.removed.empty() && report.cut.empty()) {
    show(State::nothing_to_change, tr("No closed parts can be united."), details);
    return;
  }
  const auto count = [](const std::vector<std::int32_t>& faces) {
    return QString::number(faces.size());
  };
  preview({.inside = report.removed, .outside = report.cut, .are_covered = true},
          tr("Uniting takes %1 of the surface: %2 faces would go (orange), %3 would be cut (blue).")
              .arg(tr("%1 %").arg(std::lround(100 * (1 - report.area_after / report.area_before))))
              .arg(count(report.removed), count(report.cut)),
          details);
}

}  // namespace transillum::viewer
