// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The columns of the tables of groups, materials and what they exchange, from a power table.
#include "patches/part_columns.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <utility>

#include "colors/color_scale.h"
#include "transillum/at.h"

namespace transillum::viewer {

namespace {

using Kind = PatchColumn::Kind;

QString part_text(const char* text) { return QCoreApplication::translate("PartColumns", text); }

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
         part_text("Shown and sorted by luminance; point at a row for all");
}

}  // namespace

QString part_text(const PartPower& part) {
  return part.index < 0 ? part_text("(no group)") : QString::fromStdString(part.name);
}

PatchRows rows_of_parts(const PowerTable& table, bool received_known) {
  PatchRows rows;
  QStringList names;
  for (const PartPower& part : table.parts) {
    rows.patches.push_back(static_cast<PatchId>(rows.patches.size()));
    names << part_text(part);
  }
  rows.columns.push_back(
      column_of_names(part_text("Name"), part_text("Name in the scene's file"), "name", names));
  const auto add_number = [&](const QString& title, const QString& tip, const char* csv_name,
                              Kind kind, auto member) {
    PatchColumn column{title, tip, csv_name, kind, {}};
    for (const PartPower& part : table.parts) {
      column.values.push_back({static_cast<double>(part.*member), 0, 0});
    }
    rows.columns.push_back(std::move(column));
  };
  const auto add_power = [&](const QString& title, const QString& tip, const char* csv_name,
                             Rgb PartPower::*member) {
    PatchColumn column{title, with_luminance(tip), csv_name, Kind::channels, {}};
    for (const PartPower& part : table.parts) {
      column.values.push_back(part.*member);
    }
    rows.columns.push_back(std::move(column));
  };
  add_number(part_text("Patches"), part_text("Number of patches"), "patches", Kind::integer,
             &PartPower::patches);
  add_number(part_text("Area, m²"), part_text("Sum of the areas"), "area", Kind::number,
             &PartPower::area);
  add_power(part_text("Emitted, W"), part_text("Power emitted: Σ A E"), "emitted",
            &PartPower::emitted);
  if (received_known) {
    add_power(part_text("Received, W"), part_text("Power received, from all sides: Σ A H"),
              "received", &PartPower::received);
    add_power(part_text("Absorbed, W"), part_text("Power absorbed: Σ A (1 − ρ) H"), "absorbed",
              &PartPower::absorbed);
    if (max_abs(table.total.from_sky) > 0) {
      add_power(part_text("From sky, W"),
                part_text("The part of the power received that comes from the sky"), "from_sky",
                &PartPower::from_sky);
    }
    if (max_abs(table.total.escaped) > 0) {
      add_power(part_text("Escaped, W"), part_text("Power that leaves and meets no patch"),
                "escaped", &PartPower::escaped);
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
  constexpr double rounding = 1e-13;  // for exchanges along a common edge
  QStringList senders, receivers;
  PatchColumn power{
      part_text("Power, W"),
      with_luminance(part_text("Power that leaves one group or material and reaches the other "
                               "directly: Σ A F B")),
      "power",
      Kind::channels,
      {}};
  PatchColumn share{
      part_text("Share, %"),
      part_text("Fraction of the power that the receiver gets from all patches, by luminance"),
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
      senders << part_text(table.parts[j]);
      receivers << part_text(table.parts[i]);
      power.values.push_back(from);
      share.values.push_back({received > 0 ? 100 * luminance(from) / received : 0, 0, 0});
    }
  }
  rows.columns.push_back(column_of_names(
      part_text("From"), part_text("Group or material that the light leaves"), "from", senders));
  rows.columns.push_back(column_of_names(part_text("To"),
                                         part_text("Group or material that the light reaches next"),
                                         "to", receivers));
  rows.columns.push_back(std::move(power));
  rows.columns.push_back(std::move(share));
  return rows;
}

}  // namespace transillum::viewer
