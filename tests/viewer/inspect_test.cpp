// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Inspecting a solved scene in the window: tables, materials, overlays and views.
#include <QComboBox>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QRegularExpression>
#include <QSignalSpy>
#include <QSlider>
#include <QTabWidget>
#include <QTableView>
#include <QTemporaryDir>

#include "colors/color_bar.h"
#include "colors/pointer_label.h"
#include "inspected_window.h"
#include "model/snapshot_values.h"
#include "patches/patch_table.h"
#include "patches/patch_table_panel.h"
#include "scene/color_controls.h"
#include "scene/scene_page.h"
#include "state/camera_views.h"
#include "test_files.h"
#include "window/inspection_panels.h"

namespace transillum::viewer::inspect_test {

using namespace test;

namespace {

constexpr double most = 0.9;  ///< fraction of points without a line

}  // namespace

class InspectTest : public QObject {
  Q_OBJECT

 private slots:
  void form_factors_are_computed_on_demand() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    QVERIFY(!shown.window->snapshot()->form_factors);
    shown.trigger("show_direction");
    shown.window->colors.set_quantity(Quantity::form_factor_from);
    QCOMPARE(shown.text("color_note"), QString("Click a patch to see its form factors."));
    shown.window->selection.select(4);
    QVERIFY(shown.has_form_factors());
    QVERIFY(wait_for([&] { return shown.window->colors.missing().isEmpty(); }));
    QVERIFY(shown.text("color_note").startsWith("Patch 4 is selected"));
    QTRY_VERIFY(shown.fraction_in_own_color() > most);
    shown.window->colors.set_quantity(Quantity::radiosity);
    QVERIFY(!shown.part<QWidget>("color_note")->isVisible());
  }

  // Also on a small screen.
  void selecting_does_not_move_the_picture() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    for (const int width : {1600, 1280}) {
      shown.window->resize(width, 900);
      for (const Quantity quantity :
           {Quantity::form_factor_from, Quantity::form_factor_to, Quantity::origin,
            Quantity::response, Quantity::exact_queries}) {
        shown.window->selection.select(no_patch);
        shown.window->colors.set_quantity(quantity);
        QVERIFY(comes_to_rest(*shown.window));
        QWidget* canvas = shown.scene_view->canvas();
        const QRect before(canvas->mapTo(shown.window.get(), QPoint()), canvas->size());
        for (const PatchId patch : {4, 7, no_patch}) {
          shown.window->selection.select(patch);
          QVERIFY(
              wait_for([&] { return shown.window->settled() && !shown.window->colors.busy(); }));
          handle_posted();
          QCOMPARE(QRect(canvas->mapTo(shown.window.get(), QPoint()), canvas->size()), before);
        }
      }
    }
  }

  void the_pointer_tells_patch_value_and_form_factor_data() {
    QTest::addColumn<bool>("over_map");
    QTest::newRow("scene") << false;
    QTest::newRow("map") << true;
  }

  void the_pointer_tells_patch_value_and_form_factor() {
    QFETCH(const bool, over_map);
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    MapCanvas& map = *shown.map_view->canvas();
    QVERIFY(wait_for([&] { return map.up_to_date(); }));
    QWidget& canvas = over_map ? map : *shown.scene_view->canvas();
    const auto patch_at = [&](const QPoint& position) {
      return over_map ? map.patch_at(position) : shown.scene_view->patch_at(position);
    };
    QPoint place = canvas.rect().center();
    while (place.x() > 0 && patch_at(place) == no_patch) {
      place.rx() -= 3;
    }
    const PatchId patch = patch_at(place);
    QVERIFY(patch != no_patch);
    const auto* label = canvas.findChild<PointerLabel*>();
    const auto lines = [label] { return label->text().split('\n'); };
    QVERIFY(!label->isVisible());
    QTest::mouseMove(&canvas, place + QPoint(1, 0));
    QTest::mouseMove(&canvas, place);
    QTRY_VERIFY(label->isVisible());
    const auto snapshot = shown.window->snapshot();
    QCOMPARE(lines().size(), 2);
    QCOMPARE(lines()[0], QString("Patch %1").arg(patch));
    QCOMPARE(lines()[1],
             QString("B  %1 W/m²").arg(rgb_text(snapshot->radiosity[std::size_t(patch)])));

    // The form factor to the selected patch comes as soon as it is known.
    const PatchId selected = patch == 0 ? 1 : 0;
    QVERIFY(!snapshot->form_factors);
    shown.window->selection.select(selected);
    QVERIFY(shown.has_form_factors());
    const double expected =
        form_factors_to(*shown.window->snapshot()->form_factors, selected)[std::size_t(patch)];
    // Details may follow the text.
    QTRY_VERIFY(lines().contains(
        QString("F %1→%2  %3").arg(patch).arg(selected).arg(number_text(expected))));
    save_picture(*shown.window, QStringLiteral("pointer-over-%1").arg(QTest::currentDataTag()));
    shown.window->colors.set_quantity(Quantity::fragments);
    QCOMPARE(lines()[1],
             QString("fragments  %1")
                 .arg(number_text(shown.window->colors.values()[std::size_t(patch)].r)));
    QTest::mousePress(&canvas, Qt::LeftButton, {}, place);
    QVERIFY(!label->isVisible());
    QTest::mouseRelease(&canvas, Qt::LeftButton, {}, place);
  }

  void the_inspector_shows_the_irradiance() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    shown.window->selection.select(4);
    QCOMPARE(shown.text("patch_irradiance"), rgb_text(shown.window->snapshot()->irradiance[4]));
  }

  void the_inspector_shows_the_error_of_the_patch() {
    const Inspected shown("cornell-box", {.directions = 48, .first_shot = {}, .replicas = 4});
    QVERIFY(shown.ready);
    shown.window->selection.select(4);
    const auto& errors = shown.window->snapshot()->error.standard_error;
    QVERIFY(max_abs(errors.at(4)) > 0);
    QCOMPARE(shown.text("patch_error"), rgb_text(errors[4]));
  }

  void tips_name_sections_that_hold_their_equations() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    const QString algorithm =
        QString::fromUtf8(contents_of(TRANSILLUM_SOURCE "/libtransillum/ALGORITHM.md"));
    const auto section_text = [&algorithm](const QString& number) {
      const QRegularExpression heading(
          "^##+ " + QRegularExpression::escape(number) + "\\.? .*?^##",
          QRegularExpression::MultilineOption | QRegularExpression::DotMatchesEverythingOption);
      return heading.match(algorithm).captured();
    };
    // "eq. 20 and 21" and "eq. 8, 9" name two equations.
    const auto equations_in = [](const QString& text) {
      QSet<QString> numbers;
      static const QRegularExpression list("eq\\. (\\d+(?:(?:, | and )\\d+)*)"), digits("\\d+");
      for (auto lists = list.globalMatch(text); lists.hasNext();) {
        for (auto each = digits.globalMatch(lists.next().captured(1)); each.hasNext();) {
          numbers << each.next().captured();
        }
      }
      return numbers;
    };
    QSet<QString> explained;
    static const QRegularExpression reference("ALGORITHM\\.md, section ([\\d.]+)$");
    for (const QWidget* widget : shown.window->findChildren<QWidget*>()) {
      const auto match = reference.match(widget->toolTip());
      if (!match.hasMatch()) {
        QVERIFY2(equations_in(widget->toolTip()).isEmpty(), qPrintable(widget->toolTip()));
        continue;
      }
      const QString section = section_text(match.captured(1));
      QVERIFY2(!section.isEmpty(), qPrintable(widget->toolTip()));
      for (const QString& equation : equations_in(widget->toolTip())) {
        QVERIFY2(equations_in(section).contains(equation), qPrintable(widget->toolTip()));
        explained << equation;
      }
    }
    QVERIFY(explained.contains(QSet<QString>{"17", "21", "22", "25", "37", "43"}));
    for (const char* symbol : {"patch_exitance", "patch_reflectance", "patch_radiosity",
                               "patch_irradiance", "patch_form_factor_sum", "color_bar"}) {
      QVERIFY2(
          reference.match(shown.part<QWidget>(symbol)->toolTip().section('\n', 0, 1)).hasMatch(),
          symbol);
    }
  }

  void colors_tell_what_lights_a_patch_and_what_would() {
    const Inspected shown("cornell-box", {.directions = 32, .tolerance = 1e-10});
    QVERIFY(shown.ready);
    auto* quantity = shown.part<QComboBox>("quantity");
    quantity->setCurrentIndex(quantity->findText("What would light the selection"));
    QCOMPARE(shown.text("color_note"), QString("Click a patch to see what lights it."));
    ColorChoice& colors = shown.window->colors;
    shown.window->selection.select(9);
    shown.window->selection.select(4);  // the newest is solved
    QTRY_VERIFY(!colors.values().empty() && !colors.busy());
    const std::vector<Rgb> per_watt = colors.values();
    const auto before = shown.window->snapshot();
    const Scene& scene = *before->loaded->scene;
    QVERIFY(per_watt ==
            solve_adjoint(scene, *before->form_factors, 4, scene.materials(), {.tolerance = 1e-10})
                .per_watt);

    quantity->setCurrentIndex(quantity->findText("What lights the selection"));
    QVERIFY(!colors.busy());  // by the same solve
    Rgb sum;
    for (const Rgb& part : colors.values()) {
      sum += part;
    }
    const auto relit = [&scene, &before](const std::vector<Material>& materials,
                                         const std::vector<std::int32_t>& of_patch) {
      return relight(scene, *before->form_factors, materials,
                     {.tolerance = 1e-12, .patch_materials = of_patch})
          .radiosity[4];
    };
    const Rgb b = relit(scene.materials(), {});
    QVERIFY(max_abs(sum - b) < 1e-8 * max_abs(b));

    // A watt on patch 9, added by the sliders' edits, has the predicted effect.
    MaterialEdits& edits = shown.window->relighting.edits();
    const double watt = 1 / scene.patch(9).area;
    edits.set_exitance(MaterialEdits::target_of(scene, TargetKind::face, 9), {watt, watt, watt});
    QTRY_VERIFY(shown.window->snapshot()->materials != nullptr);
    const PatchMaterials& edited = *shown.window->snapshot()->materials;
    const Rgb effect = relit(edited.materials, edited.of_patch) - b;
    QVERIFY(max_abs(per_watt[9]) > 1e-3);
    QVERIFY(max_abs(effect - per_watt[9]) < 1e-8 * max_abs(per_watt[9]));
    // The part of patch 9 follows the edit.
    QTRY_VERIFY(!colors.busy() && max_abs(colors.values()[9] - effect) < 1e-8 * max_abs(effect));
    save_picture(*shown.window, "what-lights");
    // Nothing of the title of the color bar is cut off.
    colors.set_quantity(Quantity::response);
    QTRY_VERIFY(!colors.busy());
    auto* bar = shown.window->findChild<ColorBar*>();
    QTRY_VERIFY(bar->isVisible());
    const QImage title = bar->grab().toImage();
    for (const int x : {0, 1, title.width() - 2, title.width() - 1}) {
      for (int y = 0; y < 32; ++y) {
        QCOMPARE(title.pixel(x, y), title.pixel(0, 0));
      }
    }
    colors.set_quantity(Quantity::origin);
    shown.window->selection.select(no_patch);
    QVERIFY(colors.values().empty());
  }

  void several_patches_are_selected_and_summed() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    Selection& selection = shown.window->selection;
    const auto* sums = shown.part<QLabel>("selected_area");
    QWidget* canvas = shown.scene_view->canvas();
    const auto place_of = [&](const auto& wanted) {
      for (int y = 5; y < canvas->height(); y += 7) {
        for (int x = 5; x < canvas->width(); x += 7) {
          const PatchId patch = shown.scene_view->patch_at({x, y});
          if (patch != no_patch && wanted(patch)) {
            return QPoint(x, y);
          }
        }
      }
      return QPoint();
    };
    const QPoint first = place_of([](PatchId) { return true; });
    const PatchId a = shown.scene_view->patch_at(first);
    const QPoint second = place_of([a](PatchId patch) { return patch != a; });
    const PatchId b = shown.scene_view->patch_at(second);
    QTest::mouseClick(canvas, Qt::LeftButton, {}, first);
    QVERIFY(sums->isHidden() || !sums->isVisibleTo(shown.window.get()));
    QTest::mouseClick(canvas, Qt::LeftButton, Qt::ControlModifier, second);
    QCOMPARE(selection.patch(), b);
    QVERIFY((selection.patches() == std::vector<PatchId>{std::min(a, b), std::max(a, b)}));
    const auto snapshot = shown.window->snapshot();
    const Scene& scene = *snapshot->loaded->scene;
    QCOMPARE(sums->text(), number_text(scene.patch(a).area + scene.patch(b).area));
    QCOMPARE(shown.text("selected_leaving"),
             rgb_text(scene.patch(a).area * snapshot->radiosity[std::size_t(a)] +
                      scene.patch(b).area * snapshot->radiosity[std::size_t(b)]));
    QTest::mouseClick(canvas, Qt::LeftButton, Qt::ControlModifier, second);
    QCOMPARE(selection.patch(), a);
    QCOMPARE(selection.patches().size(), std::size_t{1});
  }

  void the_patches_of_a_material_and_of_a_face_are_selected() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    Selection& selection = shown.window->selection;
    const Scene& scene = *shown.window->snapshot()->loaded->scene;
    const PatchId a = 4;
    selection.select(a);
    shown.trigger("select_material");
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      QCOMPARE(selection.contains(i), scene.patch(i).material == scene.patch(a).material);
    }
    QCOMPARE(selection.patch(), a);
    QCOMPARE(shown.text("selected_count"),
             QString("%1 patches, i = %2").arg(selection.patches().size()).arg(a));
    save_picture(*shown.window, "several-selected");
    selection.select(a);
    shown.trigger("select_face");
    for (const PatchId i : selection.patches()) {
      QCOMPARE(scene.patch(i).face, scene.patch(a).face);
    }
    QVERIFY(!shown.part<QAction>("select_group")->isEnabled());  // the box has none
  }

  void a_range_of_the_color_bar_selects_patches() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    ColorChoice& colors = shown.window->colors;
    colors.set_mode(ColorMode::luminance);
    colors.set_logarithmic(true);
    auto* bar = shown.part<ColorBar>("color_bar");
    QTRY_VERIFY(bar->isVisible());
    const int top = bar->height() / 3, bottom = 2 * bar->height() / 3;
    QTest::mousePress(bar, Qt::LeftButton, {}, {20, bottom});
    QTest::mouseMove(bar, {20, top});
    QTest::mouseRelease(bar, Qt::LeftButton, {}, {20, top});
    const Selection& selection = shown.window->selection;
    QVERIFY(selection.patches().size() > 1);
    // All patches with values between the two chosen values are selected.
    double low = HUGE_VAL, high = 0;
    const auto value = [&](PatchId i) {
      return colors.scale().value(colors.values()[std::size_t(i)]);
    };
    for (const PatchId i : selection.patches()) {
      low = std::min(low, value(i));
      high = std::max(high, value(i));
    }
    QVERIFY(colors.scale().position(low) > 0.1 && colors.scale().position(high) < 0.9);
    bool others = false;
    for (PatchId i = 0; i < PatchId(colors.values().size()); ++i) {
      const bool between = value(i) >= low && value(i) <= high;
      QCOMPARE(selection.contains(i), between);
      others = others || !between;
    }
    QVERIFY(others);
    // A click changes nothing.
    const auto chosen = selection.patches();
    QTest::mouseClick(bar, Qt::LeftButton, {}, {20, top});
    QVERIFY(selection.patches() == chosen);
  }

  void a_click_on_a_warning_goes_to_its_face() {
    const QTemporaryDir folder;
    write_file(folder.filePath("lamp.mtl"), "newmtl lamp\nKd .5 .5 .5\nKe 1 1 1\n");
    const QString scene =
        write_file(folder.filePath("warned.obj"),
                   "mtllib lamp.mtl\nusemtl lamp\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\n"
                   "v 1 1 1\nv 2 1 1\nv 2 2 1.5\nv 1 2 1\n"
                   "f 1 2 3 4\nf 5 6 7 8\n");  // face 1 is not planar
    const Inspected shown(scene);
    QVERIFY(shown.ready);
    auto* button = shown.part<QPushButton>("list_warnings");
    auto* list = shown.part<QListWidget>("warning_list");
    QTRY_VERIFY(button->isVisible());
    button->click();
    QTRY_VERIFY(list->isVisible());
    const auto items = list->findItems("face 1: ", Qt::MatchContains);
    QCOMPARE(items.size(), 1);
    const ViewPoint before = shown.scene_view->view_point();
    const QRect place = list->visualItemRect(items[0]);
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, place.center());
    const std::vector<PatchId>& patches = shown.window->selection.patches();
    QCOMPARE(patches.size(), std::size_t{2});  // its triangles
    for (const PatchId i : patches) {
      QCOMPARE(shown.window->snapshot()->loaded->scene->patch(i).face, 1);
    }
    QVERIFY(distance_of(shown.scene_view->view_point(), before) > 0.1);
    shown.window->show_failure("another message");
    QVERIFY(!button->isVisible());
  }

  void tables_and_views_share_the_selection() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    QVERIFY(shown.raise("table_dock"));
    const PatchTable& all = shown.table("patch_table");
    QVERIFY(wait_for([&] { return all.rowCount() > 0; }));
    auto* view = shown.part<QTableView>("patch_table");
    view->sortByColumn(2, Qt::DescendingOrder);
    const QRect cell = view->visualRect(all.index(1, 0));
    QTest::mouseClick(view->viewport(), Qt::LeftButton, {}, cell.center());
    QCOMPARE(shown.window->selection.patch(), all.patch(1));
    QCOMPARE(shown.text("patch_id"), QString::number(all.patch(1)));
    shown.window->selection.select(7);
    QCOMPARE(view->selectionModel()->selectedRows().size(), 1);
    QCOMPARE(all.patch(view->selectionModel()->selectedRows().front().row()), PatchId{7});

    auto* tabs = shown.part<PatchTablePanel>("table_panel")->findChild<QTabWidget*>();
    tabs->setCurrentIndex(1);
    const PatchTable& partners = shown.table("partner_table");
    QVERIFY(wait_for([&] { return partners.rowCount() > 0; }));
    QCOMPARE(partners.row_of(7), -1);
    const PatchId first = partners.patch(0);
    shown.window->selection.select(first);
    QCOMPARE(partners.row_of(first), -1);
    QVERIFY(partners.row_of(7) >= 0);
  }

  void search_selects_a_patch_and_csv_has_every_row() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    shown.trigger("find_patch");
    auto* search = shown.part<QLineEdit>("patch_search");
    const PatchTable& all = shown.table("patch_table");
    QVERIFY(wait_for([&] { return all.rowCount() > 0; }));
    QTest::keyClicks(search, "12");
    QTest::keyClick(search, Qt::Key_Return);
    QCOMPARE(shown.window->selection.patch(), PatchId{12});
    // Patch 1 itself is selected, not an earlier row whose number begins with 1.
    shown.part<QTableView>("patch_table")->sortByColumn(0, Qt::DescendingOrder);
    QTest::keyClicks(search, "1");
    QVERIFY(all.rowCount() > 1 && all.patch(0) != PatchId{1});
    QTest::keyClick(search, Qt::Key_Return);
    QCOMPARE(shown.window->selection.patch(), PatchId{1});
    shown.part<QTableView>("patch_table")->sortByColumn(0, Qt::AscendingOrder);

    const QTemporaryDir folder;
    auto* panel = shown.part<PatchTablePanel>("table_panel");
    panel->write_csv(folder.filePath("patches.csv"));
    QCOMPARE(contents_of(folder.filePath("patches.csv")).count('\n'), all.rowCount() + 1);
    QVERIFY_EXCEPTION_THROWN(panel->write_csv(folder.filePath("no/such/folder.csv")),
                             std::runtime_error);
  }

  void a_slider_relights_the_scene_and_undo_restores_it_data() {
    QTest::addColumn<QString>("how");
    for (const char* how : {"fixed", "first shot", "semi-iterative"}) {
      QTest::newRow(how) << QString::fromLatin1(how);
    }
  }

  void a_slider_relights_the_scene_and_undo_restores_it() {
    QFETCH(const QString, how);
    SolveOptions options{.directions = 32};
    if (how == "first shot") {
      options.first_shot = 0;
    }
    if (how == "semi-iterative") {
      options.scheme = Scheme::semi_iterative;
    }
    const Inspected shown("cornell-box", options);
    QVERIFY(shown.ready);
    QVERIFY(shown.raise("material_dock"));
    auto* slider = shown.part<QSlider>("exitance_red");
    QVERIFY(wait_for([&] { return slider->isEnabled(); }));
    QCOMPARE(
        shown.text("material_account").contains(how == "first shot" ? "first shot" : "iterations"),
        how != "fixed");
    const auto before = shown.window->snapshot();
    const Scene& scene = *before->loaded->scene;
    PatchId light = 0;
    while (max_abs(scene.exitance(light)) == 0) {
      ++light;
    }
    shown.window->selection.select(light);
    QCOMPARE(shown.part<QComboBox>("material")->currentIndex(), scene.patch(light).material);

    QSignalSpy snapshots(&shown.window->scene, &OpenScene::snapshot_shown);
    QVERIFY(shown.window->colors.exposure_is_automatic());
    slider->setValue(2 * slider->value());
    QVERIFY(wait_for([&] { return shown.window->snapshot()->materials != nullptr; }));
    // B doubles; automatic exposure would keep the picture the same.
    QVERIFY(!shown.window->colors.exposure_is_automatic());
    const auto after = shown.window->snapshot();
    QCOMPARE(after->progress.passes, before->progress.passes);
    QVERIFY(std::abs(material_of(*after, light).exitance.r / scene.exitance(light).r - 2) < 1e-9);
    // The slider keeps the ratio of the channels, so B doubles; relighting solves to convergence,
    // hence the comparison with the relit original.
    const Rgb dark =
        relight(scene, *before->form_factors, scene.materials(), {.shot = before->shot.get()})
            .radiosity[0];
    QVERIFY(max_abs(after->radiosity[0] - 2 * dark) < 1e-4 * max_abs(dark));

    shown.trigger("undo");
    QVERIFY(wait_for([&] { return shown.window->snapshot()->materials == nullptr; }));
    QVERIFY(shown.window->snapshot()->radiosity == before->radiosity);
    shown.trigger("redo");
    QVERIFY(wait_for([&] { return shown.window->snapshot()->materials != nullptr; }));
  }

  void coloring_by_error_offers_to_solve_with_replicas() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready);
    const auto* button = shown.part<QPushButton>("solve_with_replicas");
    QVERIFY(!button->isVisible());
    shown.window->colors.set_quantity(Quantity::error);
    QVERIFY(button->isVisible());
    QVERIFY(shown.text("color_note").contains("replicas"));
    shown.part<QPushButton>("solve_with_replicas")->click();
    QVERIFY(wait_for([&] {
      return shown.window->snapshot()->error.replicas == 8 &&
             shown.window->runner.state() == RunState::finished;
    }));
    QCOMPARE(shown.window->snapshot()->options.directions, 32);
    QVERIFY(!button->isVisible());
    QVERIFY(shown.window->colors.missing().isEmpty());
    QVERIFY(!shown.window->colors.values().empty());
  }

  void holding_the_groove_of_a_slider_is_one_undo_step() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.raise("material_dock"));
    QVERIFY(shown.has_form_factors());
    auto* slider = shown.part<QSlider>("rho_red");
    QVERIFY(wait_for([&] { return slider->isEnabled() && slider->isVisible(); }));
    slider->setPageStep(slider->maximum() / 50);
    slider->setValue(slider->maximum());
    QUndoStack& undo_stack = shown.window->undo;
    undo_stack.clear();
    int steps = 0;
    connect(slider, &QSlider::valueChanged, slider, [&] { ++steps; });
    const QPoint groove(slider->width() / 4, slider->height() / 2);
    QTest::mousePress(slider, Qt::LeftButton, {}, groove);
    const bool repeated = wait_for([&] { return steps >= 4; });
    QTest::mouseRelease(slider, Qt::LeftButton, {}, groove);
    QVERIFY(repeated);
    QCOMPARE(undo_stack.count(), 1);
  }

  void a_drag_is_one_undo_step() {
    QUndoStack undo;
    MaterialEdits edits(undo);
    const auto scene = load_scene("cornell-box");
    edits.start_with(scene);
    const std::string target = MaterialEdits::target_of(*scene, TargetKind::material, 0);
    const auto rho = [&] { return edits.materials()->of(0).reflectance; };
    edits.begin_drag();
    for (const double r : {0.1, 0.2, 0.3}) {
      edits.set_reflectance(target, {r, r, r});
    }
    edits.begin_drag();
    edits.set_reflectance(target, {0.5, 0.5, 0.5});
    QCOMPARE(undo.count(), 2);
    undo.undo();
    QCOMPARE(rho().r, 0.3);
    undo.undo();
    QVERIFY(rho() == scene->reflectance(0) && !edits.any());
    undo.redo();
    edits.restore();
    QVERIFY(!edits.any());
    undo.undo();
    QCOMPARE(rho().r, 0.3);
  }
};

const test::Registered registered("inspect", test::run_as_viewer<InspectTest>);

}  // namespace transillum::viewer::inspect_test

#include "inspect_test.moc"
