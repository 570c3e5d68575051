// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <QDir>
#include <QFile>
#include <QImage>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>

#include "registered.h"
#include "test_files.h"

namespace transillum::viewer::screenshot_test {

class ScreenshotTest : public QObject {
  Q_OBJECT

  struct Outcome {
    int status = -1;
    QByteArray error;
  };
  /// @param setting  of one environment variable, as NAME=VALUE
  static Outcome run(const QStringList& arguments, const QString& setting = {}) {
    QProcess process;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    if (!setting.isEmpty()) {
      environment.insert(setting.section('=', 0, 0), setting.section('=', 1));
    }
    process.setProcessEnvironment(environment);
    process.start(TRANSILLUM_VIEWER, arguments);
    Outcome outcome;
    if (!process.waitForFinished(90000) || process.exitStatus() != QProcess::NormalExit) {
      return outcome;
    }
    outcome.status = process.exitCode();
    // Qt reports a missing run-time folder; that line is not the program's.
    for (const QByteArray& line : process.readAllStandardError().split('\n')) {
      if (!line.isEmpty() && !line.contains("XDG_RUNTIME_DIR")) {
        outcome.error += line + '\n';
      }
    }
    return outcome;
  }

 private slots:
  void writes_the_whole_window() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("window.png");
    const Outcome outcome = run({"cornell-box", "-m", "32", "--screenshot", path, "--after", "5"});
    QCOMPARE(outcome.status, 0);
    QCOMPARE(outcome.error, QByteArray());
    const QImage picture(path);
    QCOMPARE(picture.size(), QSize(1600, 1000));
    QSet<QRgb> colors;
    for (int y = 0; y < picture.height(); y += 4) {
      for (int x = 0; x < picture.width(); x += 4) {
        colors.insert(picture.pixel(x, y));
      }
    }
    QVERIFY(colors.size() > 60);
    // No temporary file remains.
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files), QStringList{"window.png"});
  }

  // The ceiling of the Cornell box and the sides of its blocks that the lamp does not reach are
  // black in the first iteration.
  void without_after_it_shows_a_converged_solve() {
    const QTemporaryDir folder;
    const QString path = folder.filePath("window.png");
    QCOMPARE(run({"cornell-box", "--screenshot", path}).status, 0);
    const QImage picture(path);
    int black = 0;
    const QRect scene(420, 130, 610, 670);
    for (int y = scene.top(); y <= scene.bottom(); ++y) {
      for (int x = scene.left(); x <= scene.right(); ++x) {
        black += qGray(picture.pixel(x, y)) < 4 ? 1 : 0;
      }
    }
    const double fraction = static_cast<double>(black) / (scene.width() * scene.height());
    QVERIFY2(fraction < 0.01, qPrintable(QString::number(fraction)));
  }

  void exports_a_lesson() {
    const QTemporaryDir folder;
    const QString lesson =
        test::write_file(folder.filePath("mine.json"), R"({"title": "T", "pages": [
      {"title": "One", "text": "a", "show": {"scene": "furnace", "focus": {"direction": 1}}},
      {"title": "Two", "text": "b"}]})");
    const auto export_to = [&](const QString& path) {
      return run({"--lesson", lesson, "--export-lesson", path});
    };
    const QString path = folder.filePath("lesson.html");
    const Outcome outcome = export_to(path);
    QCOMPARE(outcome.error, QByteArray());
    QCOMPARE(outcome.status, 0);
    QCOMPARE(test::contents_of(path).count("<section>"), 2);
    // A folder has the name of the file.
    QVERIFY(QDir(folder.path()).mkdir("b.html"));
    const Outcome refused = export_to(folder.filePath("b.html"));
    QCOMPARE(refused.status, 1);
    QCOMPARE(refused.error.count('\n'), 1);
    QVERIFY2(refused.error.contains("b.html"), refused.error.constData());
  }

  void bad_input_gives_one_line_and_no_file() {
    const QTemporaryDir folder;
    const Outcome outcome = run({"no-such-scene", "--screenshot", folder.filePath("window.png")});
    QCOMPARE(outcome.status, 2);
    QCOMPARE(outcome.error.count('\n'), 1);
    QVERIFY2(outcome.error.contains("no-such-scene"), outcome.error.constData());
    QVERIFY(QDir(folder.path()).entryList(QDir::Files).isEmpty());
  }

  void without_a_screen_it_says_so_data() {
    QTest::addColumn<QString>("setting");
    QTest::addColumn<QByteArray>("expected");
    QTest::newRow("display") << "DISPLAY=:9999" << QByteArray("no display: cannot open \":9999\"");
    QTest::newRow("platform") << "QT_QPA_PLATFORM=nonsense"
                              << QByteArray("no display: cannot open \"nonsense\"");
    for (const char* setting :
         {"QT_XCB_GL_INTEGRATION=none", "QT_XCB_GL_INTEGRATION=xcb_egl", "LIBGL_ALWAYS_INDIRECT=1",
          "MESA_GL_VERSION_OVERRIDE=1.4", "QT_QPA_PLATFORM=minimal"}) {
      QTest::newRow(setting) << setting << QByteArray("no OpenGL 3.2");
    }
  }
  void without_a_screen_it_says_so() {
    QFETCH(const QString, setting);
    QFETCH(const QByteArray, expected);
    const QTemporaryDir folder;
    const Outcome outcome =
        run({"furnace", "--screenshot", folder.filePath("window.png")}, setting);
    QCOMPARE(outcome.status, 1);
    QCOMPARE(outcome.error.count('\n'), 1);
    QVERIFY2(outcome.error.contains(expected), outcome.error.constData());
    QVERIFY(QDir(folder.path()).entryList(QDir::Files).isEmpty());
  }

  void wrong_arguments_exit_with_status_2() {
    const Outcome outcome = run({"--color", "red"});
    QCOMPARE(outcome.status, 2);
    QCOMPARE(outcome.error.count('\n'), 1);
  }
};

const test::Registered registered("screenshot", test::run_without_widgets<ScreenshotTest>);

}  // namespace transillum::viewer::screenshot_test

#include "screenshot_test.moc"
