// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QLabel>
#include <memory>
#include <string>

#include "model/light_balance.h"
#include "state/focus.h"
#include "state/selection.h"

namespace transillum::viewer {

/// The equation of B of the selected patch, with its numbers in one channel of color. The numbers
/// are links: to the source, to the directions in which it was seen, and to a step that exchanges
/// its light.
class BalanceView : public QLabel {
  Q_OBJECT

 public:
  BalanceView(Focus& focus, Selection& selection, QWidget* parent = nullptr);

  /// @param patch no_patch shows nothing
  void show_balance(std::shared_ptr<const SolverSnapshot> snapshot, PatchId patch);

 signals:
  void form_factors_requested();
  /// @param panel that is to show what a link names: received or map
  void panel_wanted(const std::string& panel);

 private:
  void show_text();
  /// The equation, and the choice of the channel.
  QString equation() const;
  /// A row of the table; empty texts leave cells empty.
  /// @param light whose fraction of B is written
  QString row(const QString& source, const QString& form_factor, const QString& radiosity,
              const QString& value, const Rgb& light) const;
  void follow(const QString& link);
  /// Goes to a step in which the receiver and a patch exchange light.
  void seek_exchange_with(PatchId source);
  double channel_of(const Rgb& value) const;

  Focus& focus_;
  Selection& selection_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  LightBalance balance_;
  int channel_ = 0;                    ///< 0 red, 1 green, 2 blue
  QMetaObject::Connection other_way_;  ///< searches forward where nothing was found backward
};

}  // namespace transillum::viewer
