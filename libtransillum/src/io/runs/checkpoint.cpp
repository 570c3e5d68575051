// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Checkpoints: sealed files with the state of an accuracy plan, if any, and of a solver.
#include "transillum/checkpoint.h"

#include <algorithm>
#include <ostream>
#include <sstream>
#include <utility>

#include "base/seconds_since.h"
#include "io/runs/run_identity.h"
#include "io/runs/sealed_file.h"
#include "radiosity/state_archive.h"
#include "session/session_state.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

constexpr const char* checkpoint_kind = "checkpoint";
/// Longest share of the time that saving may take.
constexpr double cost_fraction = 0.01;

/// Takes part in saving, where nothing is written.
void save_nowhere(const RadiositySolver& solver) {
  std::ostringstream nowhere;
  nowhere.setstate(std::ios::badbit);
  solver.save(nowhere);
}

}  // namespace

struct [[gnu::visibility("hidden")]] Checkpoint::Impl {
  std::filesystem::path file;
  RunIdentity identity;
  Cost cost;
  Clock::time_point saved = Clock::now();
  double seconds_of_last = 0;

  /// The plan in the file, if the solve has a goal; the solver's state is what is left then.
  /// @throws InputError, Canceled
  std::optional<AccuracyPlan> read_plan(SealedFile& file_in, const Scene& scene,
                                        const SolveOptions& options,
                                        const Cancellation& cancellation) const;
};

std::optional<AccuracyPlan> Checkpoint::Impl::read_plan(SealedFile& file_in, const Scene& scene,
                                                        const SolveOptions& options,
                                                        const Cancellation& cancellation) const {
  check_identity(file_in, identity);
  file_in.check(cancellation);
  const Json seconds_used = file_in.head().value("seconds", Json());
  const Json plan_size = file_in.head().value("plan", Json());
  if (!seconds_used.is_number() || plan_size.is_null() == options.goal.is_set() ||
      (options.goal.is_set() &&
       (!plan_size.is_number_unsigned() || plan_size.get<std::uint64_t>() > file_in.size()))) {
    file_in.refuse("its head is damaged");
  }
  std::optional<AccuracyPlan> plan;
  if (options.goal.is_set()) {
    plan.emplace(options, scene);
    try {
      plan->restore(file_in.in(), plan_size.get<std::uint64_t>());
    } catch (const DamagedState& error) {
      file_in.refuse(error.what());
    }
  }
  return plan;
}

Checkpoint::Checkpoint(std::filesystem::path file, const Scene& scene, const SolveOptions& options)
    : impl_(std::make_unique<Impl>(Impl{std::move(file), run_identity(scene, options), {}})) {}
Checkpoint::~Checkpoint() = default;
Checkpoint::Checkpoint(Checkpoint&&) noexcept = default;
Checkpoint& Checkpoint::operator=(Checkpoint&&) noexcept = default;

const std::filesystem::path& Checkpoint::file() const { return impl_->file; }
const Checkpoint::Cost& Checkpoint::cost() const { return impl_->cost; }

void Checkpoint::save(const SolveSession& session) {
  const auto start = Clock::now();
  const RadiositySolver& solver = *session.diffuse();
  const std::optional<AccuracyPlan>& plan = session.impl_->plan;
  std::ostringstream plan_state;
  if (plan) {
    plan->save(plan_state);
  }
  const std::string plan_bytes = plan_state.str();
  Json head;
  head["run"] = impl_->identity.json;
  head["seconds"] = session.seconds();
  head["plan"] = plan ? Json(plan_bytes.size()) : Json();
  std::uint64_t size = 0;
  // A save that fails is not tried again at once.
  impl_->saved = start;
  if (!session.sums()->is_first()) {
    save_nowhere(solver);
    impl_->saved = Clock::now();
    return;
  }
  bool begun = false;
  try {
    write_sealed(impl_->file, checkpoint_kind, head, [&](std::ostream& out) {
      out << plan_bytes;
      begun = true;
      solver.save(out);
    });
  } catch (const std::runtime_error&) {
    if (!begun) {  // the other processes take part in saving
      save_nowhere(solver);
    }
    throw;
  }
  std::error_code error;
  size = std::filesystem::file_size(impl_->file, error);
  impl_->saved = Clock::now();
  impl_->seconds_of_last = seconds_since(start);
  Cost& cost = impl_->cost;
  ++cost.times;
  cost.seconds += impl_->seconds_of_last;
  cost.bytes = error ? 0 : size;
}

bool Checkpoint::save_if_due(const SolveSession& session, double interval) {
  const bool due = is_due(interval);
  if (due) {
    save(session);
  }
  return due;
}

bool Checkpoint::is_due(double interval) const {
  const double least = interval > 0 ? impl_->seconds_of_last / cost_fraction : 0;
  return seconds_since(impl_->saved) >= std::max(interval, least);
}

void Checkpoint::check() const {
  check_identity(SealedFile(impl_->file, checkpoint_kind), impl_->identity);
}

void Checkpoint::resume(SolveSession& session) {
  SolveSession::Impl& s = *session.impl_;
  const std::shared_ptr<PatchSums>& sums = session.sums();
  std::optional<SealedFile> file;
  std::optional<AccuracyPlan> plan;
  std::uint64_t left = 0;
  sums->agree([&] {
    file.emplace(impl_->file, checkpoint_kind);
    plan = impl_->read_plan(*file, *s.scene, s.request.options, s.cancellation);
    const Json plan_size = file->head().value("plan", Json());
    left = file->size() - (plan ? plan_size.get<std::uint64_t>() : 0);
  });
  s.solver.reset();
  s.plan.swap(plan);
  try {
    session.prepare();
    sums->agree([&] {
      try {
        s.solver->diffuse()->restore(file->in(), left);
      } catch (const DamagedState& error) {
        file->refuse(error.what());
      }
    });
  } catch (...) {
    s.solver.reset();
    s.plan.swap(plan);
    throw;
  }
  if (s.request.keep_form_factors) {
    s.solver->diffuse()->keep_form_factors();  // the file may be of a solve without
  }
  s.solver->diffuse()->complete_estimate();
  s.seconds_before += file->head().at("seconds").get<double>();
}

}  // namespace transillum
