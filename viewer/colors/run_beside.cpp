// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "colors/run_beside.h"

#include <algorithm>
#include <utility>

#include "colors/neutral_light.h"
#include "support/number_text.h"

namespace transillum::viewer {

RunBeside::RunBeside(const Focus& focus, const ColorChoice& colors, const Selection& selection,
                     QObject* parent)
    : QObject(parent),
      focus_(focus),
      colors_(colors),
      selection_(selection),
      comparer_(
          *this,
          [comparer = DirectionComparer()](const DirectionRequest& request,
                                           const Cancellation& cancellation) mutable {
            return comparer(request, cancellation);
          },
          [this](const DirectionRequest&, std::shared_ptr<const DirectionComparison> result,
                 const QString& error) {
            comparison_ = std::move(result);
            error_ = error;
            emit changed();
          }) {
  connect(&focus_, &Focus::moved, this, [this] {
    if (!comparison()) {
      request();
    }
  });
  connect(&colors_, &ColorChoice::fitted, this, &RunBeside::request);
  connect(&selection_, &Selection::changed, this, &RunBeside::request);
}

void RunBeside::show(std::shared_ptr<const SolverSnapshot> run, const QString& name) {
  run_ = std::move(run);
  name_ = name;
  comparison_ = nullptr;
  comparer_.clear();
  request();
  emit changed();
}

void RunBeside::request() {
  const auto map = focus_.map();
  const auto snapshot = colors_.snapshot();
  if (run_ && map && snapshot && snapshot->loaded == map->loaded) {
    const PatchId patch = selection_.patch();
    comparer_.request(
        {run_, snapshot, map, patch == no_patch ? std::nullopt : row_request(*snapshot, patch)});
  }
}

std::shared_ptr<const DirectionComparison> RunBeside::comparison() const {
  return comparison_ && comparison_->map == focus_.map() ? comparison_ : nullptr;
}

std::vector<Color8> RunBeside::patch_colors() const {
  std::vector<Color8> colors;
  if (!run_) {
    return colors;
  }
  // A kept run has no tree and no form factors.
  const Quantity quantity = colors_.quantity();
  const PatchValues of_run = quantity == Quantity::fragments
                                 ? PatchValues()
                                 : values_of(quantity, *run_, no_patch, nullptr);
  if (of_run.values.empty()) {
    shade_gray(*run_, colors);
  } else {
    colors_.scale().color(of_run.values, colors);
  }
  return colors;
}

std::int32_t RunBeside::step_beside(std::int32_t step) const {
  const auto shown = comparison();
  if (!shown || step < 0) {
    return -1;
  }
  const PatchId patch = shown->map->history.step(step).patch;
  const MapHistory& history = shown->kept_map->history;
  for (std::int32_t k = 0; k < history.step_count(); ++k) {
    if (history.step(k).patch == patch) {
      return k;
    }
  }
  return -1;
}

QString RunBeside::summary() const {
  const auto shown = comparison();
  if (!shown) {
    return {};
  }
  const auto differs = [](const DirectionComparison::Row& row) { return row.change() != 0; };
  const auto count = std::count_if(shown->rows.begin(), shown->rows.end(), differs);
  const Vec3& omega = shown->map->record().frame.omega;
  QString text =
      tr("%1 beside the open scene, along ω = (%2, %3, %4): of %5 patches that both have, %6 see "
         "another area; %7 are only in %1, %8 only in the open scene.\n")
          .arg(name_, number_text(omega.x), number_text(omega.y), number_text(omega.z),
               count_text(std::ssize(shown->rows)), count_text(count),
               count_text(shown->unmatched[0]), count_text(shown->unmatched[1]));
  text +=
      tr("patch\tarea there, m²\tarea here, m²\tΣF there\tΣF here\tB there, W/m²\tB here, "
         "W/m²\n");
  for (const DirectionComparison::Row& row : shown->rows) {
    if (differs(row)) {
      QStringList cells{QString::number(row.patch)};
      for (const auto& pair : {row.seen, row.factors, row.radiosity}) {
        cells << number_text(pair[0]) << number_text(pair[1]);
      }
      text += cells.join(QLatin1Char('\t')) + QLatin1Char('\n');
    }
  }
  if (shown->receiver != no_patch) {
    text += tr("\nj\tF(%1,j) there\tF(%1,j) here\n").arg(shown->receiver);
    for (const DirectionComparison::Factor& factor : shown->factors) {
      const QStringList cells{QString::number(factor.source), number_text(factor.value[0]),
                              number_text(factor.value[1])};
      text += cells.join(QLatin1Char('\t')) + QLatin1Char('\n');
    }
  }
  return text;
}

}  // namespace transillum::viewer
