// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Checkpoints: sealed files with the states of plans, if any, and of a solver: of a total error, of
// an accuracy.
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

/// Bytes of a state that comes before the solver's; 0 if the file has none.
std::uint64_t size_of(const SealedFile& file, const char* part) {
  const Json size = file.head().value(part, Json());
  return size.is_number_unsigned() ? size.get<std::uint64_t>() : 0;
}

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
  std::string total_plan = {};
  Cost cost = {};
  Clock::time_point saved = Clock::now();
  double seconds_of_last = 0;

  /// Opens the file and checks all of it.
  /// @throws InputError, Canceled
  SealedFile open(const Cancellation& cancellation) const;
};

SealedFile Checkpoint::Impl::open(const Cancellation& cancellation) const {
  SealedFile in(file, checkpoint_kind);
  check_identity(in, identity);
  in.check(cancellation);
  std::uint64_t left = in.size();
  bool is_right = in.head().value("seconds", Json()).is_number();
  for (const char* part : {"total", "plan"}) {
    const std::uint64_t size = size_of(in, part);
    is_right = is_right && size <= left;
    left -= size;
  }
  if (!is_right) {
    in.refuse("its head is damaged");
  }
  return in;
}

Checkpoint::Checkpoint(std::filesystem::path file, const Scene& scene, const SolveOptions& options,
                       bool total)
    : impl_(std::make_unique<Impl>(Impl{std::move(file), run_identity(scene, options)})) {
  impl_->identity.json["options"]["total"] = total;
}
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
  head["total"] = impl_->total_plan.size();
  head["plan"] = plan_bytes.size();
  head["in_rounds"] = session.in_rounds();
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
      out << impl_->total_plan << plan_bytes;
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

void Checkpoint::set_total_plan(std::string state) { impl_->total_plan = std::move(state); }

std::string Checkpoint::total_plan(const Cancellation& cancellation) const {
  SealedFile file = impl_->open(cancellation);
  std::string state(static_cast<std::size_t>(size_of(file, "total")), '\0');
  file.in().read(state.data(), static_cast<std::streamsize>(state.size()));
  return state;
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
    file.emplace(impl_->open(s.cancellation));
    // The last round of refinement may solve the scene that is solved after all of them.
    if (file->head().value("in_rounds", Json(false)) != Json(s.in_rounds())) {
      file->refuse(s.in_rounds() ? "it is of the solve after rounds of refinement"
                                 : "it is of a round of refinement");
    }
    const std::uint64_t total_size = size_of(*file, "total"), plan_size = size_of(*file, "plan");
    left = file->size() - total_size - plan_size;
    file->seek(total_size);
    if (s.request.options.goal.is_set()) {
      plan.emplace(s.request.options, *s.scene);
      try {
        plan->restore(file->in(), plan_size);
      } catch (const DamagedState& error) {
        file->refuse(error.what());
      }
    }
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
