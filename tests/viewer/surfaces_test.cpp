// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel "Surfaces" (powers by group and material, actions on their patches), the sky of an open
// scene, and the fraction of sky of each patch.
#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QTabWidget>
#include <QTableView>
#include <QTemporaryDir>
#include <QToolButton>

#include "colors/color_scale.h"
#include "lessons/session_file.h"
#include "model/snapshot_values.h"
#include "open_scene.h"
#include "patches/patch_table.h"
#include "patches/path_panel.h"
#include "patches/surface_panel.h"
#include "radiosity/analysis/power_table.h"
#include "solved_window.h"
#include "widgets/fold.h"
#include "window/base/view_state_applier.h"
#include "window/files/window_session.h"

namespace transillum::viewer::surfaces_test {

using namespace test;

namespace {

SolveOptions under_a_sky() {
  return {.directions = 64, .tolerance = 1e-10, .sky = {.exitance = {5, 6, 7}}};
}

/// The open scene with its panel in front.
struct Shown {
  QTemporaryDir folder;
  SolvedWindow solved;
  SurfacePanel* panel = nullptr;
  QTabWidget* tabs = nullptr;

  explicit Shown(const QString& scene = {}, const SolveOptions& options = {.directions = 64})
      : solved(scene.isEmpty() ? write_open_scene(folder.path()) : scene, options) {
    auto* dock = window().findChild<QDockWidget*>("parts_dock");
    dock->show();
    dock->raise();
    panel = window().findChild<SurfacePanel*>();
    tabs = window().findChild<QTabWidget*>("surface_tabs");
    window().activateWindow();
    (void)QTest::qWaitForWindowActive(&window());
  }
  TestWindow& window() const { return *solved.window; }
  QTableView& view(const char* name) const { return *window().findChild<QTableView*>(name); }
  bool listed(const char* name = "group_table") const {
    return solved.ready &&
           wait_for([&] { return !panel->busy() && view(name).model()->rowCount() > 0; });
  }
  /// Solves the scene. @returns whether it has finished
  bool run() const {
    window().runner.run();
    return wait_for([&] { return window().runner.state() == RunState::finished; });
  }
  QString cell(const char* table, int row, int column) const {
    return view(table).model()->index(row, column).data().toString();
  }
  int row_of(const char* table, const QString& name) const {
    const QAbstractItemModel& model = *view(table).model();
    for (int row = 0; row < model.rowCount(); ++row) {
      if (model.index(row, 0).data().toString() == name) {
        return row;
      }
    }
    return -1;
  }
  void click(const char* table, const QString& name) const {
    QTableView& clicked = view(table);
    const QModelIndex index = clicked.model()->index(row_of(table, name), 0);
    clicked.scrollTo(index);
    clicked.setFocus();
    QTest::mouseClick(clicked.viewport(), Qt::LeftButton, {}, clicked.visualRect(index).center());
  }
  bool press(const char* button) const {
    auto* found = window().findChild<QToolButton*>(button);
    const bool enabled = found->isEnabled();
    QTest::mouseClick(found, Qt::LeftButton);
    return enabled;
  }
  PowerTable table(SurfaceKind by = SurfaceKind::group) const {
    const auto snapshot = window().snapshot();
    const PatchMaterials* materials = snapshot->materials.get();
    return power_table(
        solution_of(*snapshot), by, snapshot->form_factors.get(),
        materials ? std::span<const Material>(materials->materials) : std::span<const Material>(),
        materials ? std::span<const std::int32_t>(materials->of_patch)
                  : std::span<const std::int32_t>());
  }
};

const SurfacePower& surface_of(const PowerTable& table, const std::string& name) {
  return *std::find_if(table.surfaces.begin(), table.surfaces.end(),
                       [&](const SurfacePower& surface) { return surface.name == name; });
}

}  // namespace

class SurfacesTest : public QObject {
  Q_OBJECT

 private slots:
  void rows_are_the_powers_of_the_library() {
    const Shown shown;
    QVERIFY(shown.listed());
    QCOMPARE(shown.view("group_table").model()->rowCount(), 4);
    const PowerTable table = shown.table();
    const auto& model = *qobject_cast<PatchTable*>(shown.view("group_table").model());
    std::ostringstream csv;
    model.write_csv(csv);
    const QStringList lines = QString::fromStdString(csv.str()).split('\n');
    QVERIFY2(lines[0].startsWith("name,patches,area,emitted_r,emitted_g,emitted_b,received_r"),
             qPrintable(lines[0]));
    for (const QString& line : lines.mid(1, 4)) {
      const QStringList cells = line.split(',');
      const SurfacePower surface =  // no reference: GCC 14 takes it for one to the argument
          surface_of(table, cells[0] == "(no group)" ? "" : cells[0].toStdString());
      QCOMPARE(cells[1].toLongLong(), surface.patches);
      QCOMPARE(cells[2].toDouble(), surface.area);
      QCOMPARE(cells[3].toDouble(), surface.emitted.r);
      QCOMPARE(cells[6].toDouble(), surface.received.r);
      QCOMPARE(cells[9].toDouble(), surface.absorbed.r);
    }
    const QString caption = shown.solved.text("group_table_caption");
    QVERIFY2(caption.startsWith("4 groups, 4 patches") &&
                 caption.contains(number_text(luminance(table.total.emitted)) + " W emitted"),
             qPrintable(caption));
    save_picture(shown.window(), "groups");
  }

  void a_click_on_a_heading_sorts() {
    const Shown shown;
    QVERIFY(shown.listed());
    QTableView& view = shown.view("group_table");
    QHeaderView& header = *view.horizontalHeader();
    QTest::mouseClick(header.viewport(), Qt::LeftButton, {},
                      {header.sectionViewportPosition(0) + 5, header.height() / 2});
    QStringList names;
    for (int row = 0; row < 4; ++row) {
      names << shown.cell("group_table", row, 0);
    }
    QStringList sorted = names;
    sorted.sort();
    QVERIFY(names == sorted || names == QStringList(sorted.rbegin(), sorted.rend()));
  }

  void a_row_selects_its_patches_also_by_keys() {
    const Shown shown;
    QVERIFY(shown.listed());
    Selection& selection = shown.window().selection;
    shown.click("group_table", "floor");
    QCOMPARE(selection.patches(), std::vector<PatchId>{1});
    QTableView& view = shown.view("group_table");
    const int before = view.currentIndex().row();
    QTest::keyClick(&view, before == 3 ? Qt::Key_Up : Qt::Key_Down);
    QVERIFY(view.currentIndex().row() != before);
    QVERIFY(selection.patches() != std::vector<PatchId>{1});
    QCOMPARE(selection.patches().size(), std::size_t(1));
    // A marked row means that its patches are selected.
    selection.select(no_patch);
    QVERIFY(!view.selectionModel()->hasSelection());
    QTest::keyClick(&view, Qt::Key_Return);
    QCOMPARE(selection.patches().size(), std::size_t(1));

    shown.tabs->setCurrentIndex(1);
    shown.click("material_table", "white");
    QCOMPARE(selection.patches(), (std::vector<PatchId>{1, 3}));
  }

  void a_row_is_hidden_or_isolated_and_that_is_undone() {
    const Shown shown;
    QVERIFY(shown.listed());
    const HiddenPatches& hidden = shown.window().views().page.hidden();
    shown.click("group_table", "wall");
    QVERIFY(shown.press("hide_surface_button"));
    QCOMPARE(hidden.flags(), (std::vector<bool>{false, false, false, true}));
    QVERIFY(shown.press("isolate_surface_button"));
    QCOMPARE(hidden.flags(), (std::vector<bool>{true, true, true, false}));
    shown.solved.trigger("undo");
    shown.solved.trigger("undo");
    QVERIFY(!hidden.any());
    // The window's keys act on the same patches.
    QTest::keyClick(&shown.view("group_table"), Qt::Key_H);
    QCOMPARE(hidden.flags(), (std::vector<bool>{false, false, false, true}));
  }

  void a_right_click_on_a_group_is_about_its_patches() {
    const Shown shown;
    QVERIFY(shown.listed());
    QTableView& view = shown.view("group_table");
    const QModelIndex index = view.model()->index(shown.row_of("group_table", "wall"), 0);
    QTest::mouseClick(view.viewport(), Qt::RightButton, {}, view.visualRect(index).center());
    QCOMPARE(shown.window().selection.patches(), std::vector<PatchId>{3});
    QCOMPARE(view.contextMenuPolicy(), Qt::ActionsContextMenu);
    QStringList entries;
    for (const QAction* action : view.actions()) {
      entries << action->text();
      QVERIFY2(action->isEnabled() || !action->property("why_disabled").toString().isEmpty(),
               qPrintable(action->text()));
    }
    QCOMPARE(entries, (QStringList{"Select its patches", "Hide", "Isolate", "Make it emit",
                                   "Make it reflect", "Copy the name"}));
    view.actions().back()->trigger();
    QCOMPARE(QGuiApplication::clipboard()->text(), QString("wall"));
  }

  void a_group_is_made_to_emit_in_one_step() {
    const Shown shown;
    QVERIFY(shown.listed());
    const int steps = shown.window().undo.count();
    shown.click("group_table", "wall");
    QTest::keyClick(&shown.view("group_table"), Qt::Key_E);
    QCOMPARE(shown.window().undo.count(), steps + 1);
    QVERIFY(wait_for([&] { return shown.window().snapshot()->materials != nullptr; }));
    QVERIFY(wait_for([&] {
      return shown.window().settled() &&
             surface_of(shown.table(), "wall").emitted == Rgb{80, 80, 80};
    }));
    const int row = shown.row_of("group_table", "wall");
    QVERIFY(wait_for([&] { return shown.cell("group_table", row, 3).startsWith("80"); }));
    QVERIFY(!shown.press("emit_surface_button"));
    save_picture(shown.window(), "groups-emit");
    shown.solved.trigger("undo");
    QVERIFY(!shown.window().relighting.edits().any());
    QVERIFY(wait_for([&] { return shown.cell("group_table", row, 3).startsWith("0"); }));
  }

  void a_lamp_is_made_to_reflect_in_one_step() {
    const Shown shown;
    QVERIFY(shown.listed());
    MaterialEdits& edits = shown.window().relighting.edits();
    shown.click("group_table", "lamp");
    QVERIFY(!shown.window().findChild<QToolButton*>("emit_surface_button")->isEnabled());
    QVERIFY(shown.press("reflect_surface_button"));
    QVERIFY(edits.values_of("group:lamp").exitance == Rgb{});
    QVERIFY((edits.values_of("group:lamp").reflectance == Rgb{0.5, 0.5, 0.5}));
    shown.solved.trigger("undo");
    QVERIFY(!edits.any());
    shown.click("group_table", "(no group)");
    QVERIFY(!shown.press("emit_surface_button"));
  }

  void groups_exchange_what_the_library_says() {
    const Shown shown;
    QVERIFY(shown.listed());
    shown.tabs->setCurrentIndex(2);
    QVERIFY(shown.listed("exchange_table"));
    const PowerTable table = shown.table();
    const auto index_of = [&](const char* name) {
      return static_cast<std::size_t>(&surface_of(table, name) - table.surfaces.data());
    };
    const Rgb expected = table.exchanged[index_of("floor")][index_of("lamp")];
    QVERIFY(max_abs(expected) > 0);
    const auto& model = *qobject_cast<PatchTable*>(shown.view("exchange_table").model());
    std::ostringstream csv;
    model.write_csv(csv);
    bool found = false;
    for (const QString& line : QString::fromStdString(csv.str()).split('\n')) {
      const QStringList cells = line.split(',');
      if (cells[0] == "lamp" && cells.value(1) == "floor") {
        found = true;
        QCOMPARE(cells[2].toDouble(), expected.r);
      }
    }
    QVERIFY(found);
    save_picture(shown.window(), "groups-exchange");
  }

  void a_scene_without_groups_shows_its_materials() {
    const Shown shown("cornell-box");
    QVERIFY(shown.listed("material_table"));
    QCOMPARE(shown.tabs->currentIndex(), 1);
  }

  void the_fraction_of_sky_is_in_table_and_inspector() {
    const Shown shown;
    QVERIFY(shown.listed());
    const auto snapshot = shown.window().snapshot();
    QCOMPARE(snapshot->sky_fractions.size(), std::size_t(4));
    for (std::size_t i = 0; i < 4; ++i) {
      QVERIFY(snapshot->sky_fractions[i] > 0.05 && snapshot->sky_fractions[i] <= 1.01);
    }
    shown.window().selection.select(1);
    QCOMPARE(shown.solved.text("patch_sky_fraction"),
             QString::number(snapshot->sky_fractions[1], 'f', 6));
    shown.window().colors.set_quantity(Quantity::sky_fraction);
    QCOMPARE(shown.window().colors.values()[1].r, snapshot->sky_fractions[1]);
  }

  void the_slider_gives_an_open_scene_a_sky() {
    const Shown shown;
    QVERIFY(shown.listed());
    auto* slider = shown.window().findChild<QSlider*>("sky_slider");
    auto* value = shown.window().findChild<QDoubleSpinBox*>("sky");
    auto* up = shown.window().findChild<QComboBox*>("sky_up");
    auto* model = shown.window().findChild<QComboBox*>("sky_model");
    auto* section = shown.window().findChild<FoldHeader*>("sky_section");
    section->setChecked(true);
    QVERIFY(slider->isVisible() && !model->isVisible());
    const Rgb before = shown.window().snapshot()->irradiance[1];
    slider->setFocus();
    QTest::keyClick(slider, Qt::Key_End);
    QCOMPARE(value->value(), 100.0);
    QVERIFY(model->isVisible() && !up->isVisible());
    model->setCurrentIndex(1);
    QVERIFY(up->isVisible());
    QVERIFY2(section->state().startsWith("100 W/m²"), qPrintable(section->state()));
    QCOMPARE(up->currentText(), QString("+z"));  // most of its surface is level then
    up->setCurrentIndex(0);
    const Sky expected{{100, 100, 100}, SkyModel::cie_overcast, {0, 0, 1}};
    QVERIFY(shown.window().views().settings.solve_options().sky == expected);
    save_picture(shown.window(), "sky-settings");
    QTest::mouseClick(shown.window().findChild<QPushButton*>("restart"), Qt::LeftButton);
    QVERIFY(wait_for([&] {
      return shown.window().settled() && shown.window().snapshot()->options.sky == expected &&
             shown.window().runner.state() == RunState::finished;
    }));
    const auto snapshot = shown.window().snapshot();
    QVERIFY(snapshot->sky_irradiance[1].r > 30);
    QVERIFY(snapshot->irradiance[1].r > before.r + 30);
    QVERIFY(shown.listed());
    const auto titles = [&] {
      QStringList all;
      const QAbstractItemModel& table = *shown.view("group_table").model();
      for (int column = 0; column < table.columnCount(); ++column) {
        all << table.headerData(column, Qt::Horizontal).toString();
      }
      return all.join(' ');
    };
    QVERIFY2(titles().contains("From sky") && titles().contains("Escaped"), qPrintable(titles()));

    shown.solved.trigger("copy_solve");
    const QString command = QApplication::clipboard()->text();
    QVERIFY2(command.contains("--sky 100 --sky-model cie-overcast"), qPrintable(command));
    const Session session{shown.window().applier().state(), {}, {}, {}, {}};
    const std::string text = to_text(session, "/");
    QVERIFY(session_from_text(text, "s", "/").state.options.solve.sky == expected);
    save_picture(shown.window(), "sky");
  }

  void the_light_of_the_sky_remains_when_materials_change() {
    const Shown shown({}, under_a_sky());
    QVERIFY(shown.listed() && shown.run());
    shown.window().runner.include_form_factors();
    QVERIFY(wait_for([&] { return shown.window().snapshot()->form_factors != nullptr; }));
    const auto before = shown.window().snapshot();
    // A change that changes no light: the reflectance of the lamp's black back stays 0.
    shown.window().relighting.edits().set_exitance("group:lamp", {9, 8, 7.0000001});
    QVERIFY(wait_for([&] { return shown.window().snapshot()->materials != nullptr; }));
    const auto after = shown.window().snapshot();
    for (std::size_t i = 0; i < before->radiosity.size(); ++i) {
      QVERIFY(max_abs(after->irradiance[i] - before->irradiance[i]) <
              1e-6 * max_abs(before->irradiance[i]));
    }
  }

  void light_paths_have_the_light_of_the_sky() {
    const Shown shown({}, under_a_sky());
    QVERIFY(shown.listed() && shown.run());
    shown.window().selection.select(0);
    shown.window().views().docks.bring_to_front("paths");
    auto* panel = shown.window().findChild<PathPanel*>("path_panel");
    QVERIFY(wait_for([&] { return panel->paths() != nullptr; }));
    const LightPaths& paths = *panel->paths();
    const auto snapshot = shown.window().snapshot();
    QVERIFY(max_abs(at(snapshot->radiosity, 0)) > 0);
    QVERIFY(max_abs(paths.radiosity - at(snapshot->radiosity, 0)) <
            1e-6 * max_abs(at(snapshot->radiosity, 0)));
    // Some paths begin at a patch that emits nothing.
    QVERIFY(std::any_of(paths.paths.begin(), paths.paths.end(), [&](const LightPath& path) {
      return max_abs(snapshot->loaded->scene->exitance(path.patches.front())) == 0;
    }));
  }

  void a_closed_scene_sees_no_sky() {
    const Shown shown("furnace");
    QVERIFY(shown.solved.ready);
    const auto* section = shown.window().findChild<FoldHeader*>("sky_section");
    auto* panel = shown.window().findChild<SettingsPanel*>();
    QVERIFY(wait_for([&] { return !section->isVisibleTo(panel); }));
    panel->show_escape(0.3);
    QVERIFY(section->isVisibleTo(panel));
    panel->show_escape(0);
    QVERIFY(!section->isVisibleTo(panel));
    panel->show_escape({});  // unknown
    QVERIFY(section->isVisibleTo(panel));
  }

  void a_sky_of_a_session_keeps_its_digits_and_color() {
    SolveOptions options;
    options.sky = {{0.123456789, 0.2, 0.3}, SkyModel::cie_overcast, normalized({1, 2, 3})};
    SettingsPanel panel;
    panel.set_options(options, {});
    QVERIFY(panel.solve_options().sky == options.sky);
    panel.findChild<QDoubleSpinBox*>("sky")->setValue(0.6);
    QVERIFY(max_abs(panel.solve_options().sky.exitance - Rgb{0.246913578, 0.4, 0.6}) < 1e-12);
    QVERIFY(panel.solve_options().sky.up == options.sky.up);
  }
};

const test::Registered registered("surfaces", test::run_as_viewer<SurfacesTest>);

}  // namespace transillum::viewer::surfaces_test

#include "surfaces_test.moc"
