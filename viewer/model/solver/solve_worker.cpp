// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// What SolveRunner's thread does: a SolveSession is advanced stage by stage, so that the patches of
// each round of refinement can be shown, and observed after each pass.
#include "model/solver/solve_worker.h"

#include <QCoreApplication>
#include <algorithm>
#include <utility>

#include "base/memory_limit.h"
#include "model/measured_errors.h"
#include "model/solver/draft.h"
#include "model/solver/session_snapshot.h"
#include "session/divisions.h"

namespace transillum::viewer {

namespace {

/// Without a GPU, a drawing of the dark scene would take a third of the time of its draft. A draft
/// of so many patches is there soon enough to be the first picture.
constexpr PatchId most_patches_of_quick_draft = 4000;

/// Whether the scene as it was read gives light in a solve.
bool is_lit(const Scene& scene, const SolveOptions& options) {
  return options.why_dark(scene.has_light()).empty();
}

/// The solve that makes the form factors of a scene without light, where B shows no accuracy.
SolveOptions without_goal(SolveOptions options) {
  if (options.goal.is_set()) {
    options.goal = {};
    options.directions = SolveOptions().directions;
  }
  return options;
}

/// The divisions that make the present patches of a run from those that it began with.
std::vector<std::string> divisions_of(const SolveWorker::Choice& choice,
                                      const SolveSession& session,
                                      const std::optional<TotalPlan>& total) {
  std::vector<std::string> names;
  if (!choice.division.empty()) {
    names.push_back(choice.division);
  }
  const auto made = total ? total->divisions() : session.divisions();
  names.insert(names.end(), made.begin(), made.end());
  return names;
}

}  // namespace

SolveWorker::Prepared SolveWorker::load(const std::string& spec, RunOptions options,
                                        bool first_look, const Cancellation& cancellation,
                                        bool runs_on,
                                        const std::shared_ptr<const SceneDescription>& faces) {
  options.solve.validate();
  const auto loaded = loaded_scene(spec, options, first_look, report_, cancellation, faces);
  return prepare(loaded, choice_of(options), cancellation, cancellation, runs_on);
}

SolveWorker::Prepared SolveWorker::prepare(const std::shared_ptr<const LoadedScene>& start,
                                           Choice choice, const Cancellation& cancellation,
                                           const Cancellation& preparing, bool drafted_first) {
  if (start->stored && !start->description) {
    choice.refine = {};
    choice.total = false;
  }
  const bool lit = is_lit(*start->scene, choice.solve);
  SolveRequest request{.scene = start->scene,
                       .options = lit ? choice.solve : without_goal(choice.solve),
                       .tree = start->tree};
  if (!choice.division.empty()) {
    request.scene = divided_scene(start->scene, {choice.division}, cancellation);
    request.tree = nullptr;
  }
  if (choice.refine.is_set() && lit) {
    request.refine = choice.refine.options();
  }
  request.keep_form_factors = true;
  request.preparing = phase_reporter(report_);
  CheckpointKeeper::Solve saved{request.scene, choice.solve, choice.total && lit};
  std::optional<TotalPlan> total;
  if (saved.total) {
    check_measurable(choice.solve, choice.solve.glossy && has_lobes(*request.scene));
    TotalGoal goal{.total = choice.solve.goal.accuracy};
    if (choice.refine.patches > 0) {
      goal.patches = choice.refine.patches;
    }
    total.emplace(request, goal);
    if (!checkpoints_.restore(*total, saved, cancellation)) {
      total.emplace(std::move(request), goal);
    }
    request = total->stage();
  }
  SolveSession session(std::move(request), cancellation);
  saved.scene = saved.total ? saved.scene : session.scene();
  checkpoints_.resume(session, saved);
  const bool is_whole = choice.division.empty() && !choice.refine.is_set() && !saved.total;
  if (!(drafted_first && drafts_ && lit && is_whole && !start->stored && !session.is_prepared() &&
        can_be_drafted(choice.solve, *start->scene))) {
    session.prepare(preparing);
  }
  auto loaded = with_patches_of(session, divisions_of(choice, session, total), start, cancellation);
  return {std::move(choice), std::move(loaded), std::move(session),
          cancellation,      std::move(total),  std::move(saved)};
}

void SolveWorker::open(Prepared prepared) {
  loaded_ = prepared.loaded;
  materials_ = nullptr;
  patches_to_announce_ = true;
  replace_session(std::move(prepared));
  if (!session_->is_prepared()) {
    try {
      if (loaded_->scene->patch_count() > most_patches_of_quick_draft) {
        announce_patches();
      }
      begin_with_draft();
      announce_patches();
      prepare_stage();
    } catch (const Canceled&) {
      announce_patches();
      post_emission();
      return;
    }
  }
  post_snapshot();
}

/// Posts the patches, unless that is done.
void SolveWorker::announce_patches() {
  if (std::exchange(patches_to_announce_, false)) {
    messages_.post_scene(loaded_);
  }
}

/// Posts the state before the first shot, where a new scene would otherwise have none.
void SolveWorker::post_emission() {
  if (whole_) {
    return;
  }
  SolveOptions options = choice_.solve;
  options.goal = {};
  options.first_shot.reset();
  SolveSession unlit(
      {.scene = loaded_->scene, .options = std::move(options), .tree = loaded_->tree});
  unlit.prepare();
  messages_.post_snapshot(std::make_shared<const SolverSnapshot>(snapshot_at_start(unlit)));
}

/// The state to show before the session is prepared: a snapshot of another solve of its patches.
SolverSnapshot SolveWorker::snapshot_at_start(const SolveSession& other) const {
  SolverSnapshot start = snapshot_of(other, loaded_);
  SolveHistory(other).write_to(start);
  start.options = choice_.solve;
  if (!start.options.goal.is_set()) {
    start.progress.passes = start.options.directions;
  }
  return start;
}

void SolveWorker::start(Choice choice, const Cancellation& cancellation, bool runs_on) {
  if (!loaded_) {
    return;
  }
  unstarted_ = choice;
  cancellation_ = cancellation;
  // Another scene may have been opened since.
  if (choice.from && !is_same_origin(choice.from, loaded_)) {
    choice.from = nullptr;
    choice.division.clear();
  }
  const auto from = begun(choice);
  const Preparing preparing(*this);
  Prepared prepared = prepare(from, std::move(choice), cancellation, interruption());
  if (prepared.session.glossy() != nullptr && materials_) {
    set_materials(prepared.session);
  }
  take_patches(prepared.loaded);
  replace_session(std::move(prepared));
  if (!runs_on || !drafts_) {
    post_snapshot();
  }
}

/// The patches that a run begins with.
std::shared_ptr<const LoadedScene> SolveWorker::begun(const Choice& choice) const {
  return choice.from ? choice.from : whole_of(loaded_);
}

void SolveWorker::replace_session(Prepared prepared) {
  history_ = prepared.session.is_prepared() ? SolveHistory(prepared.session) : SolveHistory();
  checkpoints_.begin(std::move(prepared.saved));
  choice_ = std::move(prepared.choice);
  total_ = std::move(prepared.total);
  if (total_) {
    checkpoints_.begin_stage(*total_);
  }
  errors_ = nullptr;
  session_ = std::move(prepared.session);
  cancellation_ = prepared.cancellation;
  unstarted_.reset();
  failed_ = false;
  form_factors_.clear();
  stage_result_ = nullptr;
  whole_.reset();
  fitted_ = nullptr;
}

void SolveWorker::relight(std::shared_ptr<const PatchMaterials> materials) {
  if (!is_ready() || unstarted_ || session_->glossy() == nullptr) {
    return;
  }
  materials_ = std::move(materials);
  whole_.reset();
  set_materials(*session_);
  history_ = SolveHistory(*session_);
  failed_ = false;
}

void SolveWorker::set_materials(SolveSession& session) const {
  if (materials_) {
    session.relight(materials_->materials, materials_->of_patch);
  } else {
    session.relight(session.scene()->materials());
  }
}

bool SolveWorker::has_more() const {
  const bool stages_follow = total_ && !total_->finished();
  return unstarted_ || (session_ && !failed_ && (!session_->finished() || stages_follow));
}

RunState SolveWorker::state() const {
  if (!session_) {
    return RunState::empty;
  }
  return has_more() ? RunState::paused : RunState::finished;
}

/// Whether the present stage of the session, and what is shown of it, is prepared.
bool SolveWorker::is_ready() const {
  return session_ && session_->is_prepared() && session_->tree() == loaded_->tree;
}

void SolveWorker::advance(const Goal& goal) {
  if (unstarted_) {
    start(*unstarted_, cancellation_);
  }
  const bool by_passes = goal.kind == Goal::Kind::passes;
  if (!has_more() || (by_passes && !session_->in_rounds() && !total_ && is_ready() &&
                      session_->passes_done() >= goal.passes)) {
    return;
  }
  const bool lit =
      is_lit(*loaded_->scene, choice_.solve) || (materials_ && materials_->has_light());
  if (!lit && !goal.without_light) {
    return;
  }
  messages_.post_state(RunState::running);
  if (goal.kind == Goal::Kind::finished) {
    begin_with_draft();
  }
  while (advance_stage(goal)) {
  }
}

/// Posts a whole picture of few directions, where drafts are wanted and no pass has been made.
void SolveWorker::begin_with_draft() {
  const bool prepared = session_->is_prepared();
  if (!drafts_ || whole_ || materials_ ||
      (prepared && (!is_ready() || session_->passes_done() > 0)) || loaded_->stored ||
      session_->in_rounds() || total_ || !is_lit(*loaded_->scene, choice_.solve) ||
      !can_be_drafted(choice_.solve, *loaded_->scene)) {
    return;
  }
  const Preparing preparing(*this);
  try {
    const bool has_shot = prepared && session_->diffuse() != nullptr;
    SolveSession draft =
        prepare_draft(choice_.solve, *loaded_,
                      has_shot ? session_->diffuse()->direct_light() : nullptr, interruption());
    SolverSnapshot start = snapshot_at_start(draft);
    draft.advance(SolveSession::Until::finished,
                  [this](const SolveSession&) { return !interrupted_; });
    if (!draft.finished() || interrupted_) {
      return;
    }
    whole_ = smoothed(draft.solution());
    if (prepared) {
      post_snapshot();
      return;
    }
    show_light_of(*whole_, start);
    announce_patches();
    messages_.post_snapshot(std::make_shared<const SolverSnapshot>(std::move(start)));
  } catch (...) {
    whole_.reset();  // the solve itself meets the same problem, and tells it
  }
}

/// Advances the session within a stage, or to its end, where the next is prepared.
/// @returns whether to continue with the next stage
bool SolveWorker::advance_stage(const Goal& goal) {
  using Until = SolveSession::Until;
  const bool to_passes = goal.kind == Goal::Kind::passes && !session_->in_rounds() && !total_;
  const Until until = goal.kind == Goal::Kind::direction   ? Until::direction
                      : goal.kind == Goal::Kind::iteration ? Until::iteration
                                                           : Until::stage;
  bool continues = until == Until::stage && !to_passes;
  try {
    prepare_stage();
    const auto observer = [this](const SolveSession&) { return observe(); };
    if (to_passes) {
      session_->advance_to(goal.passes, observer);
    } else {
      session_->advance(until, observer);
    }
    if (session_->is_prepared() && !session_->finished()) {
      checkpoints_.save_if_due(*session_, true);
    }
    if (session_->finished()) {
      return_freed_memory();
    }
    if (session_->finished() && has_more()) {
      end_stage_of_total();
    }
    prepare_stage();
  } catch (const Canceled&) {
    return false;
  } catch (...) {
    failed_ = is_ready();  // otherwise, preparing has failed, which is tried again
    messages_.post_current_failure();
  }
  continues = continues && has_more() && is_ready() && !interrupted_;
  try {
    if (!continues || !holds_patches_back()) {
      post_snapshot();
    }
  } catch (...) {
    messages_.post_current_failure(
        QCoreApplication::translate("SolveWorker", "Not enough memory to show the result"));
  }
  return continues;
}

void SolveWorker::interrupt(bool interrupted) {
  interrupted_ = interrupted;
  if (interrupted) {
    const std::lock_guard lock(interruption_mutex_);
    interruption_.cancel();
  }
}

/// A cancellation that the next interrupt() sets.
Cancellation SolveWorker::interruption() {
  const std::lock_guard lock(interruption_mutex_);
  interruption_ = Cancellation();
  if (interrupted_) {
    interruption_.cancel();
  }
  return interruption_;
}

/// Measures the errors of the finished solve, and begins the next one for a total error, if the
/// measurement is not interrupted.
void SolveWorker::end_stage_of_total() {
  post_snapshot();
  try {
    total_->assess(*session_, interruption(), by_percent([this](Measurement what, int percent) {
      report_(text_of(what), 0.01 * percent);
    }));
  } catch (const Canceled&) {
    cancellation_.throw_if_canceled();
    return;
  }
  const TotalSolve& outcome = total_->outcome();
  errors_ = std::make_shared<const MeasuredErrors>(
      MeasuredErrors{loaded_, outcome.solve, outcome.report});
  if (total_->finished()) {
    return;
  }
  post_snapshot();
  checkpoints_.begin_stage(*total_);
  session_ = SolveSession(total_->stage(), cancellation_);
}

/// Prepares the present stage of the session, unless that is done.
void SolveWorker::prepare_stage() {
  if (is_ready()) {
    return;
  }
  // A round has its own tree, even if no patch was divided before the last round.
  const auto is_round = [this] { return session_->tree() != loaded_->tree; };
  if (is_round() && !total_) {
    checkpoints_.resume(*session_, {session_->scene(), choice_.solve});
  }
  {
    const bool is_first =
        !session_->has_result() && session_->rounds().empty() && !(total_ && total_->has_result());
    const auto preparing = is_first ? std::make_optional<Preparing>(*this) : std::nullopt;
    session_->prepare(interruption());
  }
  if (is_round()) {
    take_patches(with_patches_of(*session_, divisions_of(choice_, *session_, total_),
                                 begun(choice_), cancellation_));
    if (!total_) {
      checkpoints_.begin({loaded_->scene, choice_.solve});
    }
    stage_result_ = nullptr;
  }
  errors_ = nullptr;
  fitted_ = nullptr;
  history_ = SolveHistory(*session_);
  form_factors_.clear();
}

/// Called after each pass and iteration.
/// @returns whether to continue
bool SolveWorker::observe() {
  history_.update(*session_);
  checkpoints_.save_if_due(*session_);
  // The end of a stage: the next stage replaces its patches, or perhaps its values.
  const bool is_end =
      session_->progress().finished && (session_->in_rounds() || choice_.solve.goal.seconds > 0);
  // Snapshots take at most a fifth of the solver's time.
  const double interval_ms =
      std::max<double>(refresh_interval_.load(std::memory_order_relaxed), 5 * snapshot_cost_ms_);
  const bool due = !since_snapshot_.isValid() ||
                   static_cast<double>(since_snapshot_.nsecsElapsed()) > 1e6 * interval_ms;
  if (is_end || ((due || form_factors_.are_due(*session_)) && !holds_patches_back())) {
    post_snapshot();
  }
  return !interrupted_.load(std::memory_order_relaxed);
}

void SolveWorker::take_patches(const std::shared_ptr<const LoadedScene>& loaded) {
  if (loaded == loaded_) {
    return;
  }
  loaded_ = loaded;
  patches_to_announce_ = true;
  since_patches_.start();
}

/// Whether new patches are not shown yet: the first passes of a round would show a dark scene in
/// place of the finished one before it.
bool SolveWorker::holds_patches_back() const {
  constexpr qint64 longest_ms = 1000;
  const bool is_first = session_->rounds().empty() && !(total_ && total_->has_result());
  return patches_to_announce_ && !is_first && session_->progress().iteration == 0 &&
         since_patches_.elapsed() < longest_ms;
}

void SolveWorker::post_snapshot() {
  if (!is_ready()) {
    return;
  }
  QElapsedTimer cost;
  cost.start();
  announce_patches();
  std::shared_ptr<const SolverSnapshot> snapshot = make_snapshot();
  since_snapshot_.start();
  snapshot_cost_ms_ = static_cast<double>(cost.nsecsElapsed()) * 1e-6;
  messages_.post_snapshot(std::move(snapshot));
}

std::shared_ptr<const SolverSnapshot> SolveWorker::make_snapshot() {
  const SolveSession& session = *session_;
  if (session.finished() && !session.progress().finished && stage_result_) {
    // The time was up: the result is the result of the previous stage.
    auto snapshot = std::make_shared<SolverSnapshot>(*stage_result_);
    snapshot->statistics = session.solution().statistics;
    snapshot->accuracy = session.accuracy();
    return snapshot;
  }
  history_.update(session);
  form_factors_.update(session);
  auto snapshot = std::make_shared<SolverSnapshot>(snapshot_of(session, loaded_));
  snapshot->refine = choice_.refine;
  if (choice_.refine.is_set()) {
    snapshot->refinement = {session.refined_scene()->patch_count(), session.in_rounds()};
  }
  if (total_) {
    snapshot->options.goal = choice_.solve.goal;
    const TotalSolve& outcome = total_->outcome();
    snapshot->total = {outcome.stages,
                       total_->finished() ? std::optional(outcome.end) : std::nullopt};
    snapshot->refinement = {session.scene()->patch_count(), !total_->finished()};
    snapshot->accuracy.reset();
  }
  if (!is_lit(*loaded_->scene, choice_.solve)) {
    snapshot->options = choice_.solve;
    snapshot->total = choice_.total ? std::optional(TotalState()) : std::nullopt;
  }
  snapshot->measured_errors = errors_;
  snapshot->materials = session.glossy() != nullptr ? materials_ : nullptr;
  const bool stage_ends = session.progress().finished;
  // Where the time is limited, each stage may be the last that ends.
  const bool is_result = stage_ends && (session.finished() || choice_.solve.goal.seconds > 0);
  if (whole_ && stage_ends && is_better_than_draft(session.statistics())) {
    whole_ = session.glossy() != nullptr ? session.solution() : smoothed(session.solution());
  }
  if (whole_ && drafts_ && !interrupted_ && !is_result) {
    show_light_of(*whole_, *snapshot);
  }
  if ((is_result || snapshot->of_file) && snapshot->linear_terms.empty() && !snapshot->glossy &&
      snapshot->loaded->scene->patch_count() <= most_fitted_patches) {
    if (!fitted_ || !session.finished()) {
      fitted_ =
          std::make_shared<const FittedLight>(fitted_light(*snapshot, *snapshot->loaded->scene));
    }
    snapshot->fitted = fitted_;
  }
  history_.write_to(*snapshot);
  if (!snapshot->directions) {
    snapshot->directions = std::make_shared<const std::vector<Vec3>>(session.directions());
  }
  form_factors_.write_to(*snapshot);
  if (choice_.solve.goal.seconds > 0 && session.progress().finished) {
    stage_result_ = snapshot;
  }
  return snapshot;
}

}  // namespace transillum::viewer
