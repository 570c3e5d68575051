// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// One iterate B(n) of eq. 11: gathers along passes or from kept sums, normalizes, and ends
// iterations.
//
// Notation: M passes; S_ij the kept sum of areas of receiver i and source j; d the scales of the
// symmetric normalization; a `row` is a receiver; u and v are unknowns; `unshot` is B without the
// exitance of the first shot.
#include "radiosity/solver/radiosity_iterate.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "radiosity/channel_sums.h"
#include "radiosity/solver/conjugate_gradients.h"
#include "radiosity/solver/symmetric_scales.h"
#include "transillum/at.h"

namespace transillum {

RadiosityIterate::RadiosityIterate(const Unknowns& unknowns, const SolveOptions& options,
                                   const OwnedPatches& owned)
    : unknowns_(unknowns),
      owned_(owned),
      two_way_(options.two_way),
      normalization_(options.normalize),
      sky_(options.sky),
      h_(unknowns.given_irradiance) {
  const std::size_t count = unknowns.count();
  b_.resize(count);
  unshot_.resize(count);
  for (std::size_t u = 0; u < count; ++u) {
    set_radiosity(u, radiosity(u, h_[u]));
  }
  gathered_.resize(count);
  projected_.resize(count);
  sky_areas_.resize(sky_.is_bright() ? count : 0);
}

void RadiosityIterate::start_from(const Rgb& gathered) {
  for (std::size_t u = 0; u < b_.size(); ++u) {
    h_[u] = irradiance(u, gathered);
    set_radiosity(u, radiosity(u, h_[u]));
  }
}

void RadiosityIterate::start_from(const RadiosityIterate& other) {
  b_ = other.b_;
  h_ = other.h_;
  unshot_ = other.unshot_;
}

void RadiosityIterate::begin() {
  std::fill(gathered_.begin(), gathered_.end(), Rgb{});
  std::fill(projected_.begin(), projected_.end(), 0.0);
  std::fill(sky_areas_.begin(), sky_areas_.end(), 0.0);
  passes_ = 0;
}

void RadiosityIterate::begin(const KeptSums& sums) {
  if (kept_passes_ == 0) {  // for a replica that was just added
    begin();
    return;
  }
  gather(sums);
  projected_ = kept_projected_;
  sky_areas_ = kept_sky_areas_;
  passes_ = kept_passes_;
}

void RadiosityIterate::add(const Transfers& transfers) {
  const std::size_t functions = unknowns_.per_patch;
  for_each_exchange(transfers, functions, [this](const Transfer& t, PatchId, PatchId) {
    at(gathered_, t.receiver) += t.area * at(unshot_, t.source);
    if (two_way_) {
      at(gathered_, t.source) += t.area * at(unshot_, t.receiver);
    }
  });
  const std::size_t first = owned_.first();
  for (std::size_t i = first; i < owned_.last(); ++i) {
    for (std::size_t u = functions * i; u < functions * (i + 1); ++u) {
      projected_[u] += transfers.forward[i - first].projected;
      if (two_way_) {
        projected_[u] += transfers.backward[i - first].projected;
      }
    }
  }
  if (!sky_areas_.empty()) {
    add_sky(transfers.direction, transfers.forward, transfers.forward_moments);
    if (two_way_) {
      add_sky(-transfers.direction, transfers.backward, transfers.backward_moments);
    }
  }
  ++passes_;
}

void RadiosityIterate::add_sky(const Vec3& omega, const std::vector<Coverage>& coverages,
                               const std::vector<CoverageMoments>& moments) {
  const double radiance = sky_.relative_radiance(omega);
  const std::size_t first = owned_.first(), functions = unknowns_.per_patch;
  for (std::size_t i = first; i < owned_.last(); ++i) {
    const double uncovered = coverages[i - first].uncovered();
    if (uncovered == 0) {
      continue;
    }
    sky_areas_[functions * i] += radiance * uncovered;
    for (std::size_t a = 1; a < functions; ++a) {
      const CoverageMoments& of_patch = moments[i - first];
      sky_areas_[functions * i + a] +=
          radiance * (of_patch.projected[a - 1] - of_patch.covered[a - 1]);
    }
  }
}

void RadiosityIterate::complete() {
  owned_.complete(gathered_);
  owned_.complete(projected_);
  owned_.complete(sky_areas_);
}

void RadiosityIterate::keep(const KeptSums& sums) {
  kept_projected_ = projected_;
  kept_sky_areas_ = sky_areas_;
  kept_passes_ = passes_;
  if (normalization_ != Normalization::symmetric) {
    return;
  }
  find_scales(sums);
  gather(sums);
}

void RadiosityIterate::gather(const KeptSums& sums) {
  std::fill(gathered_.begin(), gathered_.end(), Rgb{});
  if (scales_.empty()) {
    for (const ExchangeSums* part : sums) {
      part->gather(unshot_, gathered_);
    }
    owned_.complete(gathered_);
    return;
  }
  const std::vector<Rgb> sources = scaled(scales_, unshot_, unknowns_.per_patch);
  for (const ExchangeSums* part : sums) {
    part->gather(sources, gathered_);
  }
  owned_.complete(gathered_);
  gathered_ = scaled(scales_, gathered_, unknowns_.per_patch);
}

void RadiosityIterate::add_symmetric_product(const KeptSums& sums,
                                             const std::vector<double>& values,
                                             std::vector<double>& image) const {
  for (const ExchangeSums* part : sums) {
    part->for_each([&](PatchId first, PatchId second, double area) {
      const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
      image[i] += area * values[j];
      image[j] += area * values[i];
    });
  }
  owned_.complete(image);
}

/// Computes scales with which row i sums to what it would sum to if its quadrature of the cosine
/// were exact, by the symmetric form of Sinkhorn's iteration; with linear functions, its moments
/// too.
void RadiosityIterate::find_scales(const KeptSums& sums) {
  constexpr int max_sweeps = 200;
  constexpr double tolerance = 1e-9;
  const std::size_t count = b_.size(), n = unknowns_.per_patch;
  const double directions = passes_ * (two_way_ ? 2 : 1);
  scales_.assign(count, 0.0);
  for (std::size_t u = 0; u < count; u += n) {
    scales_[u] = 1;
  }
  std::vector<double> wanted(count), image(count);
  add_symmetric_product(sums, scales_, image);
  for (std::size_t u = 0; u < count; ++u) {
    const double exact = directions / 4 * unknowns_.area[u];
    wanted[u] = projected_[u] > 0 ? image[u] * exact / projected_[u] : 0.0;
  }
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    double worst = 0;
    for (std::size_t u = 0; u < count; u += n) {
      worst = std::max(
          worst, improve_scales(std::span(scales_).subspan(u, n), std::span(wanted).subspan(u, n),
                                std::span(image).subspan(u, n)));
    }
    std::fill(image.begin(), image.end(), 0.0);
    add_symmetric_product(sums, scales_, image);
    if (worst <= tolerance) {
      break;
    }
  }
  row_sums_ = scaled(scales_, image, n);
}

/// The factor from what row i gathers in `passes` passes to the irradiance H_i.
double RadiosityIterate::row_scale(std::size_t i, double projected, int passes) const {
  if (normalization_ == Normalization::rows) {
    return projected > 0 ? 1 / projected : 0.0;
  }
  return 4.0 / (passes * (two_way_ ? 2 : 1) * unknowns_.area[i]);
}

/// Symmetric scales give rows the sums that Normalization::rows gives them, so the sky's part of
/// a row is scaled as there.
double RadiosityIterate::sky_scale(std::size_t i, double projected, int passes) const {
  if (normalization_ == Normalization::none) {
    return row_scale(i, projected, passes);
  }
  return projected > 0 ? 1 / projected : 0.0;
}

double RadiosityIterate::sky_fraction(std::size_t u, double uncovered, double projected,
                                      int passes) const {
  return sky_scale(u, projected, passes) * uncovered;
}

Rgb RadiosityIterate::sky_irradiance(std::size_t u) const {
  return unknowns_.sun_irradiance.empty() ? gathered_sky(u)
                                          : gathered_sky(u) + unknowns_.sun_irradiance[u];
}

Rgb RadiosityIterate::gathered_sky(std::size_t u) const {
  if (sky_areas_.empty() || passes_ == 0) {
    return {};
  }
  return (sky_scale(u, projected_[u], passes_) * sky_areas_[u]) * sky_.exitance;
}

Rgb RadiosityIterate::gathered_irradiance(std::size_t u) const {
  const Rgb from_patches = row_scale(u) * gathered_[u];
  return sky_areas_.empty() ? from_patches : from_patches + gathered_sky(u);
}

Rgb RadiosityIterate::estimate(std::size_t u) const {
  return radiosity(u, irradiance(u, gathered_irradiance(u)));
}

Rgb RadiosityIterate::irradiance(std::size_t u, const Rgb& gathered) const {
  return unknowns_.given_irradiance[u] + gathered;
}

Rgb RadiosityIterate::radiosity(std::size_t u, const Rgb& irradiance) const {
  return unknowns_.exitance[u] + unknowns_.reflectance[u] * irradiance;
}

void RadiosityIterate::set_radiosity(std::size_t u, const Rgb& b) {
  b_[u] = b;
  unshot_[u] = b - unknowns_.shot_exitance[u];
}

double RadiosityIterate::form_factor_scale(std::size_t u, std::size_t v, double projected,
                                           int passes) const {
  const bool by_numbers = !scales_.empty() && unknowns_.per_patch == 1;
  return row_scale(u, projected, passes) * (by_numbers ? scales_[u] * scales_[v] : 1.0);
}

void RadiosityIterate::scale_moments(PatchId i, PatchId j, TransferMoments& moments) const {
  const std::size_t n = unknowns_.per_patch;
  if (has_scaled_moments()) {
    moments = scaled(moments, std::span(scales_).subspan(unknowns_.mean_of(i), n),
                     std::span(scales_).subspan(unknowns_.mean_of(j), n));
  }
}

double RadiosityIterate::form_factor_sum(std::size_t u, double row_areas, double projected,
                                         int passes) const {
  return row_scale(u, projected, passes) * (row_sums_.empty() ? row_areas : row_sums_[u]);
}

Rgb RadiosityIterate::sent(const std::vector<double>& column_areas) const {
  const std::vector<double>& columns = row_sums_.empty() ? column_areas : row_sums_;
  Rgb sent;
  for (std::size_t i = 0; i < b_.size(); ++i) {
    sent += columns[i] * unshot_[i];
  }
  return sent;
}

std::vector<Rgb> RadiosityIterate::finish() {
  std::vector<Rgb> changes(b_.size());
  for (std::size_t u = 0; u < b_.size(); ++u) {
    const Rgb before = h_[u];
    h_[u] = irradiance(u, gathered_irradiance(u));
    // The difference of B would lose the digits of a small change to a large E.
    changes[u] = unknowns_.reflectance[u] * (h_[u] - before);
    set_radiosity(u, radiosity(u, h_[u]));
  }
  return changes;
}

void RadiosityIterate::set_to_limit(const KeptSums& sums, double tolerance,
                                    const Cancellation& cancellation) {
  const double unit = 4.0 / (kept_passes_ * 2);
  const std::size_t patches = unknowns_.count();
  const auto mixed = [&](std::vector<double>& values) {
    if (has_scaled_moments()) {
      values = scaled(scales_, values, unknowns_.per_patch);
    }
  };
  std::vector<double> weights(patches), emitted(patches), unknown(patches), weighted(patches);
  std::vector<Rgb> result(patches), given = unknowns_.given_irradiance;
  for (std::size_t i = 0; i < kept_sky_areas_.size(); ++i) {
    given[i] +=
        (sky_scale(i, kept_projected_[i], kept_passes_) * kept_sky_areas_[i]) * sky_.exitance;
  }
  const auto channel = [&](auto rho_of) {
    // With E the known part of B that was not shot, y_i = sqrt(rho_i A_i) H_i and w_i = d_i
    // sqrt(rho_i / A_i): y - unit w S (w y) = unit w S (d E), a symmetric matrix. With linear
    // functions, d_i is a matrix beside S.
    for (std::size_t row = 0; row < patches; ++row) {
      const double scale = scales_.empty() || has_scaled_moments() ? 1.0 : scales_[row];
      weights[row] =
          scale * std::sqrt(unit * rho_of(unknowns_.reflectance[row]) / unknowns_.area[row]);
      const Rgb known = radiosity(row, given[row]);
      emitted[row] = scale * (rho_of(known) - rho_of(unknowns_.shot_exitance[row]));
    }
    std::vector<double> right(patches);
    mixed(emitted);
    add_symmetric_product(sums, emitted, right);
    mixed(right);
    for (std::size_t i = 0; i < patches; ++i) {
      right[i] *= weights[i] * std::sqrt(unit);
    }
    solve_by_conjugate_gradients(
        [&](const double* x, double* y) {
          owned_.throw_if_canceled(cancellation);
          std::vector<double> image(patches);
          for (std::size_t i = 0; i < patches; ++i) {
            weighted[i] = weights[i] * x[i];
          }
          mixed(weighted);
          add_symmetric_product(sums, weighted, image);
          mixed(image);
          for (std::size_t i = 0; i < patches; ++i) {
            y[i] = x[i] - weights[i] * image[i];
          }
        },
        right, tolerance, unknowns_.per_patch > 1 ? Entries::any_sign : Entries::at_least_zero,
        unknown);
    for (std::size_t row = 0; row < patches; ++row) {
      const double owned = std::sqrt(rho_of(unknowns_.reflectance[row]) / unknowns_.area[row]);
      const Rgb known = radiosity(row, given[row]);
      rho_of(result[row]) = rho_of(known) + owned * unknown[row];
      const double rho = rho_of(unknowns_.reflectance[row]);
      rho_of(h_[row]) = rho_of(given[row]) + (rho > 0 ? owned * unknown[row] / rho : 0.0);
    }
  };
  for (const auto member : channels_of_rgb) {
    channel([member](auto& color) -> auto& { return color.*member; });
  }
  for (std::size_t row = 0; row < patches; ++row) {
    set_radiosity(row, result[row]);
  }
}

}  // namespace transillum
