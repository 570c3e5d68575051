// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The panel of light paths: listed with their fractions, drawn over the scene, written to files.
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QSpinBox>
#include <QTableWidget>
#include <QTemporaryDir>
#include <cmath>
#include <set>

#include "inspected_window.h"
#include "model/light_balance.h"
#include "model/requests/slow_quantities.h"
#include "patches/path_panel.h"
#include "test_files.h"
#include "transillum/relight.h"

namespace transillum::viewer::light_paths_test {

using namespace test;

namespace {

/// The panel of light paths, with the paths to patch 4.
struct ListedPaths : Inspected {
  PathPanel* panel;
  QTableWidget* table;

  ListedPaths()
      : Inspected("cornell-box"),
        panel(part<PathPanel>("path_panel")),
        table(part<QTableWidget>("path_table")) {
    trigger("show_direction");
    ready = ready && raise("paths_dock");
    window->selection.select(4);
    ready = ready && wait_for([this] { return table->rowCount() == 20; });
  }
  LightPaths expected() const {
    const auto snapshot = window->snapshot();
    const Scene& scene = *snapshot->loaded->scene;
    return find_light_paths(scene, *snapshot->form_factors, 4, scene.materials(), {.count = 20});
  }
};

/// The number of pixels that are close to `color`.
int count_of(const QImage& picture, const QColor& color) {
  return static_cast<int>(
      std::lround(fraction_of(picture, color) * picture.width() * picture.height()));
}

}  // namespace

class LightPathsTest : public QObject {
  Q_OBJECT

 private slots:
  void light_paths_wait_for_a_patch() {
    const Inspected shown("cornell-box");
    QVERIFY(shown.ready && shown.raise("paths_dock"));
    QCOMPARE(shown.part<QTableWidget>("path_table")->rowCount(), 0);
    QVERIFY(shown.text("path_caption").contains("Select a patch"));
  }

  void paths_are_not_cut_on_a_small_screen() {
    const ListedPaths shown;
    QVERIFY(shown.ready);
    shown.window->resize(1280, 720);
    constexpr int margin = 6;  // a cell's, left and right together
    const auto fits = [&](int row) {
      const QRect cell = shown.table->visualItemRect(shown.table->item(row, 3));
      const QRect text = shown.table->fontMetrics().boundingRect(
          QRect(0, 0, cell.width() - margin, 10'000), Qt::TextWordWrap,
          shown.table->item(row, 3)->text());
      return text.height() <= cell.height() && text.width() <= cell.width() - margin;
    };
    for (int themes = 0; themes < 3; ++themes) {
      if (themes > 0) {
        shown.trigger("dark");
      }
      QVERIFY(comes_to_rest(*shown.window));
      for (int row = 0; row < shown.table->rowCount(); ++row) {
        QTRY_VERIFY2(fits(row), qPrintable(shown.table->item(row, 3)->text()));
      }
    }
    save_picture(*shown.window, "light-paths-small");
  }

  void light_paths_are_listed_with_their_fractions() {
    const ListedPaths shown;
    QVERIFY(shown.ready);
    const LightPaths expected = shown.expected();
    double listed = 0;
    for (int row = 0; row < 20; ++row) {
      const LightPath& path = expected.paths[std::size_t(row)];
      QVERIFY(shown.panel->paths()->paths[std::size_t(row)].patches == path.patches);
      QCOMPARE(shown.table->item(row, 2)->text().toInt(), int(path.patches.size()) - 1);
      QVERIFY(shown.table->item(row, 3)->text().endsWith("→ 4"));
      listed += shown.table->item(row, 0)->text().toDouble();
      // Equal decimals in a column, so that the fractions can be compared at a glance.
      for (const int column : {0, 1}) {
        const QString text = shown.table->item(row, column)->text();
        const auto decimals = [](const QString& number) { return number.section('.', 1).size(); };
        QVERIFY2(text == "≈ 0" || decimals(text) == decimals(shown.table->item(0, column)->text()),
                 qPrintable(text));
      }
    }
    const double rest = 100 * luminance(expected.cut_off) / luminance(expected.radiosity);
    QVERIFY(std::abs(listed + rest - 100) < 0.05);  // digits shown
    QVERIFY(shown.text("path_caption").contains(QString::number(rest, 'f', 1) + " %"));
  }

  // The sums by group, and the rest, are all of B again; no two sums go through the same groups.
  void light_paths_are_summed_by_group() {
    const Inspected lit("cornell-box");
    QVERIFY(lit.ready && lit.raise("paths_dock"));
    const auto* panel = lit.part<PathPanel>("path_panel");
    const Scene& scene = *lit.window->snapshot()->loaded->scene;
    lit.window->selection.select(16);
    lit.part<QCheckBox>("paths_by_group")->setChecked(true);
    QVERIFY(wait_for([&] { return panel->paths() && !panel->busy(); }));
    const LightPaths& sums = *panel->paths();
    QVERIFY(!sums.paths.empty() && sums.paths.size() <= 20);
    Rgb all = sums.cut_off;
    std::set<std::vector<std::pair<int, int>>> keys;
    for (const LightPath& path : sums.paths) {
      all += path.contribution;
      std::vector<std::pair<int, int>> key;
      for (const PatchId patch : path.patches) {
        key.push_back(source_of(scene.patch(patch)));
      }
      QVERIFY(keys.insert(key).second);
    }
    QVERIFY(max_abs(all - sums.radiosity) < 1e-9 * max_abs(sums.radiosity));
    QCOMPARE(lit.part<QTableWidget>("path_table")->rowCount(), int(sums.paths.size()));
  }

  void light_paths_are_drawn_and_the_one_of_the_row_emphasized() {
    const ListedPaths shown;
    QVERIFY(shown.ready);
    const QImage many = shown.picture();
    shown.table->setFocus();
    QTest::keyClick(shown.table, Qt::Key_Down);
    QTest::keyClick(shown.table, Qt::Key_Down);
    const QImage emphasized = shown.picture();
    save_picture(*shown.window, "light-paths");
    shown.part<QSpinBox>("path_count")->setValue(3);
    QTRY_COMPARE(shown.table->rowCount(), 3);
    const QImage few = shown.picture();
    shown.scene_view->show_paths(nullptr, -1);
    const QImage none = shown.picture();
    // A line has more pixels than this number, and the scene is hundreds of pixels wide.
    const int yellow = count_of(emphasized, theme::processed);
    QVERIFY2(yellow > 50 && count_of(many, theme::processed) == 0,
             qPrintable(QString::number(yellow)));
    const int of_many = different_pixels(many, none), of_few = different_pixels(few, none);
    QVERIFY2(of_many > of_few && of_few > 50,
             qPrintable(QString("%1, %2").arg(of_many).arg(of_few)));
  }

  void light_paths_are_written() {
    const ListedPaths shown;
    QVERIFY(shown.ready);
    shown.part<QSpinBox>("path_count")->setValue(3);
    QTRY_COMPARE(shown.table->rowCount(), 3);
    const QTemporaryDir folder;
    shown.panel->write(folder.filePath("paths.csv"));
    const QList<QByteArray> lines = contents_of(folder.filePath("paths.csv")).trimmed().split('\n');
    QCOMPARE(lines.size(), 5);
    double fractions = 0;
    for (int line = 1; line < 5; ++line) {
      fractions += lines[line].split(',')[1].toDouble();
    }
    // B is solved to 1e-9 of the largest B, which a lamp has.
    double largest = 0;
    for (const Rgb& b : shown.window->snapshot()->radiosity) {
      largest = std::max(largest, luminance(b));
    }
    QVERIFY(std::abs(fractions - 1) < 1e-8 * largest / luminance(shown.expected().radiosity));
    shown.panel->write(folder.filePath("paths.json"));
    const QJsonObject root =
        QJsonDocument::fromJson(contents_of(folder.filePath("paths.json"))).object();
    QCOMPARE(root["receiver"].toInt(), 4);
    QCOMPARE(root["paths"].toArray().size(), 3);
    QCOMPARE(root["paths"].toArray()[0].toObject()["patches"].toArray().last().toInt(), 4);
    QVERIFY_EXCEPTION_THROWN(shown.panel->write(folder.filePath("no/such/folder.csv")),
                             std::runtime_error);
  }

  void sun_and_sky_are_sources_of_their_own() {
    SolveOptions options{.directions = 32, .first_shot = {}, .tolerance = 1e-10};
    options.sky.exitance = {1, 1, 1};
    options.sky.sun = {{1000, 900, 800}, normalized(Vec3{0.3, 0.2, -0.9})};
    const Inspected shown("cornell-box:open=1", options);
    QVERIFY(shown.ready && shown.raise("paths_dock"));
    shown.window->selection.select(4);
    auto* table = shown.part<QTableWidget>("path_table");
    QVERIFY(wait_for([&] { return table->rowCount() == 20; }));
    QStringList paths;
    for (int row = 0; row < table->rowCount(); ++row) {
      paths << table->item(row, 3)->text();
    }
    QVERIFY2(!paths.filter("sun → ").isEmpty(), qPrintable(paths.join('\n')));
    const QTemporaryDir folder;
    shown.part<PathPanel>("path_panel")->write(folder.filePath("paths.csv"));
    const QByteArray csv = contents_of(folder.filePath("paths.csv"));
    QVERIFY(csv.contains(",source\n") && csv.contains(",sun\n"));

    // All sources together make B.
    ColorChoice& colors = shown.window->colors;
    auto* quantity = shown.part<QComboBox>("quantity");
    quantity->setCurrentIndex(quantity->findText("What lights the selection"));
    QTRY_VERIFY(!colors.values().empty() && !colors.busy());
    const QString note = shown.text("color_note");
    QVERIFY2(note.contains("% from the sun, ") && note.contains("% from the sky"),
             qPrintable(note));
    const auto snapshot = shown.window->snapshot();
    const PatchResponse response = solve_response(*light_request(*snapshot, 4), {});
    Rgb sum = response.from_sun + response.from_sky;
    for (const Rgb& part : colors.values()) {
      sum += part;
    }
    const Rgb b = relight(*snapshot->loaded->scene, *snapshot->form_factors,
                          snapshot->loaded->scene->materials(),
                          {.tolerance = 1e-12, .sky_irradiance = snapshot->sky_irradiance})
                      .radiosity[4];
    QVERIFY(max_abs(sum - b) < 1e-8 * max_abs(b));
    QVERIFY(response.from_sun.r > 10 * response.from_sky.r && response.from_sky.r > 0);
    save_picture(*shown.window, "sun-as-a-source");
  }

  void a_hidden_panel_neither_draws_nor_searches_light_paths() {
    const ListedPaths shown;
    QVERIFY(shown.ready);
    shown.part<QDockWidget>("paths_dock")->hide();
    const QImage hidden = shown.picture();
    shown.scene_view->show_paths(nullptr, -1);
    QCOMPARE(shown.picture(), hidden);
    shown.window->selection.select(9);
    QVERIFY(!shown.panel->busy());
    QCOMPARE(shown.table->rowCount(), 0);
  }
};

const test::Registered registered("light_paths", test::run_as_viewer<LightPathsTest>);

}  // namespace transillum::viewer::light_paths_test

#include "light_paths_test.moc"
