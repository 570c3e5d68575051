// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Gathers light along passes: made by the engine, or from kept exchanges. Passes are computed in
// parallel, a batch at a time, and added in their order.
//
// Notation: k a pass; g a glossy patch; L radiance, W/(m² sr).
#include <algorithm>
#include <chrono>
#include <numbers>

#include "base/for_each_index.h"
#include "base/seconds_since.h"
#include "radiosity/glossy/glossy_iteration.h"
#include "transillum/at.h"

namespace transillum {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int batch_per_thread = 4;
constexpr std::size_t patches_per_task = 4096;

}  // namespace

/// L of the other patch times the area, for both patches of each exchange.
void GlossySolver::Impl::gather(const std::vector<Transfer>& exchanges, std::size_t k,
                                std::vector<Rgb>& sum) const {
  const std::vector<Rgb>& diffuse = light->lambertian[light->replica_of(k)];
  const auto radiance = [&](PatchId i) {
    const std::int32_t g = at(light->index_of, i);
    const Rgb& lambertian = at(diffuse, i);
    return g < 0 ? lambertian
                 : lambertian + light->reflected[static_cast<std::size_t>(g) * passes() + k];
  };
  for (const Transfer& t : exchanges) {
    at(sum, t.receiver) += t.area * radiance(t.source);
    at(sum, t.source) += t.area * radiance(t.receiver);
  }
}

GlossySolver::Impl::PassLight GlossySolver::Impl::make(int k, bool from_kept) const {
  PassLight made;
  made.gathered.resize(input.patch_count());
  if (from_kept) {
    gather(kept->of_pass(k), static_cast<std::size_t>(k), made.gathered);
    return made;
  }
  Pass& pass_made = made.pass;
  pass_made.transfers = input.engine(at(light->directions, k), input.requested);
  gather(pass_made.transfers.exchanges, static_cast<std::size_t>(k), made.gathered);
  if (k >= known_passes) {
    if (kept->available()) {
      made.sorted = kept->sort(pass_made.transfers);
    }
    pass_made.closure = closure_defect(pass_made.transfers, *input.scene);
    pass_made.exchanges = std::ssize(pass_made.transfers.exchanges);
    for (std::size_t i = 0; i < pass_made.transfers.forward.size(); ++i) {
      const Coverage &forward = pass_made.transfers.forward[i],
                     &backward = pass_made.transfers.backward[i];
      pass_made.projected += forward.projected + backward.projected;
      pass_made.covered += forward.covered + backward.covered;
    }
  }
  return made;
}

void GlossySolver::Impl::set_of_pass(int k, bool is_new, const PassLight& made) {
  const auto slot = [&](std::size_t g) { return g * passes() + static_cast<std::size_t>(k); };
  const Transfers& transfers = made.pass.transfers;
  const Sky& sky = input.options.sky;
  if (is_new) {
    for (std::size_t g = 0; g < glossy.size(); ++g) {
      seen[slot(g)] = 0;  // set by a pass that was canceled
    }
    for (const Transfer& t : transfers.exchanges) {
      for (const PatchId i : {t.receiver, t.source}) {
        if (const std::int32_t g = at(light->index_of, i); g >= 0) {
          seen[slot(static_cast<std::size_t>(g))] += t.area;
        }
      }
    }
  }
  if (is_new && sky.is_set()) {
    const double ahead = sky.relative_radiance(transfers.direction);
    const double behind = sky.relative_radiance(-transfers.direction);
    for (std::size_t g = 0; g < glossy.size(); ++g) {
      sky_seen[slot(g)] = (ahead * at(transfers.forward, glossy[g]).uncovered() +
                           behind * at(transfers.backward, glossy[g]).uncovered()) /
                          input.scene->patch(glossy[g]).area;
    }
  }
  for (std::size_t g = 0; g < glossy.size(); ++g) {
    Rgb& arriving = incoming[slot(g)];
    arriving = 1 / input.scene->patch(glossy[g]).area * at(made.gathered, glossy[g]);
    if (sky.is_set()) {
      arriving += sky_seen[slot(g)] / std::numbers::pi * sky.exitance;
    }
  }
}

void GlossySolver::Impl::add_new(int k, PassLight& made) {
  const Transfers& transfers = made.pass.transfers;
  const std::size_t replica = light->replica_of(static_cast<std::size_t>(k));
  std::vector<double>& sky_area = replicas[replica].sky_area;
  statistics->add(made.pass);
  replicas[replica].areas.add(transfers, true, input.owned());
  const Sky& sky = input.options.sky;
  if (sky.is_set()) {
    const double ahead = sky.relative_radiance(transfers.direction);
    const double behind = sky.relative_radiance(-transfers.direction);
    for (std::size_t i = 0; i < sky_area.size(); ++i) {
      sky_area[i] += ahead * transfers.forward[i].uncovered();
      sky_area[i] += behind * transfers.backward[i].uncovered();
    }
  }
  if (kept->available()) {
    kept->add(static_cast<std::size_t>(k), replica, std::move(made.sorted));
  }
  known_passes = k + 1;
}

/// By patch, then in the order of the passes.
void GlossySolver::Impl::add_all(const std::vector<PassLight>& batch, WorkerThreads& workers) {
  const std::size_t patches = input.patch_count(), first_pass = static_cast<std::size_t>(pass);
  const std::size_t tasks = (patches + patches_per_task - 1) / patches_per_task;
  for_each_index(workers, std::size_t{0}, tasks, [&](std::size_t task) {
    const std::size_t first = task * patches_per_task;
    const std::size_t last = std::min(first + patches_per_task, patches);
    for (std::size_t b = 0; b < batch.size(); ++b) {
      std::vector<Rgb>& gathered = replicas[light->replica_of(first_pass + b)].gathered;
      for (std::size_t i = first; i < last; ++i) {
        gathered[i] += batch[b].gathered[i];
      }
    }
  });
}

bool GlossySolver::Impl::gather_passes(WorkerThreads& workers, const Observer& observer,
                                       bool one_pass) {
  const bool from_kept = kept_finished;
  const int all = static_cast<int>(passes());
  if (pass == 0) {
    for (std::size_t r = 0; r < replicas.size(); ++r) {
      std::vector<Rgb>& gathered = replicas[r].gathered;
      std::fill(gathered.begin(), gathered.end(), Rgb{});
      if (from_kept) {
        kept->gather_diffuse(r, light->lambertian[r], gathered);
      }
    }
  }
  const int most = one_pass && !from_kept ? 1 : batch_per_thread * input.threads;
  while (pass < all) {
    const auto start = Clock::now();
    const int count = std::min(most, all - pass);
    std::vector<PassLight> batch(static_cast<std::size_t>(count));
    for_each_index(workers, 0, count, [&](int b) {
      input.requested.throw_if_canceled();
      const int k = pass + b;
      at(batch, b) = make(k, from_kept);
      set_of_pass(k, k >= known_passes && !from_kept, at(batch, b));
    });
    add_all(batch, workers);
    for (PassLight& made : batch) {
      if (pass >= known_passes) {
        add_new(pass, made);
      }
      ++pass;
    }
    const double seconds = seconds_since(start);
    (from_kept ? timing.seconds_iterate : timing.seconds_transfers) += seconds;
    iteration_seconds += seconds;
    timing.passes_made += from_kept ? 0 : count;
    const bool goes_on = !observer || pass == all || observer(progress());
    if (pass < all && (!goes_on || most == 1)) {
      return false;
    }
  }
  return true;
}

}  // namespace transillum
