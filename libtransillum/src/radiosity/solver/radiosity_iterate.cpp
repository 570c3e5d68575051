// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// One iterate B(n) of eq. 11: gathers along passes or from kept sums, normalizes, and ends
// iterations.
//
// Notation: M passes; S_ij the kept sum of areas of receiver i and source j; d the scales of the
// symmetric normalization; a `row` is a receiver; `unshot` is B without the exitance of the first
// shot.
#include "radiosity/solver/radiosity_iterate.h"

#include <algorithm>
#include <cmath>

#include "radiosity/solver/conjugate_gradients.h"
#include "transillum/at.h"

namespace transillum {
RadiosityIterate::RadiosityIterate(const Scene& scene, const SolveOptions& options,
                                   const DirectLight& shot, const PatchShare& share)
    : scene_(scene),
      shot_(shot),
      share_(share),
      two_way_(options.two_way),
      normalization_(options.normalize),
      sky_(options.sky),
      h_(shot.irradiance) {
  const auto patches = scene.patches().size();
  b_.resize(patches);
  unshot_.resize(patches);
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    set_radiosity(i, radiosity(i, at(h_, i)));
  }
  gathered_.resize(patches);
  projected_.resize(patches);
  sky_areas_.resize(sky_.set() ? patches : 0);
}

void RadiosityIterate::start_from(const Rgb& gathered) {
  for (PatchId i = 0; i < scene_.patch_count(); ++i) {
    set_radiosity(i, radiosity(i, irradiance(i, gathered)));
  }
}

void RadiosityIterate::start_from(const RadiosityIterate& other) {
  b_ = other.b_;
  unshot_ = other.unshot_;
}

void RadiosityIterate::begin() {
  std::fill(gathered_.begin(), gathered_.end(), Rgb{});
  std::fill(projected_.begin(), projected_.end(), 0.0);
  std::fill(sky_areas_.begin(), sky_areas_.end(), 0.0);
  passes_ = 0;
}

void RadiosityIterate::begin(const KeptSums& sums) {
  if (kept_passes_ == 0) {  // of a replica that was just added
    begin();
    return;
  }
  gather(sums);
  projected_ = kept_projected_;
  sky_areas_ = kept_sky_areas_;
  passes_ = kept_passes_;
}

void RadiosityIterate::add(const Transfers& transfers) {
  for (const Transfer& t : transfers.exchanges) {
    const auto i = static_cast<std::size_t>(t.receiver);
    const auto j = static_cast<std::size_t>(t.source);
    gathered_[i] += t.area * unshot_[j];
    if (two_way_) {
      gathered_[j] += t.area * unshot_[i];
    }
  }
  const std::size_t first = share_.first();
  for (std::size_t i = first; i < share_.last(); ++i) {
    projected_[i] += transfers.forward[i - first].projected;
    if (two_way_) {
      projected_[i] += transfers.backward[i - first].projected;
    }
  }
  if (!sky_areas_.empty()) {
    add_sky(transfers);
  }
  ++passes_;
}

void RadiosityIterate::add_sky(const Transfers& transfers) {
  const double ahead = sky_.relative_radiance(transfers.direction);
  const double behind = sky_.relative_radiance(-transfers.direction);
  const std::size_t first = share_.first();
  for (std::size_t i = first; i < share_.last(); ++i) {
    sky_areas_[i] += ahead * transfers.forward[i - first].uncovered();
    if (two_way_) {
      sky_areas_[i] += behind * transfers.backward[i - first].uncovered();
    }
  }
}

void RadiosityIterate::complete() {
  share_.complete(gathered_);
  share_.complete(projected_);
  share_.complete(sky_areas_);
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
    share_.complete(gathered_);
    return;
  }
  std::vector<Rgb> scaled(b_.size());
  for (std::size_t i = 0; i < b_.size(); ++i) {
    scaled[i] = scales_[i] * unshot_[i];
  }
  for (const ExchangeSums* part : sums) {
    part->gather(scaled, gathered_);
  }
  share_.complete(gathered_);
  for (std::size_t i = 0; i < b_.size(); ++i) {
    gathered_[i] = scales_[i] * gathered_[i];
  }
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
  share_.complete(image);
}

/// Computes scales d with d_i sum_j S_ij d_j = the area that row i would sum to if its quadrature
/// of the cosine were exact, by the symmetric form of Sinkhorn's iteration.
void RadiosityIterate::find_scales(const KeptSums& sums) {
  constexpr int max_sweeps = 200;
  constexpr double tolerance = 1e-9;
  const std::size_t patches = b_.size();
  const double directions = passes_ * (two_way_ ? 2 : 1);
  scales_.assign(patches, 1.0);
  std::vector<double> wanted(patches), image(patches);
  add_symmetric_product(sums, scales_, image);
  for (std::size_t i = 0; i < patches; ++i) {
    const double exact = directions / 4 * scene_.patches()[i].area;
    wanted[i] = projected_[i] > 0 ? image[i] * exact / projected_[i] : 0.0;
  }
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    double worst = 0;
    for (std::size_t i = 0; i < patches; ++i) {
      const double sum = scales_[i] * image[i];
      if (!(sum > 0)) {
        continue;
      }
      worst = std::max(worst, std::abs(wanted[i] / sum - 1));
      scales_[i] *= std::sqrt(wanted[i] / sum);
    }
    std::fill(image.begin(), image.end(), 0.0);
    add_symmetric_product(sums, scales_, image);
    if (worst <= tolerance) {
      break;
    }
  }
  row_sums_.resize(patches);
  for (std::size_t i = 0; i < patches; ++i) {
    row_sums_[i] = scales_[i] * image[i];
  }
}

/// The factor from what row i gathers in `passes` passes to the irradiance H_i.
double RadiosityIterate::row_scale(std::size_t i, double projected, int passes) const {
  if (normalization_ == Normalization::rows) {
    return projected > 0 ? 1 / projected : 0.0;
  }
  return 4.0 / (passes * (two_way_ ? 2 : 1) * scene_.patches()[i].area);
}

/// Symmetric scales give rows the sums that Normalization::rows gives them, so the sky's part of
/// a row is scaled as there.
double RadiosityIterate::sky_scale(std::size_t i, double projected, int passes) const {
  if (normalization_ == Normalization::none) {
    return row_scale(i, projected, passes);
  }
  return projected > 0 ? 1 / projected : 0.0;
}

double RadiosityIterate::sky_share(PatchId i, double uncovered, double projected,
                                   int passes) const {
  return sky_scale(static_cast<std::size_t>(i), projected, passes) * uncovered;
}

Rgb RadiosityIterate::sky_irradiance(PatchId i) const {
  const auto row = static_cast<std::size_t>(i);
  if (sky_areas_.empty() || passes_ == 0) {
    return {};
  }
  return (sky_scale(row, projected_[row], passes_) * sky_areas_[row]) * sky_.exitance;
}

Rgb RadiosityIterate::gathered_irradiance(PatchId i) const {
  const auto row = static_cast<std::size_t>(i);
  const Rgb from_patches = row_scale(row) * gathered_[row];
  return sky_areas_.empty() ? from_patches : from_patches + sky_irradiance(i);
}

Rgb RadiosityIterate::estimate(PatchId i) const {
  return radiosity(i, irradiance(i, gathered_irradiance(i)));
}

Rgb RadiosityIterate::irradiance(PatchId i, const Rgb& gathered) const {
  return at(shot_.irradiance, i) + gathered;
}

Rgb RadiosityIterate::radiosity(PatchId i, const Rgb& irradiance) const {
  return scene_.exitance(i) + scene_.reflectance(i) * irradiance;
}

void RadiosityIterate::set_radiosity(PatchId i, const Rgb& b) {
  const auto row = static_cast<std::size_t>(i);
  b_[row] = b;
  unshot_[row] = b - shot_.exitance[row];
}

double RadiosityIterate::form_factor_scale(PatchId i, PatchId j, double projected,
                                           int passes) const {
  const auto row = static_cast<std::size_t>(i), column = static_cast<std::size_t>(j);
  return row_scale(row, projected, passes) *
         (scales_.empty() ? 1.0 : scales_[row] * scales_[column]);
}

double RadiosityIterate::form_factor_sum(PatchId i, double row_areas, double projected,
                                         int passes) const {
  const auto row = static_cast<std::size_t>(i);
  return row_scale(row, projected, passes) * (row_sums_.empty() ? row_areas : row_sums_[row]);
}

Rgb RadiosityIterate::sent(const std::vector<double>& column_areas) const {
  const std::vector<double>& columns = row_sums_.empty() ? column_areas : row_sums_;
  Rgb sent;
  for (std::size_t i = 0; i < b_.size(); ++i) {
    sent += columns[i] * unshot_[i];
  }
  return sent;
}

double RadiosityIterate::finish() {
  double change = 0;
  for (PatchId i = 0; i < scene_.patch_count(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    h_[row] = irradiance(i, gathered_irradiance(i));
    const Rgb next = radiosity(i, h_[row]);
    change = std::max(change, max_abs(next - b_[row]));
    set_radiosity(i, next);
  }
  return change;
}

void RadiosityIterate::set_to_limit(const KeptSums& sums, double tolerance,
                                    const Cancellation& cancellation) {
  const double unit = 4.0 / (kept_passes_ * 2);
  const auto patches = scene_.patches().size();
  std::vector<double> weights(patches), emitted(patches), unknown(patches), weighted(patches);
  std::vector<Rgb> result(patches), given = shot_.irradiance;
  for (std::size_t i = 0; i < kept_sky_areas_.size(); ++i) {
    given[i] +=
        (sky_scale(i, kept_projected_[i], kept_passes_) * kept_sky_areas_[i]) * sky_.exitance;
  }
  const auto channel = [&](auto rho_of) {
    // With E the known part of B that was not shot, y_i = sqrt(rho_i A_i) H_i and w_i = d_i
    // sqrt(rho_i / A_i): y - unit w S (w y) = unit w S (d E), a symmetric matrix.
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      const auto row = static_cast<std::size_t>(i);
      const double scale = scales_.empty() ? 1.0 : scales_[row];
      weights[row] = scale * std::sqrt(unit * rho_of(scene_.reflectance(i)) / scene_.patch(i).area);
      const Rgb known = radiosity(i, given[row]);
      emitted[row] = scale * (rho_of(known) - rho_of(shot_.exitance[row]));
    }
    std::vector<double> right(patches);
    add_symmetric_product(sums, emitted, right);
    for (std::size_t i = 0; i < patches; ++i) {
      right[i] *= weights[i] * std::sqrt(unit);
    }
    solve_by_conjugate_gradients(
        [&](const double* x, double* y) {
          share_.throw_if_canceled(cancellation);
          std::vector<double> image(patches);
          for (std::size_t i = 0; i < patches; ++i) {
            weighted[i] = weights[i] * x[i];
          }
          add_symmetric_product(sums, weighted, image);
          for (std::size_t i = 0; i < patches; ++i) {
            y[i] = x[i] - weights[i] * image[i];
          }
        },
        right, tolerance, unknown);
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      const auto row = static_cast<std::size_t>(i);
      const double share = std::sqrt(rho_of(scene_.reflectance(i)) / scene_.patch(i).area);
      const Rgb known = radiosity(i, given[row]);
      rho_of(result[row]) = rho_of(known) + share * unknown[row];
    }
  };
  const auto channels = {&Rgb::r, &Rgb::g, &Rgb::b};
  for (const auto member : channels) {
    channel([member](auto& color) -> auto& { return color.*member; });
  }
  for (PatchId i = 0; i < scene_.patch_count(); ++i) {
    set_radiosity(i, at(result, i));
  }
}

}  // namespace transillum
