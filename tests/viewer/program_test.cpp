// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The program transillum-viewer as a process: signals, damaged settings, sessions that a screenshot
// cannot show, too little memory. Its settings are in a temporary folder.
#include <QFile>
#include <QFileInfo>
#include <QProcess>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>
#include <csignal>

#include "registered.h"
#include "test_files.h"

namespace transillum::viewer::program_test {

namespace {

/// The program, started by a shell after `prefix`.
class Program {
 public:
  explicit Program(const QStringList& arguments, const QString& prefix = {}) {
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("XDG_CONFIG_HOME", folder_.path());
    environment.insert("XDG_CACHE_HOME", folder_.path());
    environment.insert("XDG_DATA_HOME", folder_.path());
    process_.setProcessEnvironment(environment);
    const QString script = prefix + R"(exec "$0" "$@")";
    arguments_ = QStringList{"-c", script, TRANSILLUM_VIEWER} + arguments;
  }
  ~Program() {
    process_.kill();
    process_.waitForFinished();
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void start() { process_.start("/bin/sh", arguments_); }
  /// Whether it runs, and a set of its signals in /proc, such as "SigCgt", contains `number`.
  bool has_signal(const QByteArray& set, int number) const {
    // Until then, the process is a copy of this one, with its handlers, and then the shell.
    const QFileInfo program(QString("/proc/%1/exe").arg(process_.processId()));
    if (program.canonicalFilePath() != QFileInfo(TRANSILLUM_VIEWER).canonicalFilePath()) {
      return false;
    }
    QFile status(QString("/proc/%1/status").arg(process_.processId()));
    if (!status.open(QIODevice::ReadOnly)) {
      return false;
    }
    for (const QByteArray& line : status.readAll().split('\n')) {
      if (line.startsWith(set + ':')) {
        const qulonglong mask = line.mid(set.size() + 1).trimmed().toULongLong(nullptr, 16);
        return (mask >> (number - 1) & 1) != 0;
      }
    }
    return false;
  }
  void send(int number) const { ::kill(static_cast<pid_t>(process_.processId()), number); }
  /// The exit status; -1 if it was killed by a signal or still runs.
  int status(int milliseconds = 60000) {
    if (!process_.waitForFinished(milliseconds) || process_.exitStatus() != QProcess::NormalExit) {
      return -1;
    }
    return process_.exitCode();
  }
  QByteArray errors() {
    QByteArray errors;
    // Qt reports a missing run-time folder; that line is not the program's.
    for (const QByteArray& line : process_.readAllStandardError().split('\n')) {
      if (!line.isEmpty() && !line.contains("XDG_RUNTIME_DIR")) {
        errors += line + '\n';
      }
    }
    return errors;
  }
  QString settings_path() const { return folder_.filePath("transillum/transillum-viewer.conf"); }
  QString file(const QString& name) const { return folder_.filePath(name); }

 private:
  QTemporaryDir folder_;
  QProcess process_;
  QStringList arguments_;
};

}  // namespace

class ProgramTest : public QObject {
  Q_OBJECT

 private slots:
  void a_signal_ends_it_as_closing_does_data() {
    QTest::addColumn<int>("number");
    QTest::newRow("SIGINT") << SIGINT;
    QTest::newRow("SIGTERM") << SIGTERM;
    QTest::newRow("SIGHUP") << SIGHUP;
  }
  void a_signal_ends_it_as_closing_does() {
    QFETCH(const int, number);
    Program program({"furnace", "-m", "100000"});
    program.start();
    // The last signal that the viewer catches; a library may catch the others earlier.
    QTRY_VERIFY_WITH_TIMEOUT(program.has_signal("SigCgt", SIGTERM), 30000);
    program.send(number);
    QCOMPARE(program.status(), 128 + number);
    QCOMPARE(program.errors(), QByteArray());
    const QSettings settings(program.settings_path(), QSettings::IniFormat);
    QVERIFY(settings.contains("window/state"));
    QVERIFY(settings.contains("window/geometry"));
  }

  void ignored_signals_stay_ignored() {
    Program program({"furnace", "-m", "100000"}, "trap '' HUP; ");
    program.start();
    QTRY_VERIFY_WITH_TIMEOUT(program.has_signal("SigCgt", SIGTERM), 30000);
    QVERIFY(program.has_signal("SigIgn", SIGHUP));
    program.send(SIGHUP);
    program.send(SIGTERM);
    QCOMPARE(program.status(), 128 + SIGTERM);
  }

  void a_screenshot_ends_by_a_signal_without_a_file() {
    Program program({"furnace", "-m", "1000000", "--screenshot", "a.png", "--after", "900000"});
    program.start();
    QTRY_VERIFY_WITH_TIMEOUT(program.has_signal("SigCgt", SIGTERM), 30000);
    program.send(SIGTERM);
    QCOMPARE(program.status(), 128 + SIGTERM);
  }

  void damaged_settings_do_not_prevent_a_start_data() {
    QTest::addColumn<QByteArray>("state");
    QTest::newRow("nothing of ours") << QByteArray("abc");
    // A state that Qt wrote, damaged so that Qt crashed.
    QTest::newRow("Qt's own") << QByteArray::fromBase64(
        "AAAA/wAAAAf9AAAAAwAAAAAAAAFeAAADA/wCAAAACPsAAAAWAGwAZQBzAHMAbwBuAF8AZABvAGMAawAAAAAA");
  }
  void damaged_settings_do_not_prevent_a_start() {
    QFETCH(const QByteArray, state);
    Program program({"furnace", "-m", "16"});
    {
      QSettings settings(program.settings_path(), QSettings::IniFormat);
      settings.setValue("window/state", state);
      settings.setValue("window/geometry", state);
      settings.setValue("window/layout", 2);
    }
    program.start();
    QTRY_VERIFY_WITH_TIMEOUT(program.has_signal("SigCgt", SIGTERM), 30000);
    program.send(SIGTERM);
    QCOMPARE(program.status(), 128 + SIGTERM);
    const QSettings settings(program.settings_path(), QSettings::IniFormat);
    QVERIFY(settings.value("window/state").toByteArray() != state);
  }

  void a_session_that_cannot_be_shown_ends_a_screenshot_data() {
    QTest::addColumn<QByteArray>("show");
    QTest::addColumn<QByteArray>("expected");
    QTest::newRow("iteration") << QByteArray(R"("scene": "furnace", "options": {"directions": 16},
                                                "solve": 3, "focus": {"iteration": 15})")
                               << QByteArray("focus: there is no iteration 15");
    QTest::newRow("direction") << QByteArray(R"("scene": "furnace", "options": {"directions": 16},
                                                "solve": 3, "focus": {"direction": 17})")
                               << QByteArray("focus: there is no direction 17");
    for (const QByteArray key : {"select", "hidden"}) {
      const QByteArray value = key == "hidden" ? "[3, 99]" : "99";
      QTest::newRow(key.constData())
          << QByteArray("\"scene\": \"furnace\", \"options\": {\"directions\": 16}, \"" + key +
                        "\": " + value)
          << QByteArray(key + ": there is no patch 99; the scene has 0 to 11");
    }
    QTest::newRow("no scene") << QByteArray() << QByteArray("scene: is missing");
  }
  void a_session_that_cannot_be_shown_ends_a_screenshot() {
    QFETCH(const QByteArray, show);
    QFETCH(const QByteArray, expected);
    const QTemporaryDir folder;
    const QString session = folder.filePath("s.json"), picture = folder.filePath("a.png");
    test::write_file(session, "{\"show\": {" + show + "}}");
    Program program({session, "--screenshot", picture});
    program.start();
    QCOMPARE(program.status(), 2);
    const QByteArray errors = program.errors();
    QCOMPARE(errors.count('\n'), 1);
    QVERIFY2(errors.contains(expected), errors.constData());
    QVERIFY(!QFile::exists(picture));
  }

  void a_lesson_that_names_no_patch_of_its_scene_ends_a_screenshot_data() {
    QTest::addColumn<QByteArray>("selection");
    QTest::addColumn<QByteArray>("callouts");
    QTest::newRow("select") << QByteArray(R"(, "select": 99)") << QByteArray("[]");
    QTest::newRow("callouts") << QByteArray() << QByteArray(R"([{"text": "a", "patch": 99}])");
  }
  void a_lesson_that_names_no_patch_of_its_scene_ends_a_screenshot() {
    QFETCH(const QByteArray, selection);
    QFETCH(const QByteArray, callouts);
    const QTemporaryDir folder;
    const QString lesson = folder.filePath("l.json"), picture = folder.filePath("a.png");
    test::write_file(lesson, R"({"title": "T", "pages": [{"text": "x", "callouts": )" + callouts +
                                 R"(, "show": {"scene": "furnace", "options": {"directions": 16})" +
                                 selection + "}}]}");
    Program program({"--lesson", lesson, "--screenshot", picture});
    program.start();
    QCOMPARE(program.status(), 2);
    const QByteArray errors = program.errors();
    const QByteArray key = QTest::currentDataTag();
    QVERIFY2(errors.contains(key + ": there is no patch 99; the scene has 0 to 11"),
             errors.constData());
    QVERIFY(!QFile::exists(picture));
  }

  void commands_of_readme_and_cookbook_show_something() {
    int count = 0;
    for (const char* name : {"/README.md", "/libtransillum/COOKBOOK.md"}) {
      QFile document(QStringLiteral(TRANSILLUM_SOURCE) + name);
      QVERIFY(document.open(QIODevice::ReadOnly));
      const QString start = "transillum-viewer ";
      for (const QString& line : QString::fromUtf8(document.readAll()).split('\n')) {
        if (!line.startsWith(start)) {
          continue;
        }
        const QTemporaryDir folder;
        const QString picture = folder.filePath("a.png");
        Program program(line.mid(start.size()).split(' ') + QStringList{"--screenshot", picture});
        program.start();
        QCOMPARE(program.status(120000), 0);
        QVERIFY2(QFile::exists(picture), qPrintable(line));
        ++count;
      }
    }
    QVERIFY(count > 0);
  }

  void too_many_patches_are_refused() {
    const QTemporaryDir folder;
    const QString picture = folder.filePath("a.png");
    Program program({"furnace", "--max-patch-area", "1e-9", "--screenshot", picture});
    program.start();
    QCOMPARE(program.status(), 2);
    const QByteArray errors = program.errors();
    QCOMPARE(errors.count('\n'), 1);
    QVERIFY2(errors.contains("patch"), errors.constData());
    QVERIFY(!QFile::exists(picture));
  }
};

const test::Registered registered("program", test::run_without_widgets<ProgramTest>);

}  // namespace transillum::viewer::program_test

#include "program_test.moc"
