// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The table behind ReceivedView: one row per direction, sorted here. Its contents come from
// received_light().
#include "directions/received_light.h"

#include <algorithm>
#include <utility>

#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/theme.h"

namespace transillum::viewer {

PerDirectionVisibility::Request visibility_request(const SolverSnapshot& snapshot, int iteration,
                                                   int count, PatchId patch) {
  const SolveOptions& options = snapshot.options;
  return {snapshot.loaded,
          options.engine,
          options.engine_options,
          options.two_way,
          snapshot.directions_of(iteration),
          count,
          patch};
}

std::vector<ReceivedLight> received_light(
    const PerDirectionVisibility::Request& request,
    std::span<const PerDirectionVisibility::VisibleAreas> visible_areas,
    const std::vector<Rgb>& radiosity, int passes) {
  std::vector<ReceivedLight> received;
  const Patch& patch = request.loaded->scene->patch(request.patch);
  const double weight = 4.0 / (passes * (request.two_way ? 2 : 1) * patch.area);
  const auto add = [&](int pass, bool opposite,
                       const std::vector<PerDirectionVisibility::VisibleArea>& areas) {
    const double cosine = dot(patch.normal, at(*request.directions, pass));
    ReceivedLight light;
    light.pass = pass;
    light.opposite = opposite;
    light.cosine = opposite ? -cosine : cosine;
    double largest = 0;
    for (const PerDirectionVisibility::VisibleArea& visible : areas) {
      const Rgb part = weight * visible.area * at(radiosity, visible.source);
      light.area += visible.area;
      light.irradiance += part;
      if (luminance(part) <= largest) {
        continue;
      }
      largest = luminance(part);
      light.brightest = visible.source;
    }
    received.push_back(light);
  };
  for (std::size_t k = 0; k < visible_areas.size(); ++k) {
    add(static_cast<int>(k), false, visible_areas[k].forward);
    if (request.two_way) {
      add(static_cast<int>(k), true, visible_areas[k].backward);
    }
  }
  return received;
}

void ReceivedTable::show_lights(const std::vector<ReceivedLight>& lights, double patch_area) {
  std::vector<ReceivedLight> front_lights;
  irradiance_ = {};
  for (const ReceivedLight& light : lights) {
    if (light.cosine <= 0) {
      continue;
    }
    front_lights.push_back(light);
    irradiance_ += light.irradiance;
  }
  patch_area_ = patch_area;
  set_formats(front_lights);
  sort_lights(front_lights);
  if (front_lights == lights_) {
    return;
  }
  // Insert rows where possible: a reset between the clicks of a double click would lose it.
  const int before = rowCount(), after = static_cast<int>(front_lights.size());
  if (before == 0 || after < before) {
    beginResetModel();
    lights_ = std::move(front_lights);
    endResetModel();
    return;
  }
  if (after > before) {
    beginInsertRows({}, before, after - 1);
  }
  lights_ = std::move(front_lights);
  if (after > before) {
    endInsertRows();
  }
  emit dataChanged(index(0, 0), index(after - 1, column_count - 1));
}

void ReceivedTable::set_formats(const std::vector<ReceivedLight>& lights) {
  double area = 0, irradiance = 0;
  for (const ReceivedLight& light : lights) {
    area = std::max(area, light.area);
    irradiance = std::max(irradiance, luminance(light.irradiance));
  }
  const ColumnFormat area_before = std::exchange(area_format_, ColumnFormat(area));
  const ColumnFormat irradiance_before =
      std::exchange(irradiance_format_, ColumnFormat(irradiance));
  if (!(area_before == area_format_ && irradiance_before == irradiance_format_)) {
    emit headerDataChanged(Qt::Horizontal, 0, column_count - 1);
  }
}

void ReceivedTable::set_current_pass(int pass) {
  if (pass == current_pass_) {
    return;
  }
  current_pass_ = pass;
  if (!lights_.empty()) {
    emit dataChanged(index(0, 0), index(rowCount() - 1, column_count - 1), {Qt::FontRole});
  }
}

double ReceivedTable::value(const ReceivedLight& light, int column) const {
  switch (column) {
    case of_direction:
      return 2 * light.pass + (light.opposite ? 1 : 0);
    case of_area:
      return light.area;
    case of_visible_fraction:
      return light.area / (patch_area_ * light.cosine);
    case of_brightest:
      return light.brightest;
    default:
      return luminance(light.irradiance);
  }
}

QString ReceivedTable::text(const ReceivedLight& light, int column) const {
  const auto percent = [](double fraction) {
    const int decimals = fraction < 0.0995 ? 2 : fraction < 0.9995 ? 1 : 0;
    return QStringLiteral("%1 %").arg(100 * fraction, 0, 'f', fraction == 0 ? 0 : decimals);
  };
  switch (column) {
    case of_direction:
      return light.opposite ? tr("%1, −ω").arg(count_text(light.pass + 1))
                            : count_text(light.pass + 1);
    case of_area:
      return area_format_.text(value(light, column));
    case of_irradiance:
      return irradiance_format_.text(value(light, column));
    case of_visible_fraction:
      return percent(value(light, column));
    case of_share: {
      const double all = luminance(irradiance_);
      return percent(all > 0 ? luminance(light.irradiance) / all : 0);
    }
    default:
      return light.brightest == no_patch ? QStringLiteral("–") : QString::number(light.brightest);
  }
}

QVariant ReceivedTable::data(const QModelIndex& index, int role) const {
  const ReceivedLight& light = this->light(index.row());
  switch (role) {
    case Qt::DisplayRole:
      return text(light, index.column());
    case Qt::TextAlignmentRole:
      return QVariant(Qt::AlignRight | Qt::AlignVCenter);
    case Qt::ForegroundRole:
      return light.brightest != no_patch ? QVariant() : QVariant(theme::ink_dim);
    case Qt::ToolTipRole:
      return index.column() == of_irradiance
                 ? QVariant(tr("Red, green, blue: %1 W/m²").arg(rgb_text(light.irradiance)))
                 : QVariant();
    case Qt::FontRole:
      return font_cell(light.pass == current_pass_);
    default:
      return {};
  }
}

ColumnHeader ReceivedTable::header(int column) const {
  switch (column) {
    case of_direction:
      return {tr("Direction"), tr("Number of the pass; −ω: its opposite direction")};
    case of_area:
      return {area_format_.header(tr("Seen, m²")),
              tr("Area of front sides that the patch sees, projected onto the plane")};
    case of_visible_fraction:
      return {tr("Seen"), tr("The same as a fraction of the patch's projected area; the rest "
                             "is back sides or empty")};
    case of_irradiance:
      return {irradiance_format_.header(tr("ΔH, W/m²")),
              tr("Contribution to the irradiance H of the patch (luminance), before "
                 "normalization")};
    case of_share:
      return {tr("Fraction"), tr("Fraction of the sum over all listed directions")};
    default:
      return {tr("Source"), tr("Patch that contributes most")};
  }
}

void ReceivedTable::sort(int column, Qt::SortOrder order) {
  emit layoutAboutToBeChanged({}, VerticalSortHint);
  sorted_by_ = column;
  sort_order_ = order;
  sort_lights(lights_);
  emit layoutChanged({}, VerticalSortHint);
}

void ReceivedTable::sort_lights(std::vector<ReceivedLight>& lights) const {
  const auto less = [this](const ReceivedLight& a, const ReceivedLight& b) {
    const double x = value(a, sorted_by_), y = value(b, sorted_by_);
    if (x != y) {
      return sort_order_ == Qt::AscendingOrder ? x < y : y < x;
    }
    return value(a, of_direction) < value(b, of_direction);
  };
  std::sort(lights.begin(), lights.end(), less);
}

}  // namespace transillum::viewer
