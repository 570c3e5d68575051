// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "support/number_text.h"

#include <QTest>
#include <cmath>

#include "registered.h"

namespace transillum::viewer::column_format_test {

class ColumnFormatTest : public QObject {
  Q_OBJECT

 private slots:
  void numbers_of_a_column_share_their_power_of_ten_data() {
    QTest::addColumn<double>("largest");
    QTest::addColumn<double>("value");
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("header");
    QTest::newRow("hundreds") << 412.34 << 12.0 << "12.00"
                              << "B, W/m²";
    QTest::newRow("share") << 0.2 << 0.0123456 << "0.01235"
                           << "B, W/m²";
    QTest::newRow("small") << 8.594e-5 << 8.594e-5 << "85.940"
                           << "B, 10⁻⁶ W/m²";
    QTest::newRow("with smaller") << 8.594e-5 << 1.2e-6 << "1.200"
                                  << "B, 10⁻⁶ W/m²";
    QTest::newRow("rounding") << 0.05 << 1e-21 << "≈ 0"
                              << "B, W/m²";
    QTest::newRow("negative") << 5.0 << -1.5 << "−1.5000"
                              << "B, W/m²";
    QTest::newRow("large") << 1.5e7 << 2.5e6 << "2.500"
                           << "B, 10⁶ W/m²";
    QTest::newRow("zero") << 0.0 << 0.0 << "0"
                          << "B, W/m²";
    QTest::newRow("unknown") << 1.0 << std::nan("") << "–"
                             << "B, W/m²";
  }
  void numbers_of_a_column_share_their_power_of_ten() {
    QFETCH(double, largest);
    QFETCH(double, value);
    const ColumnFormat format(largest);
    QTEST(format.text(value), "text");
    QTEST(format.header("B, W/m²"), "header");
  }

  void a_title_without_a_unit_gets_the_power() {
    QCOMPARE(ColumnFormat(2e-9).header("F i→j"), QString("F i→j, 10⁻⁹"));
  }
};

const test::Registered registered("column_format", test::run_without_application<ColumnFormatTest>);

}  // namespace transillum::viewer::column_format_test

#include "column_format_test.moc"
