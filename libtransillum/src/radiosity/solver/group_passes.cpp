// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The passes of an iteration in a group of processes: each is made by one member, split into what
// each member needs of it, and added on every member in the order of the passes.
//
// Why one process has the same bits: what a patch receives is summed by its owner, which gets
// all exchanges of the patch, in the order of one process; maxima do not depend on the order; sums
// over patches within a pass are made by the member that made it (decisions/0063-processes.md).
#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/seconds_since.h"
#include "radiosity/exchange/pass_messages.h"
#include "radiosity/ratio.h"
#include "radiosity/solver/solver_state.h"

namespace transillum {
namespace {

using Clock = std::chrono::steady_clock;

/// A number that differs between almost any two lists of values, exact as a double.
double fingerprint(const std::vector<Rgb>& values) {
  std::uint64_t hash = 0;
  for (const Rgb& value : values) {
    for (const double channel : {value.r, value.g, value.b}) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(channel)) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 32;
    }
  }
  constexpr int digits = 52;
  return static_cast<double>(hash >> (64 - digits));
}

}  // namespace

bool RadiositySolver::Impl::advance_in_group(int last, const RadiositySolver& self,
                                             const Observer& observer) {
  const auto start = Clock::now();
  const double adding_before = timing.seconds_iterate;
  const double seconds_before = iteration.seconds;
  const int known = plan.renews() ? 0 : statistics.areas().passes;
  bool going = true;
  GroupPasses passes;
  passes.first = passes_done();
  passes.last = last;
  passes.threads = input.threads;
  passes.bytes_of_a_pass = expected_message_bytes(share.patches);
  passes.cancellation = input.requested;
  passes.make = [&](int k) { return split(make_pass(k, known), *share.group, share.patches); };
  passes.add = [&](int k, std::span<const std::byte> message) {
    Pass pass = joined_pass(message, share.owned);
    if (is_first_along(k, statistics.areas().passes) && kept.available()) {
      pass.run = kept.make_run(pass.transfers);
    }
    add_pass(k, std::move(pass));
    iteration.seconds = seconds_before + seconds_since(start);
    if (observer && !observer(self)) {
      going = false;
    }
  };
  passes.after_round = [&] { return agree_after_round(going); };
  const auto add_times = [&] {
    const double adding = timing.seconds_iterate - adding_before;
    timing.seconds_transfers += std::max(0.0, seconds_since(start) - adding);
    iteration.seconds = seconds_before + seconds_since(start);
  };
  try {
    going = share.group->run(passes);
  } catch (const Canceled&) {
    add_times();
    complete();
    throw;
  }
  add_times();
  complete();
  return going;
}

bool RadiositySolver::Impl::agree_after_round(bool going) {
  std::vector<double> largest{going ? 0.0 : 1.0, kept.requested() && !kept.available() ? 1.0 : 0.0};
  for (const EstimateChange& change : iteration.changes_of_share) {
    largest.insert(largest.end(), {change.change, change.largest, change.largest_of_all});
  }
  share.group->maxima(largest);
  for (std::size_t k = 2; k < largest.size(); k += 3) {
    iteration.changes.push_back(
        EstimateChange{largest[k], largest[k + 1], largest[k + 2]}.relative());
  }
  iteration.changes_of_share.clear();
  statistics.complete_errors();
  kept.agree_dropped(largest[1] > 0);
  return largest[0] == 0;
}

void RadiositySolver::Impl::complete() {
  if (share.group == nullptr) {
    return;
  }
  const auto start = Clock::now();
  for_each_iterate([](RadiosityIterate& iterate, const KeptSums&) { iterate.complete(); });
  history.start().complete();
  statistics.complete();
  kept.complete();
  share.complete(iteration.estimate);
  timing.seconds_iterate += seconds_since(start);
}

void RadiositySolver::Impl::check_agreement() const {
  if (share.group == nullptr) {
    return;
  }
  const double own = fingerprint(history.b());
  std::vector<double> bounds{own, -own};
  share.group->maxima(bounds);
  if (bounds[0] != -bounds[1]) {
    throw std::runtime_error(
        "the processes of the group computed different values: their machines or programs differ");
  }
}

}  // namespace transillum
