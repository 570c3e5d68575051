// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QLabel>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/light_balance.h"
#include "model/requests/slow_quantities.h"
#include "state/focus.h"
#include "state/selection.h"
#include "support/newest_result.h"

namespace transillum::viewer {

/// The equation of B of the selected patch, with its numbers in one channel of color. The numbers
/// are links: to the source, to the directions in which it was seen, and to a step that exchanges
/// its light. While it is visible, it computes the row of form factors of the patch on its own
/// thread.
class BalanceView : public QLabel {
  Q_OBJECT

 public:
  BalanceView(Focus& focus, Selection& selection, QWidget* parent = nullptr);

  /// @param patch no_patch shows nothing
  void show_balance(std::shared_ptr<const SolverSnapshot> snapshot, PatchId patch);

 protected:
  void showEvent(QShowEvent* event) override;

 signals:
  /// Where one row alone cannot be computed.
  void form_factors_requested();
  /// @param panel that is to show what a link names
  void panel_wanted(const std::string& panel);
  /// @param partners of the receiver; otherwise its own row among all patches
  void table_wanted(bool partners);
  /// The directions in which the receiver sees a source, which has these patches.
  void directions_wanted(const std::vector<PatchId>& sources);

 private:
  /// Shows the balance, or begins to compute its row.
  void refresh();
  /// Whether the row of the patch was computed.
  bool has_row() const;
  void show_progress();
  PatchRow compute(const RowRequest& request, const Cancellation& cancellation);
  void show_text();
  /// The equation, and the choice of the channel.
  QString equation() const;
  /// Light whose number, and whose fraction of B, are links to `target`.
  struct Amount {
    Rgb light;
    QString text, target, tip;
  };
  /// A row of the table; empty texts leave cells empty.
  QString row(const QString& source, const QString& form_factor, const QString& radiosity,
              const Amount& amount) const;
  void follow(const QString& link);
  /// @param name of the panel, or table-partners: a part of it
  void show_panel(const QString& name);
  /// Goes to a step in which the receiver and a patch exchange light.
  void seek_exchange_with(PatchId source);
  double channel_of(const Rgb& value) const;

  Focus& focus_;
  Selection& selection_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  PatchId patch_ = no_patch;
  LightBalance balance_;
  int channel_ = 0;                     ///< 0 red, 1 green, 2 blue
  QMetaObject::Connection other_way_;   ///< searches forward where nothing was found backward
  int percent_ = 0;                     ///< finished part of the row
  std::optional<RowRequest> canceled_;  ///< not to be begun again unasked
  KeptResult<RowRequest, PatchRow> rows_;
};

}  // namespace transillum::viewer
