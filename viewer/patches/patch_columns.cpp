// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The columns of the two patch tables, computed from a snapshot.
#include "patches/patch_columns.h"

#include <QCoreApplication>
#include <algorithm>
#include <map>
#include <utility>

#include "colors/color_scale.h"
#include "colors/quantity.h"
#include "model/form_factor_views.h"
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
  add_quantity(Quantity::sky_share, "sky");
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
      tr("Form factor: the share of the power sent by the selected patch i that reaches j"), "F_ij",
      Kind::number, [&](PatchId j) { return at(from, j); });
  add(tr("Received, W"), tr("Power that i receives from j: A_i F_ij B_j"), "received",
      Kind::channels, received);
  add(tr("Share, %"), tr("Share of the total that i receives, by luminance"), "share_percent",
      Kind::number,
      [&](PatchId j) { return total > 0 ? 100 * luminance(received(j)) / total : 0.0; });
  add(tr("F j→i"), tr("Form factor: the share of the power sent by j that reaches i"), "F_ji",
      Kind::number, [&](PatchId j) { return at(to, j); });
  add(tr("Sent, W"), tr("Power that j receives from i: A_j F_ji B_i"), "sent", Kind::channels,
      [&](PatchId j) { return scene.patch(j).area * at(to, j) * at(snapshot.radiosity, i); });
  add(tr("B, W/m²"), tr("Radiosity of j"), "B", Kind::channels,
      [&](PatchId j) { return at(snapshot.radiosity, j); });
  return rows;
}

}  // namespace transillum::viewer
