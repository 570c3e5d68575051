// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "model/snapshot.h"
#include "patches/patch_table.h"
#include "state/selection.h"

class QLineEdit;
class QTabWidget;
class QTimer;

namespace transillum::viewer {

/// Two tables, of all patches and of the partners of the selected patch, which can be sorted,
/// searched and written as CSV. A click selects a patch; the selected patch is highlighted.
class PatchTablePanel : public QWidget {
  Q_OBJECT

 public:
  explicit PatchTablePanel(Selection& selection, QWidget* parent = nullptr);

  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void clear();
  /// While the panel is hidden, its tables are not filled.
  void set_watched(bool watched);
  /// Shows the row of the selected patch among all patches, or its partners, without a search.
  void show_selected(bool partners);
  /// Moves the keyboard focus to the search field.
  void begin_search();
  /// Writes the shown rows of the current table in their order.
  /// @throws std::runtime_error naming the file, if it cannot be written
  void write_csv(const QString& path) const;

 signals:
  void form_factors_requested();
  void failed(const QString& message);

 private:
  TablePage add_page(const QString& title, const char* name);
  const TablePage& current() const;
  void refresh();
  void show_partners();
  void mark_selection();
  void count_rows();
  void choose_csv();

  Selection& selection_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  QLineEdit* search_;
  QTabWidget* tabs_;
  TablePage all_, partners_;
  bool watched_ = false;
  QTimer* refresh_timer_;  ///< limits how often tables are refilled
};

}  // namespace transillum::viewer
