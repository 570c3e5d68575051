// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/export_actions.h"

#include <QClipboard>
#include <QFileInfo>
#include <QGuiApplication>
#include <QMainWindow>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>
#include <optional>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "colors/color_bar.h"
#include "io/results/error_report_files.h"
#include "map/map_canvas.h"
#include "map/map_view.h"
#include "model/snapshot_values.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "scene/sharp_view.h"
#include "solve/convergence_view.h"
#include "state/callout.h"
#include "transillum/errors.h"
#include "transillum/map_files.h"
#include "transillum/material_changes.h"
#include "widgets/build.h"
#include "widgets/dialogs.h"
#include "window/base/notifier.h"
#include "window/files/color_export_dialog.h"
#include "window/files/figure_dialog.h"

namespace transillum::viewer {

namespace {

VisibilityMap map_at(const RecordedMap& map, std::int32_t step) {
  const MapRecord& record = map.record();
  VisibilityMap result;
  result.frame = record.frame;
  for (const std::int32_t r : record.map_after(step)) {
    const MapRecord::Row& row = map.row(r);
    const auto outline = record.outline(row);
    const auto begin = static_cast<std::uint32_t>(result.corners.size());
    result.corners.insert(result.corners.end(), outline.begin(), outline.end());
    result.polygons.push_back({row.patch, row.front_facing, record.area(row), begin,
                               static_cast<std::uint32_t>(result.corners.size())});
  }
  std::stable_sort(result.polygons.begin(), result.polygons.end(),
                   [](const auto& a, const auto& b) { return a.patch < b.patch; });
  return result;
}

/// The patches of a result's scene as faces. A face with both sides is written as two.
SceneDescription description_of(const Scene& scene, const PatchMaterials& materials) {
  SceneDescription description;
  description.name = scene.name();
  description.points = scene.points();
  description.materials = materials.materials;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    description.add_face(scene.outline(i), at(materials.of_patch, i));
  }
  return description;
}

void put_chart_values(const SolverSnapshot& snapshot, std::ostream& out) {
  out.precision(17);
  out << "chart,x,change,quadrature_error\n";
  const auto& steps = snapshot.statistics.iteration_records;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    out << "iteration," << k + 1 << ',' << steps[k].change << ",\n";
  }
  const auto& errors = snapshot.quadrature_errors;
  for (std::size_t k = 0; k < snapshot.estimate_changes.size(); ++k) {
    out << "direction," << k + 1 << ',' << snapshot.estimate_changes[k] << ',';
    if (k < errors.size()) {
      out << errors[k];
    }
    out << '\n';
  }
}

}  // namespace

ExportActions::ExportActions(const WindowFrame& frame, MapView& map, ConvergenceView& charts)
    : QObject(&frame.window),
      frame_(frame),
      map_(map),
      charts_(charts),
      writer_(
          *this,
          [](const FileToWrite& file, const Cancellation&) {
            file.write();
            return std::monostate();
          },
          [this](const FileToWrite& file, const auto& written, const QString& error) {
            if (written) {
              frame_.notifier.show_written(file.path);
            } else {
              frame_.notifier.show_failure(error);
            }
          },
          CurrentJob::finish) {
  using E = ExportActions;
  add("export_result", tr("Result…"),
      tr("B of all patches, with E, ρ and H: VTP, which can be opened again, CSV, PLY or OBJ"),
      &E::choose_result);
  add("export_map", tr("Visibility map…"), tr("Write the map as vectors (SVG), PNG, VTP or JSON"),
      &E::choose_map);
  add("export_charts", tr("Convergence charts…"), tr("Write the charts as vectors (SVG) or PNG"),
      &E::choose_charts);
  add("export_values", tr("Convergence values…"), tr("Write the data of the charts as CSV"),
      &E::choose_values);
  copy_values_ = make_action(this, "copy_values", tr("Copy the values"),
                             tr("Copy the data of the charts as CSV"));
  connect(copy_values_, &QAction::triggered, this, &ExportActions::copy_chart_values);
  save_figure_ = make_action(this, "save_figure", tr("Save figure…"),
                             tr("Write scene, map and charts with color bar and legend, as PNG, "
                                "SVG or PDF"));
  connect(save_figure_, &QAction::triggered, this, &ExportActions::choose_figure);
  save_scene_ =
      make_action(this, "save_scene", tr("Save scene…"),
                  tr("Write the scene with its changed materials and edited faces as OBJ and MTL"));
  connect(save_scene_, &QAction::triggered, this, &ExportActions::choose_scene_file);
  export_colors_ =
      make_action(this, "export_colors", tr("Export for Blender or the web…"),
                  tr("Write the colors shown, without lighting, as glTF or PLY; with a preview"));
  connect(export_colors_, &QAction::triggered, this, &ExportActions::choose_colors);
  export_errors_ = make_action(this, "export_errors", tr("Measured errors…"),
                               tr("Write the measured errors as a page (HTML) or JSON"));
  connect(export_errors_, &QAction::triggered, this, &ExportActions::choose_errors);
  const auto enable = [this] {
    const QList<QAction*> others{export_colors_, save_figure_, save_scene_};
    for (QAction* action : others + actions_) {
      enable_if(*action, frame_.state.scene.snapshot() != nullptr, tr("No scene is solved yet"));
    }
  };
  connect(&frame_.state.scene, &OpenScene::snapshot_shown, this, enable);
  enable();
}

void ExportActions::add(const char* name, const QString& text, const QString& tip,
                        void (ExportActions::*what)()) {
  auto* action = make_action(this, name, text, tip);
  connect(action, &QAction::triggered, this, what);
  actions_ << action;
}

void ExportActions::add_to(QMenu& menu) const { menu.addActions(actions_); }

FigureViews ExportActions::figure_views() const {
  return {*frame_.page.scene_view(), frame_.state.colors, map_, charts_};
}

void ExportActions::write_result(const QString& path) {
  const auto snapshot = frame_.state.scene.snapshot();
  if (!snapshot) {
    throw InputError("there is no result yet");
  }
  if (snapshot->materials) {
    throw InputError(
        "results are written with the scene's own materials: undo their changes first, or save the "
        "scene "
        "with them and solve that");
  }
  check_result_path(path.toStdString());
  const bool complete = frame_.state.runner.state() == RunState::finished;
  writer_.request({path, [path, snapshot, complete] {
                     transillum::write_result(path.toStdString(), solution_of(*snapshot, complete));
                   }});
}

void ExportActions::write_colors(const QString& path, const DisplayOptions& display) {
  const auto snapshot = frame_.state.scene.snapshot();
  if (!snapshot) {
    throw InputError("there is no result yet");
  }
  const std::string file = path.toStdString();
  check_result_path(file);
  check_distinct({file}, snapshot->loaded->scene->files());
  display.validate();
  writer_.request({path, [file, snapshot, display] {
                     transillum::write_result(file, solution_of(*snapshot), display);
                   }});
}

void ExportActions::write_errors(const QString& path) {
  const auto errors = frame_.state.colors.errors();
  if (!errors) {
    throw InputError("no errors have been measured yet");
  }
  check_error_report_path(path.toStdString());
  writer_.request({path, [path, errors] {
                     write_error_report(path.toStdString(), errors->report, errors->solve);
                   }});
}

void ExportActions::write_scene_file(const QString& path) {
  const auto loaded = frame_.state.scene.loaded();
  if (!loaded) {
    throw InputError("there is no scene yet");
  }
  const std::string file = path.toStdString();
  if (frame_.state.scene.awaits_faces()) {
    throw InputError("the scene is being edited");
  }
  check_writable(file);
  check_distinct({file, materials_file_of(file).string()}, loaded->scene->files());
  if (frame_.state.scene.faces().edited) {
    const std::vector<MaterialChange> changes = frame_.state.relighting.edits().changes();
    SceneDescription description = *whole_of(loaded)->description;
    change_materials(description, changes);
    write_obj(file, description);
    frame_.state.scene.set_saved(file, changes);
    return;
  }
  const MaterialEdits& edits = frame_.state.relighting.edits();
  writer_.request({path, [file, loaded, changes = edits.changes(), materials = edits.materials()] {
                     if (!loaded->description) {
                       write_obj(file, description_of(*loaded->scene, *materials));
                       return;
                     }
                     SceneDescription description = *loaded->description;
                     change_materials(description, changes);
                     write_obj(file, description);
                   }});
}

void ExportActions::write_map_picture(const QString& path) const {
  const Focus& focus = frame_.state.focus;
  if (!focus.map()) {
    throw std::runtime_error("there is no visibility map yet");
  }
  if (!focus.at_step() && is_map_picture(path.toStdString())) {
    FigurePlan plan;
    plan.scene = false;
    plan.map = true;
    write_figure(path, plan, figure_views());
    return;
  }
  // The writers draw one V.
  const std::int32_t step = focus.picture_step() - (focus.phase() == Phase::before ? 1 : 0);
  check_map_path(path.toStdString());
  MapPictureOptions options;
  options.patch_colors = frame_.state.colors.patch_colors();
  const std::vector<std::int32_t> rows = focus.map()->record().map_after(step);
  for (const Callout& callout : map_.canvas()->callouts()) {
    if (const auto place = place_in_map(callout, *focus.map(), rows, focus.position().step)) {
      options.labels.push_back({callout.text, *place});
    }
  }
  write_map(path.toStdString(), *focus.map()->loaded->scene, map_at(*focus.map(), step), options);
}

void ExportActions::write_charts(const QString& path) const {
  check_chart_path(path.toStdString());
  transillum::write_charts(path.toStdString(), charts_.charts(),
                           {1.0 * charts_.width(), 1.0 * charts_.height()});
}

void ExportActions::write_chart_values(const QString& path) const {
  const auto snapshot = frame_.state.scene.snapshot();
  if (!snapshot) {
    throw std::runtime_error("there is nothing to write yet");
  }
  write_file_whole(path.toStdString(),
                   [&](std::ostream& out) { put_chart_values(*snapshot, out); });
}

void ExportActions::copy_chart_values() const {
  if (const auto snapshot = frame_.state.scene.snapshot()) {
    std::ostringstream text;
    put_chart_values(*snapshot, text);
    QGuiApplication::clipboard()->setText(QString::fromStdString(text.str()));
  }
}

QString ExportActions::name_with(const char* ending) const {
  const QString scene =
      QString::fromStdString(frame_.state.scene.snapshot()->loaded->scene->name());
  return QFileInfo(scene).completeBaseName() + QString::fromLatin1(ending);
}

template <class Write>
void ExportActions::write_chosen(const QString& title, const QString& filter,
                                 const QString& proposed, Write write) {
  const QString path = ask_where_to_write(&frame_.window, title, filter, proposed);
  if (path.isEmpty()) {
    return;
  }
  try {
    write(path);
    if (!writing()) {
      frame_.notifier.show_written(path);
    }
  } catch (const std::exception& error) {
    frame_.notifier.show_failure(QString::fromStdString(error.what()));
  }
}

void ExportActions::choose_figure() {
  if (figure_.size.isEmpty()) {
    const QWidget* canvas = frame_.page.scene_view()->canvas();
    figure_.size = 2 * canvas->devicePixelRatioF() * QSizeF(canvas->size());
    figure_.text_points *= 2;
  }
  FigureDialog dialog(figure_, frame_.state.focus.map() != nullptr, &frame_.window);
  if (dialog.exec() != QDialog::Accepted) {
    return;
  }
  figure_ = dialog.plan();
  const bool has_bar = ColorBarSheet::applies(frame_.state.colors);
  const auto sharp = figure_.scene
                         ? frame_.page.sharp()->make(figure_.scene_pixels(has_bar), &frame_.window)
                         : QImage();
  if (sharp) {
    write_chosen(tr("Save figure"), tr("Figures (*.png *.svg *.pdf)"), name_with(".png"),
                 [&](const QString& path) { write_figure(path, figure_, figure_views(), *sharp); });
  }
}

void ExportActions::choose_result() {
  write_chosen(tr("Result"), tr("Results (*.vtp *.csv *.ply)"), name_with(".vtp"),
               [this](const QString& path) { write_result(path); });
}

void ExportActions::choose_colors() {
  const auto snapshot = frame_.state.scene.snapshot();
  ColorExportDialog dialog(snapshot, frame_.page.scene_view()->view_point(),
                           frame_.state.vertical.up(), &frame_.window);
  if (dialog.exec() == QDialog::Accepted) {
    const QString ending = dialog.ending();
    write_chosen(tr("Export for Blender or the web"), tr("Colors (*%1)").arg(ending),
                 name_with(ending.toLatin1()),
                 [&](const QString& path) { write_colors(path, dialog.display()); });
  }
}

void ExportActions::choose_errors() {
  write_chosen(tr("Measured errors"), tr("Reports (*.html *.json)"), name_with("-errors.html"),
               [this](const QString& path) { write_errors(path); });
}

void ExportActions::choose_scene_file() {
  write_chosen(tr("Save scene"), tr("Wavefront OBJ (*.obj)"), name_with("-changed.obj"),
               [this](const QString& path) { write_scene_file(path); });
}

bool ExportActions::save_edited() {
  if (frame_.state.scene.has_unsaved_faces()) {
    QMessageBox box(QMessageBox::Question, tr("Save scene"),
                    tr("Faces of the scene were edited, and no file has them yet."),
                    QMessageBox::Cancel, &frame_.window);
    box.setObjectName("unsaved_faces");
    const QPushButton* save = box.addButton(tr("Save scene…"), QMessageBox::AcceptRole);
    box.exec();
    if (box.clickedButton() == save) {
      choose_scene_file();
    }
  }
  return !frame_.state.scene.has_unsaved_faces();
}

void ExportActions::choose_map() {
  write_chosen(tr("Visibility map"), tr("Maps (*.svg *.pdf *.png *.vtp *.json)"),
               name_with("-map.svg"), [this](const QString& path) { write_map_picture(path); });
}

void ExportActions::choose_charts() {
  write_chosen(tr("Convergence charts"), tr("Vector graphics (*.svg *.pdf);;Pictures (*.png)"),
               name_with("-convergence.svg"), [this](const QString& path) { write_charts(path); });
}

void ExportActions::choose_values() {
  write_chosen(tr("Convergence values"), tr("Tables (*.csv)"), name_with("-convergence.csv"),
               [this](const QString& path) { write_chart_values(path); });
}

}  // namespace transillum::viewer
