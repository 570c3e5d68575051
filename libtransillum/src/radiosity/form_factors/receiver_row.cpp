// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/form_factors/receiver_row.h"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

#include "radiosity/sun_light.h"
#include "transillum/at.h"
#include "visibility/fast/patch_engine.h"

namespace transillum {
namespace {

/// T^00, T^01 and T^02 of a receiver with one source.
using Moments = std::array<double, 3>;

/// Adds what patch i receives along omega, and with two-way passes along -omega.
void add_exchanges(const Transfers& transfers, PatchId i, bool two_way,
                   std::map<PatchId, Moments>& sums) {
  for (std::size_t k = 0; k < transfers.exchanges.size(); ++k) {
    const Transfer& t = transfers.exchanges[k];
    const bool receives = t.receiver == i;
    if (!receives && !two_way) {
      continue;
    }
    Moments& sum = sums[receives ? t.source : t.receiver];
    sum[0] += t.area;
    for (std::size_t b = 1; b < 3 && !transfers.moments.empty(); ++b) {
      const TransferMoments& found = transfers.moments[k];
      sum[b] += receives ? found.of(0, b) : found.of(b, 0);
    }
  }
}

}  // namespace

ReceiverRow row_of(const FormFactors& form_factors, PatchId i) {
  ReceiverRow row;
  for (std::size_t k = at(form_factors.row_begin, i); k < at(form_factors.row_begin, i + 1); ++k) {
    row.source.push_back(form_factors.source[k]);
    row.value.push_back(form_factors.value[k]);
    if (!form_factors.moments.empty()) {
      const TransferMoments& moments = form_factors.moments[k];
      row.moments.push_back({moments.of(0, 1), moments.of(0, 2)});
    }
  }
  return row;
}

Rgb sun_on_patch(const std::shared_ptr<const Scene>& scene,
                 const std::shared_ptr<const BspTree>& tree, PatchId i, const SolveOptions& options,
                 const Cancellation& cancellation) {
  const Sun& sun = options.sky.sun;
  if (!sun.is_set()) {
    return {};
  }
  const TransferEngine engine = make_patch_engine(Engine::fast, scene, tree, i);
  double lit = 0;
  for (const SunRay& ray : rays_of(sun)) {
    lit += ray.weight * at(engine(ray.direction, cancellation).forward, i).uncovered();
  }
  return (lit / scene->patch(i).area) * sun.irradiance;
}

ReceiverRow receiver_row(const std::shared_ptr<const Scene>& scene,
                         const std::shared_ptr<const BspTree>& tree, PatchId i,
                         std::span<const Vec3> directions, const SolveOptions& options,
                         const Cancellation& cancellation,
                         const std::function<void(double)>& progress) {
  if (options.normalize == Normalization::symmetric) {
    throw std::invalid_argument("one row has no symmetric normalization");
  }
  EngineOptions engine_options = options.engine_options;
  engine_options.seed = options.seed;
  engine_options.moments = options.basis == Basis::linear;
  const TransferEngine engine = make_patch_engine(options.engine, scene, tree, i, engine_options);
  std::map<PatchId, Moments> sums;
  double projected = 0;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const Transfers transfers = engine(directions[k], cancellation);
    add_exchanges(transfers, i, options.two_way, sums);
    projected += at(transfers.forward, i).projected;
    projected += options.two_way ? at(transfers.backward, i).projected : 0;
    if (progress) {
      progress(static_cast<double>(k + 1) / static_cast<double>(directions.size()));
    }
  }
  const double passes = static_cast<double>(directions.size()) * (options.two_way ? 2 : 1);
  const double scale = options.normalize == Normalization::none
                           ? 4 / (passes * scene->patch(i).area)
                           : (projected > 0 ? 1 / projected : 0.0);
  ReceiverRow row;
  for (const auto& [source, sum] : sums) {
    row.source.push_back(source);
    row.value.push_back(scale * sum[0]);
    if (engine_options.moments) {
      row.moments.push_back({scale * sum[1], scale * sum[2]});
    }
  }
  row.sun = sun_on_patch(scene, tree, i, options, cancellation);
  return row;
}

}  // namespace transillum
