// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The columns of the two patch tables, computed from a snapshot.
#include "patches/table_rows.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <map>
#include <utility>

#include "colors/color_scale.h"
#include "colors/quantity.h"
#include "model/snapshot_values.h"
#include "transillum/at.h"

namespace transillum::viewer {

namespace {

using Kind = PatchColumn::Kind;

QString tr(const char* text) { return QCoreApplication::translate("PatchColumns", text); }

// The column of value(i) over all patches i.
template <class Value>
PatchColumn column(const std::vector<PatchId>& patches, QString title, QString tip,
                   std::string csv_name, Kind kind, const Value& value) {
  PatchColumn result{std::move(title), std::move(tip), std::move(csv_name), kind, {}};
  result.values.reserve(patches.size());
  for (const PatchId i : patches) {
    if constexpr (std::is_same_v<decltype(value(i)), Rgb>) {
      result.values.push_back(value(i));
    } else {
      result.values.push_back({static_cast<double>(value(i)), 0, 0});
    }
  }
  return result;
}

// Names are numbered alphabetically, so that sorting by number sorts by name.
PatchColumn material_column(const std::vector<PatchId>& patches, const Scene& scene) {
  std::map<QString, int> names;
  for (const Material& material : scene.materials()) {
    names.emplace(QString::fromStdString(material.name), 0);
  }
  QStringList sorted;
  for (auto& [name, number] : names) {
    number = sorted.size();
    sorted << name;
  }
  std::vector<int> number_of_material;
  for (const Material& material : scene.materials()) {
    number_of_material.push_back(names.at(QString::fromStdString(material.name)));
  }
  PatchColumn result =
      column(patches, tr("Material"), tr("Material of the patch"), "material", Kind::text,
             [&](PatchId i) { return at(number_of_material, scene.patch(i).material); });
  result.texts = sorted;
  return result;
}

PatchColumn patch_column(const std::vector<PatchId>& patches) {
  return column(patches, tr("Patch"), tr("Number of the patch"), "patch", Kind::integer,
                [](PatchId i) { return i; });
}

}  // namespace

PatchRows rows_of_all(const SolverSnapshot& snapshot) {
  const Scene& scene = *snapshot.loaded->scene;
  PatchRows rows;
  rows.patches.resize(static_cast<std::size_t>(scene.patch_count()));
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    at(rows.patches, i) = i;
  }
  const auto add = [&](const QString& title, const QString& tip, const char* csv_name, Kind kind,
                       const auto& value) {
    rows.columns.push_back(column(rows.patches, title, tip, csv_name, kind, value));
  };
  const auto add_quantity = [&](Quantity quantity, const char* csv_name) {
    const PatchValues shown = values_of(quantity, snapshot, no_patch, nullptr);
    if (shown.values.empty()) {
      return;
    }
    const QuantityTraits& traits = traits_of(quantity);
    const QString unit = QString::fromUtf8(traits.unit);
    add(QString::fromUtf8(traits.symbol) + (unit.isEmpty() ? unit : ", " + unit), tip_of(quantity),
        csv_name, traits.has_channels ? Kind::channels : Kind::number,
        [&](PatchId i) { return at(shown.values, i); });
  };
  rows.columns.push_back(patch_column(rows.patches));
  rows.columns.push_back(material_column(rows.patches, scene));
  add_quantity(Quantity::radiosity, "B");
  add_quantity(Quantity::exitance, "E");
  add_quantity(Quantity::reflectance, "rho");
  add_quantity(Quantity::irradiance, "H");
  add(tr("Area, m²"), tr("Area of the patch"), "area", Kind::number,
      [&](PatchId i) { return scene.patch(i).area; });
  add(tr("Face"), tr("Its face in the file, counted from 0"), "face", Kind::integer,
      [&](PatchId i) { return scene.patch(i).face; });
  add_quantity(Quantity::form_factor_sum, "F_sum");
  add_quantity(Quantity::sky_fraction, "sky");
  const std::vector<int> fragments = fragment_counts(*snapshot.loaded);
  add(tr("Fragments"), tr("Number of fragments after the BSP tree"), "fragments", Kind::integer,
      [&](PatchId i) { return at(fragments, i); });
  add_quantity(Quantity::error, "SE");
  add_quantity(Quantity::last_change, "change");
  return rows;
}

PatchRows rows_of_partners(const SolverSnapshot& snapshot, PatchId i) {
  const Scene& scene = *snapshot.loaded->scene;
  const std::vector<double> from = form_factors_from(*snapshot.form_factors, i);
  const std::vector<double> to = form_factors_to(*snapshot.form_factors, i);
  const auto received = [&](PatchId j) {
    return scene.patch(i).area * at(from, j) * at(snapshot.radiosity, j);
  };
  PatchRows rows;
  double total = 0;
  for (PatchId j = 0; j < scene.patch_count(); ++j) {
    constexpr double rounding = 1e-13;  // for exchanges along a common edge
    if (!(at(from, j) > rounding || at(to, j) > rounding)) {
      continue;
    }
    rows.patches.push_back(j);
    total += luminance(received(j));
  }
  const auto add = [&](const QString& title, const QString& tip, const char* csv_name, Kind kind,
                       const auto& value) {
    rows.columns.push_back(column(rows.patches, title, tip, csv_name, kind, value));
  };
  rows.columns.push_back(patch_column(rows.patches));
  rows.columns.push_back(material_column(rows.patches, scene));
  add(tr("F i→j"),
      tr("Form factor: the fraction of the power sent by the selected patch i that reaches j"),
      "F_ij", Kind::number, [&](PatchId j) { return at(from, j); });
  add(tr("Received, W"), tr("Power that i receives from j: A_i F_ij B_j"), "received",
      Kind::channels, received);
  add(tr("Fraction, %"), tr("Fraction of the total that i receives, by luminance"), "share_percent",
      Kind::number,
      [&](PatchId j) { return total > 0 ? 100 * luminance(received(j)) / total : 0.0; });
  add(tr("F j→i"), tr("Form factor: the fraction of the power sent by j that reaches i"), "F_ji",
      Kind::number, [&](PatchId j) { return at(to, j); });
  add(tr("Sent, W"), tr("Power that j receives from i: A_j F_ji B_i"), "sent", Kind::channels,
      [&](PatchId j) { return scene.patch(j).area * at(to, j) * at(snapshot.radiosity, i); });
  add(tr("B, W/m²"), tr("Radiosity of j"), "B", Kind::channels,
      [&](PatchId j) { return at(snapshot.radiosity, j); });
  return rows;
}

namespace {

using Kind = PatchColumn::Kind;

QString surface_text(const char* text) {
  return QCoreApplication::translate("SurfaceColumns", text);
}

/// A column of names: values are positions in the sorted list, so that sorting sorts by name.
PatchColumn column_of_names(const QString& title, const QString& tip, const char* csv_name,
                            const QStringList& names) {
  PatchColumn column{title, tip, csv_name, Kind::text, {}};
  column.texts = names;
  std::sort(column.texts.begin(), column.texts.end(),
            [](const QString& a, const QString& b) { return a.localeAwareCompare(b) < 0; });
  for (const QString& name : names) {
    column.values.push_back({1.0 * column.texts.indexOf(name), 0, 0});
  }
  return column;
}

QString with_luminance(const QString& meaning) {
  return meaning + QLatin1Char('\n') +
         surface_text("Shown and sorted by luminance; point at a row for all");
}

}  // namespace

QString surface_text(const SurfacePower& surface) {
  return surface.index < 0 ? surface_text("(no group)") : QString::fromStdString(surface.name);
}

PatchRows rows_of_parts(const PowerTable& table, bool received_known) {
  PatchRows rows;
  QStringList names;
  for (const SurfacePower& surface : table.surfaces) {
    rows.patches.push_back(static_cast<PatchId>(rows.patches.size()));
    names << surface_text(surface);
  }
  rows.columns.push_back(column_of_names(surface_text("Name"),
                                         surface_text("Name in the scene's file"), "name", names));
  const auto add_number = [&](const QString& title, const QString& tip, const char* csv_name,
                              Kind kind, auto member) {
    PatchColumn column{title, tip, csv_name, kind, {}};
    for (const SurfacePower& surface : table.surfaces) {
      column.values.push_back({static_cast<double>(surface.*member), 0, 0});
    }
    rows.columns.push_back(std::move(column));
  };
  const auto add_power = [&](const QString& title, const QString& tip, const char* csv_name,
                             Rgb SurfacePower::*member) {
    PatchColumn column{title, with_luminance(tip), csv_name, Kind::channels, {}};
    for (const SurfacePower& surface : table.surfaces) {
      column.values.push_back(surface.*member);
    }
    rows.columns.push_back(std::move(column));
  };
  add_number(surface_text("Patches"), surface_text("Number of patches"), "patches", Kind::integer,
             &SurfacePower::patches);
  add_number(surface_text("Area, m²"), surface_text("Sum of the areas"), "area", Kind::number,
             &SurfacePower::area);
  add_power(surface_text("Emitted, W"), surface_text("Power emitted: Σ A E"), "emitted",
            &SurfacePower::emitted);
  if (received_known) {
    add_power(surface_text("Received, W"), surface_text("Power received, from all sides: Σ A H"),
              "received", &SurfacePower::received);
    add_power(surface_text("Absorbed, W"), surface_text("Power absorbed: Σ A (1 − ρ) H"),
              "absorbed", &SurfacePower::absorbed);
    if (max_abs(table.total.from_sky) > 0) {
      add_power(surface_text("From sky, W"),
                surface_text("The part of the power received that comes from the sky"), "from_sky",
                &SurfacePower::from_sky);
    }
    if (max_abs(table.total.from_sun) > 0) {
      add_power(surface_text("From sun, W"),
                surface_text("The part of the power received that comes from the sun"), "from_sun",
                &SurfacePower::from_sun);
    }
    if (max_abs(table.total.escaped) > 0) {
      add_power(surface_text("Escaped, W"), surface_text("Power that leaves and meets no patch"),
                "escaped", &SurfacePower::escaped);
    }
  }
  return rows;
}

PatchRows rows_of_exchanges(const PowerTable& table) {
  PatchRows rows;
  const std::size_t count = table.exchanged.size();
  double largest = 0;
  for (const auto& row : table.exchanged) {
    for (const Rgb& power : row) {
      largest = std::max(largest, max_abs(power));
    }
  }
  constexpr double rounding = 1e-13;  // exchanges along an edge that two patches share are below
                                      // this
  QStringList senders, receivers;
  PatchColumn power{
      surface_text("Power, W"),
      with_luminance(surface_text("Power that leaves one group or material and reaches the other "
                                  "directly: Σ A F B")),
      "power",
      Kind::channels,
      {}};
  PatchColumn fraction{
      surface_text("Fraction, %"),
      surface_text("Fraction of the power that the receiver gets from all patches, by luminance"),
      "share_percent",
      Kind::number,
      {}};
  for (std::size_t i = 0; i < count; ++i) {
    double received = 0;
    for (const Rgb& from : table.exchanged[i]) {
      received += luminance(from);
    }
    for (std::size_t j = 0; j < count; ++j) {
      const Rgb& from = table.exchanged[i][j];
      if (!(max_abs(from) > rounding * largest)) {
        continue;
      }
      rows.patches.push_back(static_cast<PatchId>(i * count + j));
      senders << surface_text(table.surfaces[j]);
      receivers << surface_text(table.surfaces[i]);
      power.values.push_back(from);
      fraction.values.push_back({received > 0 ? 100 * luminance(from) / received : 0, 0, 0});
    }
  }
  rows.columns.push_back(column_of_names(surface_text("From"),
                                         surface_text("Group or material that the light leaves"),
                                         "from", senders));
  rows.columns.push_back(column_of_names(
      surface_text("To"), surface_text("Group or material that the light reaches next"), "to",
      receivers));
  rows.columns.push_back(std::move(power));
  rows.columns.push_back(std::move(fraction));
  return rows;
}

PatchRows rows_of_errors(const ErrorReport& report) {
  PatchRows rows;
  QStringList names;
  for (const SurfaceCauses& surface : report.surfaces) {
    rows.patches.push_back(static_cast<PatchId>(rows.patches.size()));
    const QString name = QString::fromStdString(surface.name);
    names << (surface.is_dark ? surface_text("%1 (dark)").arg(name) : name);
  }
  rows.columns.push_back(column_of_names(surface_text("Surface"),
                                         surface_text("Group, material or connected component"),
                                         "surface", names));
  const auto add = [&](const char* title, const char* tip, const char* csv_name,
                       const auto& error) {
    PatchColumn column{surface_text(title), surface_text(tip), csv_name, Kind::percent, {}};
    for (const SurfaceCauses& surface : report.surfaces) {
      column.values.push_back({100 * error(surface.errors), 0, 0});
    }
    rows.columns.push_back(std::move(column));
  };
  add("Total", "The sum of the four errors beside it", "total_percent",
      [](const CauseErrors& errors) { return errors.total(); });
  add("Directions", "Too few directions: at most that in 95 % of all runs, by replicas",
      "directions_percent", [](const CauseErrors& errors) { return errors.directions; });
  add("Patches", "Too large patches: estimated by a solve with all of them divided",
      "patches_percent", [](const CauseErrors& errors) { return errors.patches; });
  add("Iterations", "Too few iterations: a bound of what further ones would change",
      "iterations_percent", [](const CauseErrors& errors) { return errors.iterations; });
  add("Method", "The engine, compared with another one, the first shot, and light that is lost",
      "method_percent", [](const CauseErrors& errors) { return errors.method; });
  return rows;
}

}  // namespace transillum::viewer
