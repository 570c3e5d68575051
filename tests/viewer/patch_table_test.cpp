// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// PatchTable and its columns: contents, sorting, searching and CSV, on a solved Cornell box.
#include "patches/patch_table.h"

#include <QElapsedTimer>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "colors/color_scale.h"
#include "patches/table_rows.h"
#include "registered.h"
#include "solved_snapshot.h"
#include "transillum/at.h"

namespace transillum::viewer::patch_table_test {

using namespace test;

namespace {

/// A table with contents, and its columns by CSV name.
struct Filled {
  PatchTable table;
  std::vector<PatchColumn> columns;

  explicit Filled(const PatchRows& rows) : columns(rows.columns) {
    table.set_contents(rows.patches, rows.columns);
  }
  int column(const char* csv_name) const {
    const auto found = std::find_if(columns.begin(), columns.end(),
                                    [&](const auto& c) { return c.csv_name == csv_name; });
    return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
  }
  std::vector<PatchId> patches() const {
    std::vector<PatchId> patches;
    for (int row = 0; row < table.rowCount(); ++row) {
      patches.push_back(table.patch(row));
    }
    return patches;
  }
  std::vector<std::string> csv_lines() const {
    std::stringstream out;
    table.write_csv(out);
    std::vector<std::string> lines;
    for (std::string line; std::getline(out, line);) {
      lines.push_back(line);
    }
    return lines;
  }
};

PatchColumn numbers(const char* name, std::vector<Rgb> values) {
  return {QString::fromLatin1(name), {}, name, PatchColumn::Kind::number, std::move(values), {}};
}

}  // namespace

class PatchTableTest : public QObject {
  Q_OBJECT

  const std::shared_ptr<SolverSnapshot> box_ = solved_snapshot("cornell-box", 64, 2);

 private slots:
  void lists_every_patch_with_all_quantities() {
    const Filled all(rows_of_all(*box_));
    QCOMPARE(all.table.rowCount(), int(box_->loaded->scene->patch_count()));
    for (const char* name : {"patch", "material", "B", "E", "rho", "H", "area", "face", "F_sum",
                             "fragments", "SE", "change"}) {
      QVERIFY2(all.column(name) >= 0, name);
    }
    for (const PatchColumn& column : all.columns) {
      QVERIFY(!column.title.isEmpty() && !column.tip.isEmpty());
      QCOMPARE(column.values.size(), std::size_t(all.table.rowCount()));
    }
  }

  void sorts_ascending_and_descending_and_stably() {
    Filled all(rows_of_all(*box_));
    const int by = all.column("B");
    const auto key = [&](PatchId i) { return luminance(at(box_->radiosity, i)); };
    for (const Qt::SortOrder order : {Qt::AscendingOrder, Qt::DescendingOrder}) {
      all.table.sort(by, order);
      const auto patches = all.patches();
      QCOMPARE(std::set<PatchId>(patches.begin(), patches.end()).size(), patches.size());
      for (std::size_t k = 1; k < patches.size(); ++k) {
        const double before = key(patches[k - 1]), now = key(patches[k]);
        QVERIFY(order == Qt::AscendingOrder ? before <= now : before >= now);
        if (before == now) {
          QVERIFY(patches[k - 1] < patches[k]);
        }
      }
      for (const PatchId patch : {0, 5, 9}) {
        QCOMPARE(all.table.patch(all.table.row_of(patch)), patch);
      }
    }
  }

  void nan_sorts_last_in_descending_order() {
    PatchTable table;
    table.sort(0, Qt::DescendingOrder);
    table.set_contents({0, 1, 2, 3}, {numbers("x", {{2}, {NAN}, {3}, {1}})});
    QCOMPARE(table.patch(0), 2);
    QCOMPARE(table.patch(3), 1);
  }

  void searches_by_number_and_material() {
    Filled all(rows_of_all(*box_));
    all.table.set_search("1");
    QVERIFY(all.table.rowCount() > 1);
    for (const PatchId patch : all.patches()) {
      QVERIFY(QString::number(patch).startsWith('1'));
    }
    const Scene& scene = *box_->loaded->scene;
    const QString name = QString::fromStdString(scene.material(7).name);
    all.table.set_search(name.toUpper());
    QVERIFY(all.table.row_of(7) >= 0);
    for (const PatchId patch : all.patches()) {
      QVERIFY(QString::fromStdString(scene.material(patch).name).contains(name));
    }
    all.table.set_search("no such thing");
    QCOMPARE(all.table.rowCount(), 0);
    QCOMPARE(all.table.row_of(7), -1);
    all.table.set_search({});
    QCOMPARE(all.table.rowCount(), int(scene.patch_count()));
  }

  void new_values_keep_the_selection() {
    PatchTable table;
    table.sort(0, Qt::AscendingOrder);
    table.set_contents({0, 1, 2}, {numbers("x", {{1}, {2}, {3}})});
    const QPersistentModelIndex marked(table.index(0, 0));
    table.set_contents({0, 1, 2}, {numbers("x", {{9}, {2}, {3}})});
    QVERIFY(marked.isValid());
    QCOMPARE(table.patch(marked.row()), 0);
    QCOMPARE(marked.row(), 2);
  }

  void received_power_of_partners_sums_to_the_irradiance() {
    const PatchId i = 3;
    const auto& scene = *box_->loaded->scene;
    const PatchRows rows = rows_of_partners(*box_, i);
    const Filled partners(rows);
    QVERIFY(!rows.patches.empty());
    QCOMPARE(std::count(rows.patches.begin(), rows.patches.end(), i), 0);
    const auto values = [&](const char* name) {
      return at(partners.columns, partners.column(name)).values;
    };
    Rgb received;
    double fraction = 0, form_factors = 0;
    for (const Rgb& value : values("received")) {
      received += value;
    }
    for (const Rgb& value : values("share_percent")) {
      fraction += value.r;
    }
    for (const Rgb& value : values("F_ij")) {
      form_factors += value.r;
    }
    QVERIFY(std::abs(fraction - 100) < 1e-9);
    QVERIFY(std::abs(form_factors - box_->form_factor_sums[3]) < 1e-12);
    Rgb irradiance;
    for (std::size_t k = 0; k < rows.patches.size(); ++k) {
      irradiance += values("F_ij")[k].r * at(box_->radiosity, rows.patches[k]);
    }
    QVERIFY(max_abs((1 / scene.patch(i).area) * received - irradiance) < 1e-12);
    // The power that i sends to j is the power that j receives from i.
    const PatchId j = rows.patches.front();
    const Filled back(rows_of_partners(*box_, j));
    const int row = back.table.row_of(i);
    QVERIFY(row >= 0);
    const Rgb there = at(at(back.columns, back.column("received")).values, row);
    QVERIFY(max_abs(values("sent").front() - there) <= 1e-15 + 1e-12 * max_abs(there));
  }

  void csv_matches_the_table_bit_for_bit() {
    Filled all(rows_of_all(*box_));
    all.table.sort(all.column("area"), Qt::DescendingOrder);
    const auto lines = all.csv_lines();
    QCOMPARE(lines.size(), std::size_t(all.table.rowCount()) + 1);
    QVERIFY2(lines[0].rfind("patch,material,B_r,B_g,B_b,E_r", 0) == 0, lines[0].c_str());
    const QStringList first = QString::fromStdString(lines[1]).split(',');
    QCOMPARE(first[0].toInt(), int(all.table.patch(0)));
    QCOMPARE(first[2].toDouble(), at(box_->radiosity, all.table.patch(0)).r);
    all.table.set_search("no such thing");
    QCOMPARE(all.csv_lines().size(), std::size_t{1});
  }

  void csv_quotes_text_with_commas() {
    PatchTable table;
    PatchColumn material{"Material",    {}, "material", PatchColumn::Kind::text, {{0}},
                         {"a \"b\", c"}};
    table.set_contents({0}, {material});
    std::ostringstream out;
    table.write_csv(out);
    QCOMPARE(out.str(), std::string("material\n\"a \"\"b\"\", c\"\n"));
  }

  void sorts_twenty_thousand_rows_fast() {
    std::vector<PatchId> patches;
    std::vector<Rgb> values;
    for (int i = 0; i < 20000; ++i) {
      patches.push_back(i);
      values.push_back({std::sin(i), std::cos(i), 0});
    }
    PatchTable table;
    table.set_contents(patches, {numbers("x", values), numbers("y", values)});
    QElapsedTimer timer;
    timer.start();
    table.sort(1, Qt::DescendingOrder);
    table.set_search("1");
    table.set_search({});
    qInfo("sorted and searched twice in %lld ms", timer.elapsed());
    QVERIFY(timer.elapsed() < 1000);
  }
};

const test::Registered registered("patch_table", test::run_without_application<PatchTableTest>);

}  // namespace transillum::viewer::patch_table_test

#include "patch_table_test.moc"
