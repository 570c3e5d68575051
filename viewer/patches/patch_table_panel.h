// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <memory>

#include "model/snapshot.h"
#include "state/selection.h"

class QLabel;
class QLineEdit;
class QTableView;
class QTabWidget;
class QTimer;

namespace transillum::viewer {

class PatchTable;

/// Tables of all patches and of the selected patch's partners, to be sorted, searched, and written
/// as CSV. A click selects a patch; what is selected elsewhere is marked.
class PatchTablePanel : public QWidget {
  Q_OBJECT

 public:
  explicit PatchTablePanel(Selection& selection, QWidget* parent = nullptr);

  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void clear();
  /// Nothing is filled in while nobody looks.
  void set_watched(bool watched);
  /// Puts the cursor where one types what to look for.
  void begin_search();
  /// Writes the shown table as it is sorted and searched.
  /// @throws std::runtime_error naming the file where it cannot be written.
  void write_csv(const QString& path) const;

 signals:
  void form_factors_wanted();
  void failed(const QString& message);

 private:
  struct Page {
    PatchTable* table;
    QTableView* view;
    QLabel* words;
  };
  Page add_page(const QString& title, const char* name);
  const Page& current() const;
  void refresh();
  void show_partners();
  void mark_selection();
  void count_rows();
  void choose_csv();

  Selection& selection_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  QLineEdit* search_;
  QTabWidget* tabs_;
  Page all_, partners_;
  bool watched_ = false;
  QTimer* later_;  ///< tables are filled anew a few times a second at most
};

}  // namespace transillum::viewer
