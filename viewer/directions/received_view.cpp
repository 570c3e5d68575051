// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel "Received": computes, for the selected patch, one term of eq. 11 per direction. B is
// taken from the iteration in focus if it was kept, else from the newest snapshot; visible areas
// come from PerDirectionVisibility.
#include "directions/received_view.h"

#include <QHeaderView>
#include <QItemSelectionModel>
#include <QTableView>
#include <QTimer>
#include <algorithm>
#include <iterator>
#include <utility>

#include "directions/received_light.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/value_table.h"

namespace transillum::viewer {

namespace {

constexpr int refresh_interval_ms = 400;

}  // namespace

ReceivedView::ReceivedView(Focus& focus, Selection& selection, PerDirectionVisibility& visibility,
                           QWidget* parent)
    : QWidget(parent), focus_(focus), selection_(selection), visibility_(visibility) {
  caption_ = named("received_words", note_label({}, {10, 4, 10, 4}));
  table_ = new ReceivedTable(this);
  view_ = named("received_light", new QTableView);
  view_->setModel(table_);
  view_->setSelectionBehavior(QAbstractItemView::SelectRows);
  view_->horizontalHeader()->setStretchLastSection(true);
  view_->horizontalHeader()->setSortIndicator(ReceivedTable::of_irradiance, Qt::DescendingOrder);
  view_->setSortingEnabled(true);
  set_up_value_table(*view_, {"8 888, −ω", "0.008888", "100 %", "0.008888", "88.8 %", ""});

  auto* layout = make_column(this, {}, 0);
  layout->addWidget(caption_);
  layout->addWidget(view_, 1);

  refresh_timer_ = new QTimer(this);
  refresh_timer_->setSingleShot(true);
  refresh_timer_->setInterval(refresh_interval_ms);
  connect(refresh_timer_, &QTimer::timeout, this, &ReceivedView::show_lights);
  connect(&visibility_, &PerDirectionVisibility::grown, this, [this] {
    if (!refresh_timer_->isActive()) {
      refresh_timer_->start();
    }
  });
  connect(&selection_, &Selection::changed, this, [this] {
    marked_.clear();
    request_visibility();
  });
  connect(&focus_, &Focus::moved, this, &ReceivedView::show_position);
  connect(view_->selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] {
    if (!marks_rows_ && !marked_.empty()) {
      marked_.clear();
      refresh_timer_->start();
    }
  });
  connect(view_, &QTableView::clicked, this, [this](const QModelIndex& index) {
    const PatchId source = table_->light(index.row()).brightest;
    if (index.column() == ReceivedTable::of_brightest && source != no_patch) {
      selection_.select(source);
    }
  });
  connect(view_, &QTableView::doubleClicked, this, [this](const QModelIndex& index) {
    if (index.column() == ReceivedTable::of_brightest) {
      return;
    }
    focus_.go_to_first(focus_.position().iteration, table_->light(index.row()).pass,
                       find_exchanges_of(selection_.patch()));
  });
  show_lights();
}

void ReceivedView::show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot) {
  const bool new_directions = !snapshot_ || snapshot_->directions != snapshot->directions;
  snapshot_ = std::move(snapshot);
  if (new_directions) {
    request_visibility();
  } else if (isVisible() && !refresh_timer_->isActive()) {
    refresh_timer_->start();
  }
}

void ReceivedView::clear() {
  snapshot_ = nullptr;
  marked_.clear();
  refresh_timer_->stop();
  show_lights();
}

void ReceivedView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  request_visibility();
}

int ReceivedView::directions_done() const {
  const SolveProgress& progress = snapshot_->progress;
  const bool finished = focus_.position().iteration < progress.iteration;
  return finished ? snapshot_->passes_of(focus_.position().iteration) : progress.direction;
}

void ReceivedView::request_visibility() {
  if (isVisible() && snapshot_ && selection_.patch() != no_patch && directions_done() > 0) {
    visibility_.request(visibility_request(*snapshot_, focus_.position().iteration,
                                           directions_done(), selection_.patch()));
  }
  show_lights();
}

void ReceivedView::show_position() {
  if (!isVisible()) {
    return;
  }
  if (snapshot_ && selection_.patch() != no_patch) {
    request_visibility();
  }
}

void ReceivedView::show_lights() {
  if (!isVisible()) {
    return;
  }
  const PatchId patch = selection_.patch();
  const int iteration = focus_.position().iteration;
  if (!snapshot_ || patch == no_patch) {
    table_->show_lights({}, 1);
    caption_->setText(
        tr("Select a patch to see what each direction contributes to its irradiance."));
    return;
  }
  const PerDirectionVisibility::Request& request = visibility_.current_request();
  if (request.patch != patch || request.loaded != snapshot_->loaded ||
      request.directions != snapshot_->directions_of(iteration)) {
    return;
  }
  const auto& kept = snapshot_->kept_radiosity;
  const bool known = iteration < std::ssize(kept) && at(kept, iteration);
  const auto& found = visibility_.found();
  const int count = std::min(directions_done(), static_cast<int>(found.size()));
  table_->show_lights(received_light(request, {found.data(), static_cast<std::size_t>(count)},
                                     known ? *at(kept, iteration) : snapshot_->radiosity,
                                     snapshot_->passes_of(iteration)),
                      snapshot_->loaded->scene->patch(patch).area);
  table_->set_current_pass(focus_.map() ? focus_.position().direction : -1);
  const QString what =
      known ? tr("Iteration %1: contribution of each direction to the irradiance of patch %2; sum "
                 "%3 W/m².")
                  .arg(count_text(iteration + 1))
            : tr("Contribution of each direction to the irradiance of patch %1; sum %2 W/m².");
  caption_->setText(what.arg(patch).arg(number_text(luminance(table_->irradiance()))) +
                    (count < directions_done()
                         ? tr(" Computed: %1 of %2 directions.")
                               .arg(count_text(count), count_text(directions_done()))
                         : tr(" Double-click a row to go to its direction.")) +
                    mark_rows(count == directions_done()));
}

void ReceivedView::mark_sources(const std::vector<PatchId>& sources) {
  marked_ = sources;
  reveals_marked_ = true;
  show_lights();
}

QString ReceivedView::mark_rows(bool complete) {
  if (marked_.empty()) {
    return {};
  }
  QItemSelection rows;
  for (int row = 0; row < table_->rowCount(); ++row) {
    const PatchId brightest = table_->light(row).brightest;
    if (std::find(marked_.begin(), marked_.end(), brightest) != marked_.end()) {
      rows.select(table_->index(row, 0), table_->index(row, ReceivedTable::column_count - 1));
    }
  }
  marks_rows_ = true;
  view_->selectionModel()->select(rows, QItemSelectionModel::ClearAndSelect);
  marks_rows_ = false;
  if (rows.isEmpty()) {
    return complete ? tr(" In no direction is the source chosen the brightest.") : QString();
  }
  if (reveals_marked_) {
    view_->scrollTo(rows.indexes().front());
    reveals_marked_ = false;
  }
  return tr(" Selected: directions in which the source chosen is the brightest.");
}

}  // namespace transillum::viewer
