// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <iosfwd>
#include <memory>

#include "model/requests/slow_quantities.h"
#include "radiosity/form_factors/light_paths.h"
#include "state/selection.h"
#include "support/newest_result.h"

class QCheckBox;
class QLabel;
class QPushButton;
class QSpinBox;
class QTableWidget;

namespace transillum::viewer {

/// The strongest light paths to the selected patch, with their fractions of its B; found from the
/// snapshot's form factors on a thread of its own.
class PathPanel : public QWidget {
  Q_OBJECT

 public:
  explicit PathPanel(Selection& selection, QWidget* parent = nullptr);

  void show_snapshot(std::shared_ptr<const SolverSnapshot> snapshot);
  void clear();
  /// While the panel is hidden, nothing is searched, and no path is shown.
  void set_watched(bool watched);
  /// The paths listed; null before the first search has ended.
  std::shared_ptr<const LightPaths> paths() const { return paths_; }
  bool busy() const { return finder_.busy(); }
  /// Writes the paths as CSV, or as JSON where the path ends so.
  /// @throws std::runtime_error naming the file, if it cannot be written
  void write(const QString& path) const;

 signals:
  /// @param paths  null if there are none
  /// @param highlighted  index of the path to emphasize, or -1
  void paths_shown(std::shared_ptr<const transillum::LightPaths> paths, int highlighted);
  void form_factors_requested();
  void failed(const QString& message);

 private:
  struct Request {
    LightRequest light;
    int count = 0;
    bool by_group = false;  ///< sum paths through the same groups or faces
    std::vector<Rgb> start;

    friend bool operator==(const Request& a, const Request& b) {
      // `start` changes only the time.
      return a.light == b.light && a.count == b.count && a.by_group == b.by_group;
    }
  };
  static LightPaths find(const Request& request, const Cancellation& cancellation);
  QLayout* make_controls();
  void make_table();
  void search();
  void show_paths();
  void show_caption();
  void choose_file();

  Selection& selection_;
  std::shared_ptr<const SolverSnapshot> snapshot_;
  bool watched_ = false;
  Request requested_;
  PatchId receiver_ = no_patch;  ///< receiver of paths_
  std::shared_ptr<const LightPaths> paths_;
  QString error_;
  QSpinBox* count_;
  QCheckBox* by_group_;
  QPushButton* export_;
  QLabel* caption_;
  QTableWidget* table_;
  NewestResult<Request, LightPaths> finder_;
};

/// Sums the paths that go through the same groups, or faces without one: for each sum the strongest
/// path, with the light of all.
/// @param most  number of sums; what the others bring is added to `cut_off`
LightPaths sums_of_paths(const LightPaths& paths, const Scene& scene, std::size_t most);
/// One line per path: its rank from 1, fraction of B by luminance, contribution, patches from the
/// source on, kind of source. The last line is the sum of all other paths.
void write_paths_csv(const LightPaths& paths, std::ostream& out);
void write_paths_json(const LightPaths& paths, PatchId receiver, std::ostream& out);

}  // namespace transillum::viewer
