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
#include "transillum/errors.h"

namespace transillum {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

constexpr const char* kind = "checkpoint";
/// Longest share of the time that saving may take.
constexpr double cost_share = 0.01;

}  // namespace

struct Checkpoint::Impl {
  std::filesystem::path file;
  Json identity;
  Cost cost;
  double seconds_before = 0;  ///< wall time of the solve before this object
  Clock::time_point start = Clock::now(), saved = start;
  double seconds_of_last = 0;

  double seconds() const { return seconds_before + seconds_since(start); }
};

Checkpoint::Checkpoint(std::filesystem::path file, const Scene& scene, const SolveOptions& options)
    : impl_(std::make_unique<Impl>(Impl{std::move(file), run_identity(scene, options), {}})) {}
Checkpoint::~Checkpoint() = default;
Checkpoint::Checkpoint(Checkpoint&&) noexcept = default;
Checkpoint& Checkpoint::operator=(Checkpoint&&) noexcept = default;

const std::filesystem::path& Checkpoint::file() const { return impl_->file; }
const Checkpoint::Cost& Checkpoint::cost() const { return impl_->cost; }

void Checkpoint::save(const RadiositySolver& solver, const AccuracyPlan* plan) {
  const auto start = Clock::now();
  std::ostringstream plan_state;
  if (plan != nullptr) {
    plan->save(plan_state);
  }
  const std::string plan_bytes = plan_state.str();
  Json head;
  head["run"] = impl_->identity;
  head["seconds"] = impl_->seconds();
  head["plan"] = plan != nullptr ? Json(plan_bytes.size()) : Json();
  std::uint64_t size = 0;
  // A save that fails is not tried again at once.
  impl_->saved = start;
  write_sealed(impl_->file, kind, head, [&](std::ostream& out) {
    out << plan_bytes;
    solver.save(out);
  });
  std::error_code error;
  size = std::filesystem::file_size(impl_->file, error);
  impl_->saved = Clock::now();
  impl_->seconds_of_last = seconds_since(start);
  Cost& cost = impl_->cost;
  ++cost.times;
  cost.seconds += impl_->seconds_of_last;
  cost.bytes = error ? 0 : size;
}

bool Checkpoint::save_if_due(const RadiositySolver& solver, const AccuracyPlan* plan,
                             double interval) {
  const double least = interval > 0 ? impl_->seconds_of_last / cost_share : 0;
  if (seconds_since(impl_->saved) < std::max(interval, least)) {
    return false;
  }
  save(solver, plan);
  return true;
}

void Checkpoint::check() const { check_identity(SealedFile(impl_->file, kind), impl_->identity); }

Checkpoint::Resumed Checkpoint::resume(const std::shared_ptr<const Scene>& scene,
                                       const SolveOptions& options,
                                       std::shared_ptr<const BspTree> tree,
                                       std::shared_ptr<const DirectLight> shot,
                                       const Cancellation& cancellation) {
  SealedFile file(impl_->file, kind);
  check_identity(file, impl_->identity);
  file.check(cancellation);
  const Json seconds = file.head().value("seconds", Json());
  const Json plan_size = file.head().value("plan", Json());
  if (!seconds.is_number() || plan_size.is_null() == options.goal.set() ||
      (options.goal.set() && !plan_size.is_number_unsigned())) {
    file.refuse("its head is damaged");
  }
  try {
    std::optional<AccuracyPlan> plan;
    std::uint64_t left = file.size();
    if (options.goal.set()) {
      const auto size = std::min(left, plan_size.get<std::uint64_t>());
      plan.emplace(options, *scene);
      plan->restore(file.in(), size);
      left -= size;
    }
    RadiositySolver solver(scene, plan ? plan->stage() : options, std::move(tree), cancellation,
                           std::move(shot));
    solver.restore(file.in(), left);
    impl_->seconds_before = seconds.get<double>();
    return {std::move(solver), std::move(plan), impl_->seconds_before};
  } catch (const DamagedState& error) {
    file.refuse(error.what());
  }
}

}  // namespace transillum
