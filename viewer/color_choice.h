// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>

#include "color_scale.h"
#include "snapshot.h"

namespace transillum::viewer {

/// The colour scale that all views share, and what of it follows the light by itself.
class ColorChoice : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  const ColorScale& scale() const { return scale_; }
  bool exposure_is_automatic() const { return automatic_; }

  void set_mode(ColorMode mode);
  void set_map(ColorMap map);
  void set_logarithmic(bool logarithmic);
  void set_gamma(double gamma);
  /// Ends the automatic exposure.
  void set_exposure(double exposure);
  void set_automatic_exposure(bool automatic);

  /// Fits range and exposure to a new snapshot; tells nobody but by fitted(), for the views are
  /// about to show that snapshot anyway.
  void fit(std::shared_ptr<const SolverSnapshot> snapshot);

 signals:
  void changed();  ///< every picture must be coloured anew
  void fitted();

 private:
  void refit();

  ColorScale scale_;
  bool automatic_ = true;
  std::shared_ptr<const SolverSnapshot> snapshot_;
};

}  // namespace transillum::viewer
