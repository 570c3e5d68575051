// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Form factors in files: the format is chosen by the ending of the name. What is read is checked
// against the scene before it is used.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/text_file.h"
#include "io/factors/factor_formats.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum {
namespace {

/// Largest form factor that the quadrature gives: one direction, one way (ALGORITHM.md, section 6).
constexpr double largest_factor = 4;

using FactorWriter = void (*)(std::ostream&, const Scene&, const FormFactors&);

FactorWriter writer_for(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  if (ending == ".csv" || ending.empty()) {  // without one: a device such as /dev/stdout
    return [](std::ostream& out, const Scene&, const FormFactors& form_factors) {
      write_form_factors_csv(out, form_factors);
    };
  }
  if (ending == ".npz") {
    return write_factors_npz;
  }
  if (ending == ".mtx") {
    return write_factors_mtx;
  }
  if (ending == ".vf") {
    return write_factors_view3d;
  }
  throw InputError(fmt::format(
      "{}: the name of a file of form factors must end in .csv, .npz, .mtx or .vf", path.string()));
}

double value_at(const FormFactors& form_factors, PatchId i, PatchId j) {
  const auto row = static_cast<std::size_t>(i);
  const auto begin = form_factors.source.begin();
  const auto first = begin + static_cast<std::ptrdiff_t>(form_factors.row_begin[row]);
  const auto last = begin + static_cast<std::ptrdiff_t>(form_factors.row_begin[row + 1]);
  const auto found = std::lower_bound(first, last, j);
  return found != last && *found == j ? form_factors.value[static_cast<std::size_t>(found - begin)]
                                      : 0;
}

/// @throws InputError where A_i F_ij and A_j F_ji differ too much for the scene's areas to be those
/// of the form factors.
void check_reciprocity(const Scene& scene, const StoredFormFactors& stored) {
  constexpr double most = 0.1;
  const FormFactors& f = stored.form_factors;
  double difference = 0, sum = 0, worst = 0;
  PatchId worst_i = 0, worst_j = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    for (std::size_t k = f.row_begin[row]; k < f.row_begin[row + 1]; ++k) {
      const PatchId j = f.source[k];
      const double there = scene.patch(i).area * f.value[k];
      const double back = scene.patch(j).area * value_at(f, j, i);
      difference += std::abs(there - back);
      sum += there;
      if (std::abs(there - back) > worst) {
        worst = std::abs(there - back);
        worst_i = i;
        worst_j = j;
      }
    }
  }
  if (difference > most * sum) {
    throw InputError(fmt::format(
        "{}: the form factors do not belong to {}: with its areas, A_i F_ij and A_j F_ji differ by "
        "{:.0f} % on average, most between patches {} and {}",
        stored.name, scene.name(), 100 * difference / sum, worst_i, worst_j));
  }
}

void check_areas(const Scene& scene, const StoredFormFactors& stored) {
  if (stored.areas.size() != scene.patches().size()) {
    throw InputError(fmt::format("{}: {} areas for {} patches", stored.name, stored.areas.size(),
                                 scene.patch_count()));
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const double area = scene.patch(i).area, other = at(stored.areas, i);
    if (!(std::abs(other - area) <= 1e-9 * area)) {
      throw InputError(fmt::format(
          "{}: the form factors are of another scene: patch {} has an area of {} m2 there, and of "
          "{} m2 in {}",
          stored.name, i, other, area, scene.name()));
    }
  }
}

}  // namespace

std::string hash_of_polygons(const Scene& scene, ContentHash::Method method) {
  ContentHash hash(method);
  hash.add_polygons(scene);
  return hash.digits();
}

void check_form_factor_path(const std::filesystem::path& path) {
  writer_for(path);
  check_writable(path);
}

void write_form_factors(const std::filesystem::path& path, const Scene& scene,
                        const FormFactors& form_factors) {
  const FactorWriter write = writer_for(path);
  write_file_whole(path, [&](std::ostream& out) { write(out, scene, form_factors); });
}

bool is_form_factor_file(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  return ending == ".npz" || ending == ".mtx";
}

StoredFormFactors read_form_factors(const std::filesystem::path& path,
                                    const Cancellation& cancellation) {
  if (!is_form_factor_file(path)) {
    throw InputError(
        fmt::format("{}: form factors are read from .npz and .mtx files", path.string()));
  }
  if (lower_case_ending(path) == ".npz") {
    const std::string bytes = read_binary_file(path, largest_factor_file);
    return read_factors_npz(path.string(), bytes, cancellation);
  }
  const std::string text = read_text_file(path, largest_factor_file);
  return read_factors_mtx(path.string(), text, cancellation);
}

FormFactors sorted_factors(const std::string& name, PatchId patches,
                           const std::vector<FactorEntry>& entries,
                           const Cancellation& cancellation) {
  std::vector<FactorEntry> sorted = entries;
  cancellation.throw_if_canceled();
  const auto before = [](const FactorEntry& a, const FactorEntry& b) {
    return a.i != b.i ? a.i < b.i : a.j < b.j;
  };
  if (!std::is_sorted(sorted.begin(), sorted.end(), before)) {
    std::stable_sort(sorted.begin(), sorted.end(), before);
  }
  FormFactors form_factors;
  form_factors.row_begin.assign(1, 0);
  form_factors.row_begin.reserve(static_cast<std::size_t>(patches) + 1);
  auto entry = sorted.begin();
  for (PatchId i = 0; i < patches; ++i) {
    for (; entry != sorted.end() && entry->i == i; ++entry) {
      if (!(entry->value >= 0 && entry->value <= largest_factor)) {
        throw InputError(
            fmt::format("{}: F_ij of patches {} and {} is {}, not in the range 0 to {}", name, i,
                        entry->j, entry->value, largest_factor));
      }
      const bool again = form_factors.size() > form_factors.row_begin.back() &&
                         form_factors.source.back() == entry->j;
      if (again) {
        form_factors.value.back() += entry->value;
      } else if (entry->value > 0) {
        form_factors.source.push_back(entry->j);
        form_factors.value.push_back(entry->value);
      }
    }
    form_factors.row_begin.push_back(form_factors.size());
  }
  return form_factors;
}

void add_moments(const std::string& name, std::span<const double> values,
                 const std::vector<FactorEntry>& entries, FormFactors& form_factors) {
  constexpr std::size_t each = std::tuple_size_v<decltype(TransferMoments::value)>;
  if (values.size() != each * entries.size()) {
    throw InputError(fmt::format("{}: {} moments for {} form factors, not {} for each", name,
                                 values.size(), entries.size(), each));
  }
  bool in_order = form_factors.size() == entries.size();
  for (std::size_t k = 0; in_order && k < entries.size(); ++k) {
    const auto row = static_cast<std::size_t>(entries[k].i);
    in_order = form_factors.source[k] == entries[k].j && form_factors.row_begin[row] <= k &&
               k < form_factors.row_begin[row + 1];
  }
  if (!in_order) {
    throw InputError(fmt::format(
        "{}: form factors with moments must be above 0 and in order, one for a pair", name));
  }
  form_factors.moments.resize(entries.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!std::isfinite(values[k])) {
      throw InputError(fmt::format("{}: a moment of patches {} and {} is not finite", name,
                                   entries[k / each].i, entries[k / each].j));
    }
    form_factors.moments[k / each].value[k % each] = values[k];
  }
}

void check_form_factors(const Scene& scene, const StoredFormFactors& stored) {
  const std::size_t patches = stored.form_factors.row_begin.size() - 1;
  if (patches != scene.patches().size()) {
    throw InputError(fmt::format("{}: the form factors are of {} patches, but {} has {}",
                                 stored.name, patches, scene.name(), scene.patch_count()));
  }
  if (stored.areas.empty()) {
    check_reciprocity(scene, stored);
  } else {
    check_areas(scene, stored);
  }
  if (!stored.polygons.empty() &&
      stored.polygons != hash_of_polygons(scene, ContentHash::method_of(stored.polygons))) {
    throw InputError(
        fmt::format("{}: the form factors are of other polygons than {} has: their areas are "
                    "the same, but corners have moved",
                    stored.name, scene.name()));
  }
}

}  // namespace transillum
