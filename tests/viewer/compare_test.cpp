// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <QComboBox>
#include <QDockWidget>
#include <QSpinBox>
#include <QTableWidget>

#include "compare_view.h"
#include "difference_picture.h"
#include "solved_window.h"

using namespace transillum;
using namespace transillum::viewer;
using namespace transillum::viewer::test;

class CompareTest : public QObject {
  Q_OBJECT

 private slots:
  void tells_how_two_engines_differ() {
    SolvedWindow shown(QStringLiteral("cornell-box"));
    QVERIFY(shown.ready);
    auto* view = shown.window->findChild<CompareView*>();
    auto* dock = shown.window->findChild<QDockWidget*>("compare_dock");
    dock->show();
    dock->raise();
    QVERIFY(wait_for([&] { return view->up_to_date(); }));
    const auto* table = view->findChild<QTableWidget*>("compare_table");
    const auto* picture = view->findChild<QWidget*>("difference_picture");
    QCOMPARE(table->horizontalHeaderItem(0)->text(), QStringLiteral("Fast"));
    QCOMPARE(table->horizontalHeaderItem(1)->text(), QStringLiteral("Z-buffer, 128 px"));
    const auto total = [&] {
      double sum = 0;
      for (PatchId i = 0; i < 27; ++i)
        sum += static_cast<const DifferencePicture*>(picture)->share(i);
      return sum;
    };
    const double coarse = total();
    QVERIFY(coarse > 0);

    // Finer pixels come nearer, and the same engine is the same.
    const QString before = shown.text("compare_words");
    view->findChild<QSpinBox*>("other_resolution")->setValue(1024);
    QVERIFY(wait_for([&] {
      return table->horizontalHeaderItem(1)->text() == QStringLiteral("Z-buffer, 1024 px");
    }));
    QVERIFY(shown.text("compare_words") != before);
    QVERIFY(total() < coarse);
    view->findChild<QComboBox*>("other_engine")->setCurrentText(QStringLiteral("Fast"));
    QVERIFY(wait_for([&] { return table->horizontalHeaderItem(1)->text() == "Fast"; }));
    QCOMPARE(total(), 0.0);
    QVERIFY(shown.text("compare_words").contains(QStringLiteral("0 %")));
  }

  void tells_why_there_is_nothing() {
    SolvedWindow shown(QStringLiteral("boards"));
    QVERIFY(shown.ready);
    auto* view = shown.window->findChild<CompareView*>();
    auto* dock = shown.window->findChild<QDockWidget*>("compare_dock");
    dock->show();
    dock->raise();
    QVERIFY(wait_for([&] { return view->up_to_date(); }));
    shown.window->open(QStringLiteral("furnace"));
    QVERIFY(wait_for([&] { return !view->up_to_date(); }));
  }
};

QTEST_MAIN(CompareTest)
#include "compare_test.moc"
