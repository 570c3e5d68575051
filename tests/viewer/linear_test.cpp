// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Solves and results whose B is linear on patches, in the window: every pixel of the scene has the
// color of B at its point, the plate and the inspector show B at a point and the coefficients.
#include <QAbstractButton>
#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QTemporaryDir>
#include <algorithm>
#include <map>

#include "colors/pointer_label.h"
#include "model/snapshot_values.h"
#include "scene/color_controls.h"
#include "scene/direction_glyph.h"
#include "scene/show_menu.h"
#include "solved_window.h"
#include "transillum/files.h"
#include "window/files/export_actions.h"

namespace transillum::viewer::linear_test {

using namespace test;

namespace {

const SolveOptions linear_options{.directions = 64, .basis = Basis::linear, .first_shot = {}};

/// A window with a solve that has converged.
struct LinearWindow : SolvedWindow {
  explicit LinearWindow(const SolveOptions& options = linear_options)
      : SolvedWindow("cornell-box", options) {
    window->runner.run();
    scene_view->set_outlines_shown(false);  // also outlines of the convex pieces of a patch
    ready = ready && settles([this] { return window->runner.state() == RunState::finished; });
  }

  bool settles(const std::function<bool()>& reached) const {
    return wait_for([&] { return reached() && window->settled(); });
  }
  template <class Widget>
  Widget* part(const char* name) const {
    return window->findChild<Widget*>(name);
  }
};

bool far_from_borders(const SceneView& view, const QPoint& p, PatchId patch) {
  constexpr int margin = 7;
  for (const QPoint offset :
       {QPoint(margin, 0), QPoint(-margin, 0), QPoint(0, margin), QPoint(0, -margin)}) {
    if (view.patch_at(p + offset) != patch) {
      return false;
    }
  }
  return true;
}

constexpr int most_difference = 2;  // rounding

struct Compared {
  int pixels = 0;    ///< compared
  int largest = 0;   ///< difference of a channel, of 255
  int others = 0;    ///< pixels with a difference of more than most_difference
  int negative = 0;  ///< where B is below 0 in a channel
};

/// Compares pixels inside patches with the colors of B at their points. The point of a pixel is
/// known to a pixel, and near 0 a gamma is steep: a pixel may have any of the colors around it.
/// @param scale  pixels of the picture per pixel of the canvas
/// @param dimmed  whether each patch is dimmed; empty if none is
Compared compare(const SceneView& view, const ColorChoice& colors, const QImage& picture,
                 int scale = 1, const std::vector<bool>& dimmed = {}) {
  Compared result;
  for (int y = 8; y < view.canvas()->height() - 8; y += 9) {
    for (int x = 8; x < view.canvas()->width() - 8; x += 9) {
      const auto hit = view.hit_at({x, y});
      if (!hit || !far_from_borders(view, {x, y}, hit->patch)) {
        continue;
      }
      std::vector<Color8> around;
      for (const QPoint offset :
           {QPoint(0, 0), QPoint(1, 1), QPoint(-1, 1), QPoint(1, -1), QPoint(-1, -1)}) {
        const auto near = view.hit_at(QPoint(x, y) + offset);
        if (near && near->patch == hit->patch) {
          around.push_back(colors.scale().color(colors.value_at(near->patch, near->point)));
        }
      }
      if (!dimmed.empty()) {
        const bool dim = dimmed.at(std::size_t(hit->patch));
        dim_patches(std::vector<bool>(around.size(), dim), around);
      }
      const QRgb pixel = picture.pixel(scale * x + scale / 2, scale * y + scale / 2);
      const int channels[] = {qRed(pixel), qGreen(pixel), qBlue(pixel)};
      int difference = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        int low = 255, high = 0;
        for (const Color8& color : around) {
          low = std::min<int>(low, color[c]);
          high = std::max<int>(high, color[c]);
        }
        difference = std::max({difference, low - channels[c], channels[c] - high});
      }
      result.largest = std::max(result.largest, difference);
      result.others += difference > most_difference ? 1 : 0;
      const Rgb b = colors.value_at(hit->patch, hit->point);
      ++result.pixels;
      result.negative += std::min({b.r, b.g, b.b}) < 0 ? 1 : 0;
    }
  }
  return result;
}

QString text_of(const Compared& c) {
  return QStringLiteral("%1 pixels, %2 below 0, difference %3, %4 differ")
      .arg(c.pixels)
      .arg(c.negative)
      .arg(c.largest)
      .arg(c.others);
}

/// The patch whose colors in the picture differ most, at least by this.
int spread_within_a_patch(const SceneView& view, const QImage& picture) {
  std::map<PatchId, std::pair<int, int>> range;
  for (int y = 8; y < view.canvas()->height() - 8; y += 9) {
    for (int x = 8; x < view.canvas()->width() - 8; x += 9) {
      const PatchId patch = view.patch_at({x, y});
      if (patch == no_patch || !far_from_borders(view, {x, y}, patch)) {
        continue;
      }
      const int gray = qGray(picture.pixel(x, y));
      auto& [low, high] = range.try_emplace(patch, gray, gray).first->second;
      low = std::min(low, gray);
      high = std::max(high, gray);
    }
  }
  int spread = 0;
  for (const auto& [patch, ends] : range) {
    spread = std::max(spread, ends.second - ends.first);
  }
  return spread;
}

}  // namespace

class LinearTest : public QObject {
  Q_OBJECT

 private slots:
  // The scene that a user sees first who has chosen nothing.
  void cards_of_coarse_scenes_open_soft() {
    auto window = make_window(64);
    window->files().set_divides(true);
    const auto open_card = [&](const char* name) {
      window->findChild<QAbstractButton*>(QStringLiteral("built_in_%1").arg(name))->click();
      return wait_for([&] {
        return window->snapshot() && window->scene.spec() == name &&
               window->snapshot()->progress.finished && window->settled();
      });
    };
    const auto basis = [&] { return window->snapshot()->options.basis; };
    const auto patches = [&] { return window->snapshot()->loaded->scene->patch_count(); };
    QVERIFY(open_card("cornell-box"));
    QVERIFY(basis() == Basis::linear);
    QVERIFY2(patches() > 1800 && patches() < 2200, qPrintable(QString::number(patches())));
    QVERIFY(!window->views().settings.differ_from_effect());
    QVERIFY(!window->findChild<ColorControls*>()->outlines());
    save_picture(*window, "soft-cornell-box");
    // Linear functions were chosen for that scene, not by the user.
    QVERIFY(open_card("furnace"));
    QVERIFY(basis() == Basis::constant);
    QCOMPARE(patches(), 12);
    // Settings that exclude linear functions stay.
    SolveOptions local = window->views().settings.solve_options();
    local.engine = Engine::zbuffer;
    window->set_options(local, {});
    QVERIFY(open_card("cornell-box"));
    QVERIFY(basis() == Basis::constant);
    QVERIFY(window->snapshot()->options.engine == Engine::zbuffer);
    // The options that the user has chosen stay.
    window->set_options({.directions = 16, .basis = Basis::linear}, {});
    QVERIFY(open_card("rooms"));
    QVERIFY(open_card("furnace"));
    QVERIFY(basis() == Basis::linear);
  }

  void every_pixel_has_the_color_of_its_point_data() {
    QTest::addColumn<int>("mode");
    QTest::addColumn<int>("map");
    QTest::addColumn<bool>("logarithmic");
    const auto row = [](const char* name, ColorMode mode, ColorMap map, bool logarithmic) {
      QTest::newRow(name) << static_cast<int>(mode) << static_cast<int>(map) << logarithmic;
    };
    row("true color", ColorMode::true_color, ColorMap::viridis, false);
    row("viridis", ColorMode::luminance, ColorMap::viridis, false);
    row("cividis", ColorMode::red, ColorMap::cividis, false);
    row("inferno, logarithmic", ColorMode::blue, ColorMap::inferno, true);
  }

  void every_pixel_has_the_color_of_its_point() {
    QFETCH(const int, mode);
    QFETCH(const int, map);
    QFETCH(const bool, logarithmic);
    const LinearWindow shown;
    QVERIFY(shown.ready);
    ColorChoice& colors = shown.window->colors;
    QVERIFY(colors.linear());
    shown.scene_view->set_direction_shown(false);
    colors.set_mode(static_cast<ColorMode>(mode));
    colors.set_map(static_cast<ColorMap>(map));
    colors.set_logarithmic(logarithmic);
    QVERIFY(comes_to_rest(*shown.window));
    const QImage picture = shown.scene_view->picture(1);
    const Compared all = compare(*shown.scene_view, colors, picture);
    QVERIFY2(all.pixels > 500 && all.negative > 0, qPrintable(text_of(all)));
    QVERIFY2(all.largest <= most_difference, qPrintable(text_of(all)));
    QVERIFY(spread_within_a_patch(*shown.scene_view, picture) > 30);
    save_picture(*shown.window, QStringLiteral("linear-%1").arg(QTest::currentDataTag()));
    if (mode != 0 && !logarithmic) {
      QVERIFY(colors.scale().below);
    }
  }

  // With edges, VTK adds a geometry shader; a clipping plane and larger pictures have other code.
  void outlines_clipping_and_larger_pictures_change_no_color() {
    const LinearWindow shown;
    QVERIFY(shown.ready);
    SceneView& view = *shown.scene_view;
    view.set_direction_shown(false);
    view.set_outlines_shown(true);
    QVERIFY(comes_to_rest(*shown.window));
    const Compared outlined = compare(view, shown.window->colors, view.picture(1));
    // A patch that is not convex has edges within.
    QVERIFY2(outlined.pixels > 500 && 100 * outlined.others < outlined.pixels,
             qPrintable(text_of(outlined)));
    view.set_outlines_shown(false);
    view.set_clip(ClipPlane{.axis = ClipPlane::Axis::z, .place = 0.4});
    QVERIFY(comes_to_rest(*shown.window));
    const Compared clipped = compare(view, shown.window->colors, view.picture(1));
    QVERIFY2(clipped.pixels > 200 && clipped.largest <= most_difference,
             qPrintable(text_of(clipped)));
    view.set_clip({});
    const Compared large = compare(view, shown.window->colors, view.picture(2), 2);
    QVERIFY2(large.pixels > 500 && large.largest <= most_difference, qPrintable(text_of(large)));
    view.set_wireframe(true);
    QVERIFY(color_count(view.picture(1)) > 5);
  }

  void hidden_patches_are_left_out_and_later_ones_dimmed() {
    const LinearWindow shown;
    QVERIFY(shown.ready);
    SceneView& view = *shown.scene_view;
    view.set_direction_shown(false);
    const QPoint middle = view.canvas()->rect().center();
    const PatchId patch = view.patch_at(middle);
    QVERIFY(patch != no_patch);
    shown.window->selection.select(patch);
    shown.trigger("hide_selection");
    QVERIFY(view.patch_at(middle) != patch);
    shown.window->selection.select(no_patch);
    const Compared rest = compare(view, shown.window->colors, view.picture(1));
    QVERIFY2(rest.pixels > 300 && rest.largest <= most_difference, qPrintable(text_of(rest)));
    shown.trigger("show_all");

    shown.trigger("layout_debug");
    Focus& focus = shown.window->focus;
    focus.go_to({0, 0, 12});
    QVERIFY(wait_for([&] { return focus.map() && focus.arrived(); }));
    QVERIFY(comes_to_rest(*shown.window));
    const std::vector<bool> dimmed = later_patches(*focus.map(), focus.position().step);
    const auto later = std::count(dimmed.begin(), dimmed.end(), true);
    QVERIFY(later > 5 && later < shown.window->snapshot()->loaded->scene->patch_count());
    const Compared dim = compare(view, shown.window->colors, view.picture(1), 1, dimmed);
    QVERIFY2(dim.pixels > 500 && dim.largest <= most_difference, qPrintable(text_of(dim)));
  }

  void a_linear_result_is_shown_as_it_was_solved() {
    QTemporaryDir folder;
    const QString path = folder.filePath("linear.vtp");
    const Solution solution = solve(load_scene("cornell-box"), linear_options);
    QVERIFY(solution.statistics.negative_corners > 0);
    QVERIFY(solution.statistics.closure_defect_moments > 0);
    write_result(path.toStdString(), solution);
    const auto window = make_window();
    window->files().open(path);
    QVERIFY(wait_for([&] { return window->settled(); }));
    const auto snapshot = window->snapshot();
    QVERIFY(snapshot->of_file && snapshot->linear_terms.size() == solution.linear_terms.size());
    QCOMPARE(snapshot->statistics.negative_corners, solution.statistics.negative_corners);
    QCOMPARE(snapshot->statistics.closure_defect_moments,
             solution.statistics.closure_defect_moments);
    QVERIFY(window->colors.linear());
    auto* view = window->findChild<SceneView*>();
    view->set_outlines_shown(false);
    QVERIFY(comes_to_rest(*window));
    const Compared all = compare(*view, window->colors, view->picture(1));
    QVERIFY2(all.pixels > 500 && all.largest <= most_difference, qPrintable(text_of(all)));

    // The result is the same after it is written again.
    const QString again = folder.filePath("again.vtp");
    window->findChild<ExportActions*>()->write_result(again);
    QVERIFY(wait_for([&] { return !window->findChild<ExportActions*>()->writing(); }));
    const Solution back = read_result(again.toStdString());
    for (std::size_t i = 0; i < back.linear_terms.size(); ++i) {
      QVERIFY(back.linear_terms[i].first == solution.linear_terms[i].first);
      QVERIFY(back.linear_terms[i].second == solution.linear_terms[i].second);
    }
    QCOMPARE(back.statistics.negative_corners, solution.statistics.negative_corners);
  }

  void smooth_shading_is_for_constant_functions() {
    const LinearWindow shown;
    QVERIFY(shown.ready);
    auto* smooth = shown.part<QAction>("show_smooth");
    QVERIFY(!smooth->isEnabled() && smooth->toolTip().contains("linear"));
    // Form factors and H of the same solve are constant on patches.
    shown.window->colors.set_quantity(Quantity::irradiance);
    QVERIFY(smooth->isEnabled() && !shown.window->colors.linear());
    shown.scene_view->set_direction_shown(false);
    const QImage flat = shown.scene_view->picture(1);
    save_picture(*shown.window, "linear-irradiance");
    QVERIFY2(spread_within_a_patch(*shown.scene_view, flat) < 3,
             qPrintable(QString::number(spread_within_a_patch(*shown.scene_view, flat))));
    smooth->trigger();
    QVERIFY(comes_to_rest(*shown.window));
    const int smoothed = spread_within_a_patch(*shown.scene_view, shown.scene_view->picture(1));
    QVERIFY2(smoothed > 10, qPrintable(QString::number(smoothed)));
    // For linear functions, the picture is again the same as without smooth shading.
    shown.window->colors.set_quantity(Quantity::radiosity);
    const Compared all =
        compare(*shown.scene_view, shown.window->colors, shown.scene_view->picture(1));
    QVERIFY2(all.largest <= most_difference, qPrintable(text_of(all)));
  }

  void the_pointer_tells_B_at_the_point_data() {
    QTest::addColumn<bool>("over_map");
    QTest::newRow("scene") << false;
    QTest::newRow("map") << true;
  }

  void the_pointer_tells_B_at_the_point() {
    QFETCH(const bool, over_map);
    const LinearWindow shown;
    QVERIFY(shown.ready);
    MapCanvas& map = *shown.map_view->canvas();
    QVERIFY(wait_for([&] { return map.up_to_date(); }));
    QWidget& canvas = over_map ? map : *shown.scene_view->canvas();
    const auto pointed_at = [&](const QPoint& p) -> PointedPatch {
      if (over_map) {
        return {map.patch_at(p), map.patch_point_at(p)};
      }
      const auto hit = shown.scene_view->hit_at(p);
      return hit ? PointedPatch{hit->patch, hit->point} : PointedPatch{};
    };
    QPoint place = canvas.rect().center();
    while (place.x() > 0 && pointed_at(place).patch == no_patch) {
      place.rx() -= 3;
    }
    const PointedPatch pointed = pointed_at(place);
    QVERIFY(pointed.patch != no_patch && pointed.point);
    const auto snapshot = shown.window->snapshot();
    const Patch& patch = snapshot->loaded->scene->patch(pointed.patch);
    QVERIFY(std::abs(dot(patch.normal, *pointed.point - patch.center)) < 1e-4);
    QTest::mouseMove(&canvas, place + QPoint(1, 0));
    QTest::mouseMove(&canvas, place);
    const auto* label = canvas.findChild<PointerLabel*>();
    QTRY_VERIFY(label->isVisible());
    const QStringList lines = label->text().split('\n');
    QCOMPARE(lines.size(), 4);
    QCOMPARE(lines[1], QString("x  %1 m").arg(vector_text(*pointed.point)));
    QCOMPARE(lines[2], QString("B at x  %1 W/m²")
                           .arg(rgb_text(radiosity_at(*snapshot, pointed.patch, *pointed.point))));
    QCOMPARE(
        lines[3],
        QString("mean B  %1 W/m²").arg(rgb_text(snapshot->radiosity[std::size_t(pointed.patch)])));
    save_picture(*shown.window, QStringLiteral("linear-pointer-%1").arg(QTest::currentDataTag()));
  }

  void the_inspector_has_the_coefficients() {
    const LinearWindow shown;
    QVERIFY(shown.ready);
    shown.window->selection.select(4);
    const auto snapshot = shown.window->snapshot();
    QVERIFY(!shown.part<QLabel>("coefficient_0")->isHidden());
    QCOMPARE(shown.text("coefficient_0"), rgb_text(snapshot->radiosity[4]));
    QCOMPARE(shown.text("coefficient_1"), rgb_text(snapshot->linear_terms[4].first));
    QCOMPARE(shown.text("coefficient_2"), rgb_text(snapshot->linear_terms[4].second));
    const Solution solution = solution_of(*snapshot);
    Rgb highest{-1e9, -1e9, -1e9};
    for (const Rgb& b : corner_radiosity(solution, 4)) {
      highest = {std::max(highest.r, b.r), std::max(highest.g, b.g), std::max(highest.b, b.b)};
    }
    QCOMPARE(shown.text("corner_highest"), rgb_text(highest));
    QVERIFY(shown.text("summary_negative") ==
            count_text(shown.window->snapshot()->statistics.negative_corners));
    save_picture(*shown.window, "linear-inspector");
  }

  void the_settings_solve_with_linear_functions() {
    const SolvedWindow shown("cornell-box");
    QVERIFY(shown.ready && !shown.window->colors.linear());
    auto* basis = shown.window->findChild<QComboBox*>("basis");
    auto* note = shown.window->findChild<QLabel*>("basis_note");
    basis->setCurrentIndex(1);
    QVERIFY(note->isHidden());
    QVERIFY(shown.window->views().settings.solve_options().basis == Basis::linear);
    auto* engine = shown.window->findChild<QComboBox*>("engine");
    const int usual = engine->currentIndex();
    engine->setCurrentIndex(engine->findText("Z-buffer"));
    QVERIFY(note->text().contains("engine zbuffer does not have"));
    QVERIFY(!note->isHidden());
    engine->setCurrentIndex(usual);
    QVERIFY(note->isHidden());
    shown.window->findChild<QPushButton*>("restart")->click();
    QVERIFY(wait_for([&] {
      return shown.window->runner.state() == RunState::finished && shown.window->settled();
    }));
    QVERIFY(shown.window->snapshot()->options.basis == Basis::linear);
    QVERIFY(shown.window->colors.linear());
  }

  void a_session_keeps_the_basis_and_the_shading() {
    QTemporaryDir folder;
    const QString session = folder.filePath("s.json");
    Rgb slope;
    {
      const LinearWindow shown;
      QVERIFY(shown.ready);
      slope = shown.window->snapshot()->linear_terms[4].first;
      shown.window->files().save_session(session);
    }
    const auto window = make_window();
    window->files().open(session);
    QVERIFY(wait_for([&] { return window->settled() && window->snapshot(); }));
    QVERIFY(wait_for([&] { return window->runner.state() == RunState::finished; }));
    QVERIFY(wait_for([&] { return window->settled(); }));
    QVERIFY(window->colors.linear());
    QVERIFY(window->snapshot()->linear_terms[4].first == slope);
  }

  void changed_light_is_linear_on_patches() {
    const LinearWindow shown;
    QVERIFY(shown.ready);
    shown.window->selection.select(4);
    const std::vector<LinearTerm> before = shown.window->snapshot()->linear_terms;
    MaterialEdits& edits = shown.window->relighting.edits();
    edits.set_exitance("face:4", {1, 1, 1});
    QVERIFY(wait_for([&] { return shown.window->snapshot()->materials != nullptr; }));
    const auto changed = shown.window->snapshot();
    QVERIFY(changed->linear_terms.size() == before.size() && shown.window->colors.linear());
    // A wall near the changed lamp is brighter there.
    QVERIFY(max_abs(changed->linear_terms[3].first - before[3].first) > 1e-4);
    QVERIFY(shown.part<QLabel>("material_account")->isHidden());
    shown.window->undo.undo();
    QVERIFY(wait_for(
        [&] { return shown.window->snapshot()->linear_terms[3].first == before[3].first; }));
  }

  void a_kept_constant_run_is_compared_as_a_function() {
    const SolvedWindow shown("cornell-box");
    QVERIFY(shown.ready);
    shown.trigger("keep_run");
    const std::vector<Rgb> constant = shown.window->snapshot()->radiosity;
    shown.window->findChild<QComboBox*>("basis")->setCurrentIndex(1);
    shown.window->findChild<QPushButton*>("restart")->click();
    QVERIFY(wait_for([&] {
      return shown.window->runner.state() == RunState::finished && shown.window->settled();
    }));
    ColorChoice& colors = shown.window->colors;
    colors.set_quantity(Quantity::difference);
    QVERIFY(colors.linear());
    const auto snapshot = shown.window->snapshot();
    // The values are in percent of the level of the surface.
    double percent[2] = {};
    for (const std::size_t k : {0, 1}) {
      const Vec3 corner = snapshot->loaded->scene->point(snapshot->loaded->scene->outline(3)[k]);
      const Rgb difference = radiosity_at(*snapshot, 3, corner) - constant[3];
      percent[k] = colors.value_at(3, corner).g / difference.g;
    }
    QVERIFY(percent[0] > 0 && std::abs(percent[1] / percent[0] - 1) <= 1e-9);
    shown.scene_view->set_direction_shown(false);
    shown.scene_view->set_outlines_shown(false);
    QVERIFY(comes_to_rest(*shown.window));
    // Colors of edges between patches of about the same color cover some pixels.
    const Compared all = compare(*shown.scene_view, colors, shown.scene_view->picture(1));
    QVERIFY2(all.pixels > 500 && all.largest <= most_difference, qPrintable(text_of(all)));
    save_picture(*shown.window, "linear-difference");
  }
};

const test::Registered registered("linear", test::run_as_viewer<LinearTest>);

}  // namespace transillum::viewer::linear_test

#include "linear_test.moc"
