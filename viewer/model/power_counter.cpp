// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/power_counter.h"

#include <QMetaObject>
#include <span>
#include <utility>

#include "model/snapshot_solution.h"

namespace transillum::viewer {

namespace {

PowerTables tables_of(const std::shared_ptr<const SolverSnapshot>& snapshot) {
  PowerTables tables;
  tables.snapshot = snapshot;
  tables.received_known = snapshot->of_file || snapshot->progress.iteration > 0;
  Solution solution = solution_of(*snapshot);
  if (!tables.received_known) {
    solution.irradiance.assign(solution.radiosity.size(), Rgb{});
    solution.sky_irradiance.clear();
  }
  std::span<const Material> materials;
  std::span<const std::int32_t> patch_materials;
  if (snapshot->materials) {
    materials = snapshot->materials->materials;
    patch_materials = snapshot->materials->of_patch;
  }
  const auto table = [&](PartsBy by) {
    return power_table(solution, by, snapshot->form_factors.get(), materials, patch_materials);
  };
  tables.groups = table(PartsBy::group);
  tables.materials = table(PartsBy::material);
  return tables;
}

}  // namespace

PowerCounter::PowerCounter(QObject* parent)
    : QObject(parent),
      worker_(
          [this](const Task& task, const Cancellation&) {
            deliver(task, std::make_shared<const PowerTables>(tables_of(task.snapshot)), {});
          },
          [this](const Task& task, const QString& message) { deliver(task, nullptr, message); }) {}

void PowerCounter::request(std::shared_ptr<const SolverSnapshot> snapshot) {
  worker_.request({std::move(snapshot), ++newest_}, CurrentJob::finish);
}

void PowerCounter::clear() {
  worker_.clear();
  delivered_ = newest_;
}

// Runs on the worker's thread; what it posts runs on the owner's thread.
void PowerCounter::deliver(const Task& task, const std::shared_ptr<const PowerTables>& tables,
                           const QString& error) {
  const auto emit_result = [this, tables, error, number = task.number] {
    if (number <= delivered_) {
      return;  // cleared since
    }
    delivered_ = number;
    if (tables) {
      emit counted(tables);
    } else {
      emit failed(error);
    }
  };
  QMetaObject::invokeMethod(this, emit_result, Qt::QueuedConnection);
}

}  // namespace transillum::viewer
