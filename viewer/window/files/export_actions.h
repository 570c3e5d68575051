// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <variant>

#include "support/newest_result.h"
#include "transillum/files.h"
#include "window/base/window_views.h"
#include "window/files/figure.h"

class QAction;
class QMenu;
class QWidget;

namespace transillum::viewer {

class ConvergenceView;

/// Exports from the window: pictures, vector graphics, results, values. All files are written
/// whole or not at all; the functions throw std::runtime_error where one cannot be written.
class ExportActions : public QObject {
  Q_OBJECT

 public:
  ExportActions(const WindowFrame& frame, MapView& map, ConvergenceView& charts);

  void add_to(QMenu& menu) const;
  /// The views for write_figure().
  FigureViews figure_views() const;
  /// Writes the result shown, in the formats of `transillum solve`: .vtp, .csv or .ply. A worker
  /// thread writes; a failure there is shown in the window.
  /// @throws InputError where it is clear at once that it cannot be written
  void write_result(const QString& path);
  /// Writes the radiosity shown, including the effect of changed materials, as colors for other
  /// programs: .glb, .gltf or .ply. A worker thread writes, as in write_result().
  /// @throws InputError where it is clear at once that it cannot be written
  void write_colors(const QString& path, const DisplayOptions& display);
  /// Writes the measured errors as a page, .html, or as .json. A worker thread writes, as in
  /// write_result().
  /// @throws InputError where it is clear at once that they cannot be written
  void write_errors(const QString& path);
  /// Writes the open scene with the changes of materials and the faces turned, as OBJ with MTL, in
  /// meters. A worker thread writes, as in write_result().
  /// @throws InputError where it is clear at once that it cannot be written
  void write_scene_file(const QString& path);
  /// Asks to save a scene whose faces were edited, if no file has them.
  /// @returns whether the open scene can be read from OpenScene::spec()
  bool save_edited();
  /// For the menu File.
  QAction* figure_action() const { return save_figure_; }
  /// For the menu File.
  QAction* save_scene_action() const { return save_scene_; }
  /// For the menu File.
  QAction* color_action() const { return export_colors_; }
  /// Writes ColorChoice::errors(), for the page that shows them.
  QAction* errors_action() const { return export_errors_; }
  /// Whether a result or a scene is still being written.
  bool writing() const { return writer_.busy(); }
  /// Writes the map of the step in focus, as vectors (.svg) or in the formats of write_map().
  void write_map_picture(const QString& path) const;
  /// Writes the convergence charts as vectors.
  void write_charts(const QString& path) const;
  /// Writes the data of the charts: chart,x,change,quadrature_error.
  void write_chart_values(const QString& path) const;
  /// Copies the same to the clipboard.
  void copy_chart_values() const;
  /// For the menu of the charts.
  QAction* copy_values_action() const { return copy_values_; }

 private:
  void add(const char* name, const QString& text, const QString& tip,
           void (ExportActions::*what)());
  void choose_figure();
  void choose_result();
  void choose_scene_file();
  void choose_colors();
  void choose_errors();
  void choose_map();
  void choose_charts();
  void choose_values();
  /// A file name that begins with the name of the open scene.
  QString name_with(const char* ending) const;
  template <class Write>
  void write_chosen(const QString& title, const QString& filter, const QString& proposed,
                    Write write);

  WindowFrame frame_;
  MapView& map_;
  ConvergenceView& charts_;
  QList<QAction*> actions_;
  FigurePlan figure_{.size = {}};  ///< the newest; without a size, none yet
  QAction *save_figure_, *save_scene_, *export_colors_, *export_errors_, *copy_values_;

  struct FileToWrite {
    QString path;
    std::function<void()> write;
  };
  NewestResult<FileToWrite, std::monostate> writer_;
};

}  // namespace transillum::viewer
