// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Sums of power over the patches of groups or materials. Input: a Solution, and form factors for
// what parts exchange.
#include "radiosity/analysis/power_table.h"

#include "base/choice.h"
#include "radiosity/ratio.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/glossy.h"

namespace transillum {
namespace {

/// Which part each patch is in.
struct Division {
  std::vector<std::string> names;     ///< names of the parts that have patches
  std::vector<std::int32_t> indices;  ///< indices of the parts in the scene; -1: no group
  std::vector<std::size_t> of_patch;  ///< index in `names`
};

Division divide(const Scene& scene, SurfaceKind by) {
  const bool groups = by == SurfaceKind::group;
  const std::size_t named = groups ? scene.groups().size() : scene.materials().size();
  const auto key = [&](PatchId i) {
    const std::int32_t index = groups ? scene.patch(i).group : scene.patch(i).material;
    return index < 0 ? named : static_cast<std::size_t>(index);
  };
  std::vector<bool> used(named + 1);
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    used[key(i)] = true;
  }
  Division division;
  std::vector<std::size_t> surface(named + 1);
  for (std::size_t k = 0; k <= named; ++k) {
    if (used[k]) {
      surface[k] = division.names.size();
      division.indices.push_back(k == named ? no_group : static_cast<std::int32_t>(k));
      division.names.push_back(k == named ? std::string()
                               : groups   ? scene.groups()[k]
                                          : scene.materials()[k].name);
    }
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    division.of_patch.push_back(surface[key(i)]);
  }
  return division;
}

void add(SurfacePower& to, const SurfacePower& surface) {
  to.patches += surface.patches;
  to.area += surface.area;
  to.emitted += surface.emitted;
  to.received += surface.received;
  to.from_sky += surface.from_sky;
  to.from_sun += surface.from_sun;
  to.absorbed += surface.absorbed;
  to.escaped += surface.escaped;
}

SurfacePower power_of(const Solution& solution, PatchId i, const Material& material,
                      std::span<const Rgb> sun) {
  const double area = solution.scene->patch(i).area;
  const Rgb h = at(solution.irradiance, i);
  const Rgb reflected = solution.statistics.glossy.patches > 0
                            ? material.reflectance + used_lobe(material).reflectance
                            : material.reflectance;
  SurfacePower power{.patches = 1,
                     .area = area,
                     .emitted = area * material.exitance,
                     .received = area * h,
                     .absorbed = area * ((Rgb{1, 1, 1} - reflected) * h)};
  if (!solution.sky_irradiance.empty()) {
    power.from_sun = sun.empty() ? Rgb() : area * at(sun, i);
    power.from_sky = area * at(solution.sky_irradiance, i) - power.from_sun;
  }
  if (!solution.sky_fractions.empty()) {
    power.escaped = (area * at(solution.sky_fractions, i)) * at(solution.radiosity, i);
  }
  return power;
}

/// a / b, per channel; 0 where b is 0.
Rgb quotient(const Rgb& a, const Rgb& b) {
  return {ratio_or_zero(a.r, b.r), ratio_or_zero(a.g, b.g), ratio_or_zero(a.b, b.b)};
}

/// Adds up what parts exchange by form factors. What a patch receives besides, because a first shot
/// is more accurate, is direct light: sources have it in proportion to theirs by form factors, or
/// where no direction has met one, to what they emit.
class Exchanges {
 public:
  Exchanges(const Solution& solution, const Division& division, const FormFactors& form_factors,
            const PowerTable& table, const std::vector<Rgb>& exitance)
      : solution_(solution),
        division_(division),
        form_factors_(form_factors),
        table_(table),
        exitance_(exitance) {
    if (form_factors.row_begin.size() != solution.radiosity.size() + 1) {
      throw InputError("the form factors belong to another scene: the number of patches differs");
    }
    if (!solution.linear_terms.empty() && form_factors.moments.size() != form_factors.size()) {
      throw InputError("the form factors have no moments for the linear functions of the solution");
    }
  }

  /// Adds what patch i receives to a row of PowerTable::exchanged.
  void add(std::size_t i, std::vector<Rgb>& row) const {
    const double area = solution_.scene->patches()[i].area;
    Rgb missing = area * solution_.irradiance[i], direct;
    if (!solution_.sky_irradiance.empty()) {
      missing = missing - area * solution_.sky_irradiance[i];
    }
    const std::size_t begin = form_factors_.row_begin[i], end = form_factors_.row_begin[i + 1];
    for (std::size_t k = begin; k < end; ++k) {
      const Rgb power = area * irradiance_by(k);
      row[part_of(k)] += power;
      missing = missing - power;
      direct += area * direct_by(k);
    }
    const Rgb share = quotient(missing, direct);
    for (std::size_t k = begin; k < end; ++k) {
      row[part_of(k)] += share * (area * direct_by(k));
    }
    const Rgb unmet = quotient(missing - share * direct, table_.total.emitted);
    for (std::size_t part = 0; part < row.size(); ++part) {
      row[part] += unmet * table_.surfaces[part].emitted;
    }
  }

 private:
  std::size_t part_of(std::size_t k) const {
    return at(division_.of_patch, form_factors_.source[k]);
  }
  Rgb direct_by(std::size_t k) const {
    return form_factors_.value[k] * at(exitance_, form_factors_.source[k]);
  }
  Rgb irradiance_by(std::size_t k) const {
    const PatchId j = form_factors_.source[k];
    Rgb h = form_factors_.value[k] * at(solution_.radiosity, j);
    if (!solution_.linear_terms.empty()) {
      const TransferMoments& moments = form_factors_.moments[k];
      const LinearTerm& surface = at(solution_.linear_terms, j);
      h += moments.of(0, 1) * surface.first + moments.of(0, 2) * surface.second;
    }
    return h;
  }

  const Solution& solution_;
  const Division& division_;
  const FormFactors& form_factors_;
  const PowerTable& table_;
  const std::vector<Rgb>& exitance_;
};

}  // namespace

namespace {

constexpr std::array kinds_of_surfaces{
    Choice{SurfaceKind::group, "group"},
    Choice{SurfaceKind::material, "material"},
};

}  // namespace

template <>
const Choices& choices_of<SurfaceKind>() {
  return texts_of<kinds_of_surfaces>("kind of surfaces");
}

double escaped_share(const SurfacePower& total) {
  const Rgb all = total.emitted + total.from_sky + total.from_sun;
  return ratio_or_zero(total.escaped.r + total.escaped.g + total.escaped.b, all.r + all.g + all.b);
}

bool is_open(const SolveStatistics& statistics) {
  const bool by_directions = statistics.pairs == 0 && statistics.hemicubes == 0;
  return statistics.escaped > (by_directions ? 1e-9 : 1e-3);
}

PowerTable power_table(const Solution& solution, SurfaceKind by, const FormFactors* form_factors,
                       std::span<const Material> materials,
                       std::span<const std::int32_t> patch_materials, std::span<const Rgb> sun) {
  const Division division = divide(*solution.scene, by);
  PowerTable table;
  table.escape_known = !solution.sky_fractions.empty();
  for (std::size_t surface = 0; surface < division.names.size(); ++surface) {
    table.surfaces.push_back({.name = division.names[surface], .index = division.indices[surface]});
  }
  std::vector<Rgb> exitance;
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    const Material& material =
        materials.empty() ? solution.scene->material(i) : at(materials, at(patch_materials, i));
    exitance.push_back(material.exitance);
    add(table.surfaces[at(division.of_patch, i)], power_of(solution, i, material, sun));
  }
  table.total.name = "total";
  for (const SurfacePower& surface : table.surfaces) {
    add(table.total, surface);
  }
  if (form_factors != nullptr) {
    const std::size_t parts = table.surfaces.size();
    const Exchanges exchanges(solution, division, *form_factors, table, exitance);
    table.exchanged.assign(parts, std::vector<Rgb>(parts));
    for (std::size_t i = 0; i < exitance.size(); ++i) {
      exchanges.add(i, table.exchanged[division.of_patch[i]]);
    }
  }
  return table;
}

}  // namespace transillum
