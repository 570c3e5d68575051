// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The viewer in a locale with a decimal comma: numbers are read and shown as in files.
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QProcess>
#include <QTemporaryDir>
#include <cstdlib>

#include "../support/comma_locale.h"
#include "lessons/session_file.h"
#include "solved_window.h"
#include "test_files.h"

namespace transillum::viewer::locale_test {

using namespace test;

class LocaleTest : public QObject {
  Q_OBJECT

 private slots:
  void widgets_and_files_have_a_decimal_point() {
    const transillum::test::CommaLocale locale;
    if (!locale.problem().empty()) {
      QSKIP(locale.problem().c_str());
    }
    QLocale::setDefault(QLocale(QLocale::German, QLocale::Germany));
    use_decimal_point();
    QCOMPARE(std::strtod("1.5", nullptr), 1.5);
    SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    TestWindow& window = *solved.window;
    window.colors.set_gamma(1.5);
    for (const QDoubleSpinBox* box : window.findChildren<QDoubleSpinBox*>()) {
      QVERIFY2(!box->text().contains(','), qPrintable(box->objectName() + ": " + box->text()));
    }
    auto& low = *window.findChild<QLineEdit*>("range_low");
    low.setText("0.25");
    QVERIFY(low.hasAcceptableInput());
    const QTemporaryDir folder;
    window.files().save_session(folder.filePath("s.json"));
    window.files().open(folder.filePath("s.json"));
    QVERIFY(wait_for([&] { return window.settled(); }));
    QCOMPARE(window.colors.scale().gamma, 1.5);
  }

  void the_program_reads_numbers_beyond_the_range() {
    const transillum::test::CommaLocale locale;
    if (!locale.problem().empty()) {
      QSKIP(locale.problem().c_str());
    }
    const QTemporaryDir folder;
    const QString file =
        write_file(folder.filePath("far.obj"), "v 0 0 0\nv 1.5e400 0 0\nv 0 1 0\nf 1 2 3\n");
    QProcess process;
    process.start(TRANSILLUM_VIEWER, {file, "--screenshot", folder.filePath("window.png")});
    QVERIFY(process.waitForFinished(60000));
    QCOMPARE(process.exitStatus(), QProcess::NormalExit);
    QCOMPARE(process.exitCode(), 2);
    QVERIFY(process.readAllStandardError().contains("`1.5e400` is not a finite coordinate"));
  }
};

const test::Registered registered("locale", test::run_as_viewer<LocaleTest>);

}  // namespace transillum::viewer::locale_test

#include "locale_test.moc"
