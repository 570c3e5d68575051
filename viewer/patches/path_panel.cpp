// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel "Light paths". It follows the selection and the newest snapshot, searches on its own
// thread while it is visible, and tells the window which paths to draw in the scene.
#include "patches/path_panel.h"

#include <QCheckBox>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QStringList>
#include <QTableWidget>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <utility>

#include "colors/color_scale.h"
#include "model/light_balance.h"
#include "model/snapshot_values.h"
#include "support/number_text.h"
#include "transillum/files.h"
#include "widgets/build.h"
#include "widgets/dialogs.h"
#include "widgets/value_table.h"

namespace transillum::viewer {

namespace {

constexpr int most_paths = 1000;

double fraction_of(const LightPaths& paths, const Rgb& light) {
  const double all = luminance(paths.radiosity);
  return all > 0 ? luminance(light) / all : 0;
}

/// The kind of source, as in files.
const char* name_of(LightOrigin origin) {
  return origin == LightOrigin::sky ? "sky" : origin == LightOrigin::sun ? "sun" : "patch";
}

/// Begins the texts of paths from the sky or the sun.
QStringList origin_text(const LightPath& path) {
  return path.origin == LightOrigin::sky   ? QStringList(PathPanel::tr("sky"))
         : path.origin == LightOrigin::sun ? QStringList(PathPanel::tr("sun"))
                                           : QStringList();
}

QString path_text(const LightPath& path) {
  QStringList patches = origin_text(path);
  for (const PatchId patch : path.patches) {
    patches << QString::number(patch);
  }
  return patches.join(QStringLiteral(" → "));
}

/// The groups, or faces without one, that a path goes through; the last patch by its number.
QString group_text(const LightPath& path, const Scene& scene) {
  QStringList names = origin_text(path);
  for (const PatchId patch : path.patches) {
    const Patch& one = scene.patch(patch);
    names << (one.group == no_group ? PathPanel::tr("face %1").arg(one.face)
                                    : QString::fromStdString(at(scene.groups(), one.group)));
  }
  names.back() = QString::number(path.patches.back());
  return names.join(QStringLiteral(" → "));
}

nlohmann::json json_of(const Rgb& light) { return {light.r, light.g, light.b}; }

}  // namespace

PathPanel::PathPanel(Selection& selection, QWidget* parent)
    : QWidget(parent),
      selection_(selection),
      finder_(*this, &PathPanel::find,
              [this](const Request& request, std::shared_ptr<const LightPaths> paths,
                     const QString& error) {
                receiver_ = request.light.receiver;
                paths_ = std::move(paths);
                error_ = error;
                show_paths();
              }) {
  caption_ = named("path_caption", note_label({}, {10, 4, 10, 4}));
  make_table();
  auto* layout = make_column(this, {}, 0);
  layout->addLayout(make_controls());
  layout->addWidget(caption_);
  layout->addWidget(table_, 1);
  connect(&selection_, &Selection::changed, this, &PathPanel::search);
  show_paths();
}

QLayout* PathPanel::make_controls() {
  count_ =
      named("path_count", new QSpinBox, tr("How many of the strongest paths to list and draw"));
  count_->setRange(1, most_paths);
  count_->setValue(20);
  auto* label = new QLabel(tr("Strongest"));
  label->setBuddy(count_);
  export_ =
      named("export_paths", new QPushButton(tr("Export…")), tr("Write the paths as CSV or JSON"));
  by_group_ = named("paths_by_group", new QCheckBox(tr("By group")),
                    tr("Sum the 1000 strongest paths through the same groups, or faces without "
                       "one: a lamp of many patches is one source"));
  by_group_->setChecked(true);
  connect(by_group_, &QCheckBox::toggled, this, &PathPanel::search);
  auto* row = make_row({10, 8, 10, 6}, 6);
  row->addWidget(label);
  row->addWidget(count_);
  row->addWidget(by_group_);
  row->addStretch(1);
  row->addWidget(export_);
  connect(count_, qOverload<int>(&QSpinBox::valueChanged), this, &PathPanel::search);
  connect(export_, &QPushButton::clicked, this, &PathPanel::choose_file);
  return row;
}

void PathPanel::make_table() {
  table_ = named("path_table", new QTableWidget(0, 4));
  table_->setHorizontalHeaderLabels({tr("%"), tr("B, W/m²"), tr("Bounces"), tr("Path")});
  const QString tips[] = {
      tr("Fraction of the radiosity of the selected patch, by luminance"),
      tr("Luminance that the path adds to the radiosity B of the selected patch"),
      tr("Number of reflections on the path, including the one by the selected patch"),
      tr("Patches from the source to the selected patch; click a row to emphasize it in the "
         "scene")};
  for (int column = 0; column < 4; ++column) {
    table_->horizontalHeaderItem(column)->setToolTip(symbol_tip(tips[column], "6.7"));
  }
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->horizontalHeader()->setStretchLastSection(true);
  set_up_value_table(
      *table_, {QStringLiteral("88.88"), QStringLiteral("0.008888"), QStringLiteral("888"), {}});
  // Long paths have several lines.
  table_->setWordWrap(true);
  connect(table_, &QTableWidget::itemSelectionChanged, this, [this] {
    const QList<QTableWidgetItem*> items = table_->selectedItems();
    emit paths_shown(watched_ ? paths_ : nullptr, items.isEmpty() ? -1 : items.front()->row());
  });
}

void PathPanel::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  snapshot_ = std::move(snapshot);
  search();
}

void PathPanel::clear() {
  snapshot_ = nullptr;
  requested_ = {};
  finder_.clear();
  search();
}

void PathPanel::set_watched(bool watched) {
  if (watched == watched_) {
    return;
  }
  watched_ = watched;
  search();
  show_paths();
}

void PathPanel::search() {
  if (receiver_ != selection_.patch() || !snapshot_) {
    paths_ = nullptr;
    error_.clear();
    receiver_ = no_patch;
    show_paths();
  }
  if (!watched_ || !snapshot_ || selection_.patch() == no_patch) {
    return;
  }
  auto light = light_request(*snapshot_, selection_.patch());
  if (!light) {
    emit form_factors_requested();
    show_caption();
    return;
  }
  Request request{*std::move(light), count_->value(), by_group_->isChecked(), {}};
  if (!(request == requested_) || (!paths_ && error_.isEmpty() && !finder_.busy())) {
    requested_ = request;
    request.start = snapshot_->radiosity;
    finder_.request(std::move(request));
  }
  show_caption();
}

LightPaths PathPanel::find(const Request& request, const Cancellation& cancellation) {
  const LightRequest& light = request.light;
  LightPathOptions options;
  options.count = request.by_group ? most_paths : request.count;
  options.start = request.start;
  options.sky_irradiance = light.sky;
  const std::vector<Rgb> sun = light_of_sun(light, cancellation);
  options.sun_irradiance = sun;
  options.patch_materials = light.patch_materials();
  LightPaths paths = find_light_paths(light.scene(), *light.form_factors, light.receiver,
                                      light.material_list(), options, cancellation);
  return request.by_group
             ? sums_of_paths(paths, light.scene(), static_cast<std::size_t>(request.count))
             : paths;
}

LightPaths sums_of_paths(const LightPaths& paths, const Scene& scene, std::size_t most) {
  LightPaths sums{{}, paths.radiosity, paths.cut_off, paths.complete};
  std::map<std::vector<std::pair<int, int>>, std::size_t> numbers;
  for (const LightPath& path : paths.paths) {
    std::vector<std::pair<int, int>> key{{-1, static_cast<int>(path.origin)}};
    for (const PatchId patch : path.patches) {
      key.push_back(source_of(scene.patch(patch)));
    }
    const auto [number, added] = numbers.emplace(std::move(key), sums.paths.size());
    if (added) {
      sums.paths.push_back(path);  // the strongest comes first
    } else {
      sums.paths[number->second].contribution += path.contribution;
    }
  }
  std::stable_sort(sums.paths.begin(), sums.paths.end(), [](const auto& a, const auto& b) {
    return luminance(a.contribution) > luminance(b.contribution);
  });
  for (std::size_t k = most; k < sums.paths.size(); ++k) {
    sums.cut_off += sums.paths[k].contribution;
  }
  sums.paths.resize(std::min(sums.paths.size(), most));
  return sums;
}

void PathPanel::show_paths() {
  const int rows = paths_ ? static_cast<int>(paths_->paths.size()) : 0;
  table_->clearSelection();
  table_->setRowCount(rows);
  // The strongest path is the first.
  const Rgb most = rows > 0 ? paths_->paths.front().contribution : Rgb();
  const ColumnFormat fraction_format(100), light_format(luminance(most));
  table_->horizontalHeaderItem(1)->setText(light_format.header(tr("B, W/m²")));
  for (int row = 0; row < rows; ++row) {
    const LightPath& path = at(paths_->paths, row);
    const QString texts[] = {fraction_format.text(100 * fraction_of(*paths_, path.contribution)),
                             light_format.text(luminance(path.contribution)),
                             QString::number(path.reflections()),
                             path.reflections() == 0 ? tr("emitted by the patch itself")
                             : requested_.by_group   ? group_text(path, *snapshot_->loaded->scene)
                                                     : path_text(path)};
    for (int column = 0; column < 4; ++column) {
      auto* item = new QTableWidgetItem(texts[column]);
      const auto side = column < 3 ? Qt::AlignRight : Qt::AlignLeft;
      item->setTextAlignment(static_cast<int>(side | Qt::AlignVCenter));
      table_->setItem(row, column, item);
    }
  }
  table_->resizeRowsToContents();
  enable_if(*export_, rows > 0, tr("No light paths are listed"));
  show_caption();
  emit paths_shown(watched_ ? paths_ : nullptr, -1);
}

void PathPanel::show_caption() {
  const PatchId patch = selection_.patch();
  if (!snapshot_ || patch == no_patch) {
    caption_->setText(tr("Select a patch to list the paths by which light reaches it."));
  } else if (!error_.isEmpty()) {
    caption_->setText(error_);
  } else if (!snapshot_->form_factors) {
    caption_->setText(why_no_form_factors(*snapshot_));
  } else if (!paths_) {
    caption_->setText(tr("Searching…"));
  } else if (paths_->paths.empty()) {
    caption_->setText(tr("No light reaches patch %1.").arg(patch));
  } else {
    const double rest = 100 * fraction_of(*paths_, paths_->cut_off);
    caption_->setText(tr("%1 paths carry %2 % of B of patch %3, all other paths together %4 %.")
                          .arg(paths_->paths.size())
                          .arg(100 - rest, 0, 'f', 1)
                          .arg(patch)
                          .arg(rest, 0, 'f', 1));
    if (!paths_->complete) {
      caption_->setText(caption_->text() + QLatin1Char(' ') +
                        tr("The search ran out of memory: stronger paths may be missing."));
    }
  }
}

void write_paths_csv(const LightPaths& paths, std::ostream& out) {
  out << "rank,share,B_r,B_g,B_b,patches,source\n";
  const auto write_line = [&](const std::string& rank, const Rgb& light, const std::string& patches,
                              const char* source) {
    const auto number = [](double value) { return QString::number(value, 'g', 17).toStdString(); };
    out << rank << ',' << number(fraction_of(paths, light)) << ',' << number(light.r) << ','
        << number(light.g) << ',' << number(light.b) << ',' << patches << ',' << source << '\n';
  };
  int rank = 0;
  for (const LightPath& path : paths.paths) {
    std::string patches;
    for (const PatchId patch : path.patches) {
      patches += (patches.empty() ? "" : " ") + std::to_string(patch);
    }
    write_line(std::to_string(++rank), path.contribution, patches, name_of(path.origin));
  }
  write_line("others", paths.cut_off, "", "");
}

void write_paths_json(const LightPaths& paths, PatchId receiver, std::ostream& out) {
  nlohmann::json list = nlohmann::json::array();
  for (const LightPath& path : paths.paths) {
    list.push_back({{"share", fraction_of(paths, path.contribution)},
                    {"contribution", json_of(path.contribution)},
                    {"patches", path.patches},
                    {"source", name_of(path.origin)}});
  }
  const nlohmann::json file = {{"receiver", receiver},
                               {"radiosity", json_of(paths.radiosity)},
                               {"others", json_of(paths.cut_off)},
                               {"complete", paths.complete},
                               {"paths", std::move(list)}};
  out << file.dump(1) << '\n';
}

void PathPanel::write(const QString& path) const {
  write_file_whole(path.toStdString(), [&](std::ostream& out) {
    if (path.endsWith(QLatin1String(".json"), Qt::CaseInsensitive)) {
      write_paths_json(*paths_, receiver_, out);
    } else {
      write_paths_csv(*paths_, out);
    }
  });
}

void PathPanel::choose_file() {
  const QString path = ask_where_to_write(this, tr("Write the light paths"),
                                          tr("CSV (*.csv);;JSON (*.json)"), "paths.csv");
  if (path.isEmpty() || !paths_) {
    return;
  }
  try {
    write(path);
  } catch (const std::exception& error) {
    emit failed(QString::fromStdString(error.what()));
  }
}

}  // namespace transillum::viewer
