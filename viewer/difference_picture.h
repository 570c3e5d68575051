// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "engine_comparer.h"
#include "recorded_map.h"

namespace transillum::viewer {

/// Where two engines differ: the map V of a direction's fullest step, each patch by the share of
/// its projection that goes to other patches. White: none; red: a tenth or more.
class DifferencePicture : public QWidget {
 public:
  static constexpr double full_color_at = 0.1;

  explicit DifferencePicture(QWidget* parent = nullptr);

  /// Nothing is shown unless both are there, of one direction.
  void show(std::shared_ptr<const RecordedMap> map,
            std::shared_ptr<const EngineComparison> comparison);
  /// Of a patch, or below 0 where nothing is known.
  double share(PatchId patch) const;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::shared_ptr<const RecordedMap> map_;
  std::shared_ptr<const EngineComparison> comparison_;
};

}  // namespace transillum::viewer
