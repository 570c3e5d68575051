// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "directions/received_table.h"

#include <algorithm>
#include <utility>

#include "support/number_text.h"
#include "widgets/table_cells.h"
#include "widgets/theme.h"

namespace transillum::viewer {

void ReceivedTable::show_lights(const std::vector<ReceivedLight>& lights, double patch_area) {
  std::vector<ReceivedLight> looked_along;
  irradiance_ = {};
  for (const ReceivedLight& light : lights) {
    if (light.cosine <= 0) {
      continue;
    }
    looked_along.push_back(light);
    irradiance_ += light.irradiance;
  }
  patch_area_ = patch_area;
  sort_lights(looked_along);
  if (looked_along == lights_) {
    return;
  }
  // A reset in the midst of a double click would lose it: more of the same are put in instead.
  const int before = rowCount(), after = static_cast<int>(looked_along.size());
  if (before == 0 || after < before) {
    beginResetModel();
    lights_ = std::move(looked_along);
    endResetModel();
    return;
  }
  if (after > before) {
    beginInsertRows({}, before, after - 1);
  }
  lights_ = std::move(looked_along);
  if (after > before) {
    endInsertRows();
  }
  emit dataChanged(index(0, 0), index(after - 1, column_count - 1));
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

int ReceivedTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(lights_.size());
}

int ReceivedTable::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : column_count;
}

double ReceivedTable::value(const ReceivedLight& light, int column) const {
  switch (column) {
    case of_direction:
      return 2 * light.pass + (light.opposite ? 1 : 0);
    case of_area:
      return light.area;
    case of_seen:
      return light.area / (patch_area_ * light.cosine);
    case of_brightest:
      return light.brightest;
    default:
      return luminance(light.irradiance);
  }
}

QString ReceivedTable::text(const ReceivedLight& light, int column) const {
  const auto percent = [](double share) {
    const int decimals = share < 0.0995 ? 2 : share < 0.9995 ? 1 : 0;
    return QStringLiteral("%1 %").arg(100 * share, 0, 'f', share == 0 ? 0 : decimals);
  };
  switch (column) {
    case of_direction:
      return light.opposite ? tr("%1, −ω").arg(count_text(light.pass + 1))
                            : count_text(light.pass + 1);
    case of_area:
    case of_irradiance:
      return number_text(value(light, column));
    case of_seen:
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

QVariant ReceivedTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) {
    return {};
  }
  const auto pick = [role](const QString& name, const QString& tip) {
    return head_cell(role, name, tip);
  };
  switch (section) {
    case of_direction:
      return pick(tr("Direction"), tr("Its number; −ω: the opposite way of the same pass"));
    case of_area:
      return pick(tr("Sees, m²"), tr("Area of lit sides that the patch sees, on the plane"));
    case of_seen:
      return pick(tr("of it"), tr("The same as a share of the patch's projected area; the rest "
                                  "are back sides, or nothing"));
    case of_irradiance:
      return pick(tr("Adds, W/m²"), tr("To the irradiance of the patch (luminance), before any "
                                       "normalization"));
    case of_share:
      return pick(tr("Share"), tr("Of what all directions listed add"));
    default:
      return pick(tr("From"), tr("The patch that adds most of it"));
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
