// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The files by which a desktop knows the viewer: each kind of file that it opens has a type, the
// menu entry takes that type, and the description for software centers names the entry.
#include <QDir>
#include <QFile>
#include <QImage>
#include <QMimeDatabase>
#include <QProcess>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>

#include "test_files.h"
#include "transillum/files.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"
#include "window_support.h"

namespace transillum::viewer::desktop_test {

namespace {

const QString folder = QStringLiteral(TRANSILLUM_SOURCE "/viewer/desktop/");
const QString entry_file = folder + "org.transillum.Viewer.desktop";

/// The value of a key of the menu entry.
QString entry(const QString& key) {
  const QRegularExpression line("^" + key + "=(.*)$", QRegularExpression::MultilineOption);
  return line.match(test::contents_of(entry_file)).captured(1);
}

/// Names of all files that the viewer opens.
QStringList files() {
  QStringList names{"result.vtp", "work.transillum.json"};
  for (const SceneFormat& format : scene_formats()) {
    names += "scene" + QString::fromStdString(format.ending);
  }
  return names;
}

/// Runs a validator where it is installed. It may complain only about `accepted`.
void validate(const QString& program, const QStringList& arguments, const QString& accepted = {}) {
  if (QStandardPaths::findExecutable(program).isEmpty()) {
    QSKIP(qPrintable(program + " is not installed"));
  }
  QProcess process;
  process.setProcessChannelMode(QProcess::MergedChannels);
  process.start(program, arguments);
  QVERIFY(process.waitForFinished());
  const QByteArray output = process.readAll();
  QVERIFY(process.exitStatus() == QProcess::NormalExit);
  if (process.exitCode() != 0) {
    auto complaints =
        QRegularExpression("^[EW]: .*$", QRegularExpression::MultilineOption).globalMatch(output);
    QVERIFY2(complaints.hasNext() && !accepted.isEmpty(), output);
    while (complaints.hasNext()) {
      QVERIFY2(complaints.next().captured().contains(accepted), output);
    }
  }
}

}  // namespace

class DesktopTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    // A folder of data with our types, in addition to the system's.
    const QString data = data_.path();
    QVERIFY(QDir(data).mkpath("mime/packages"));
    QVERIFY(QFile::copy(folder + "org.transillum.Viewer.xml",
                        data + "/mime/packages/org.transillum.Viewer.xml"));
    qputenv("XDG_DATA_DIRS", (data + ":/usr/share").toUtf8());
  }

  void the_types_are_valid() {
    validate("update-mime-database", {"-n", data_.path() + "/mime"});
    const QString text = test::contents_of(folder + "org.transillum.Viewer.xml");
    QVERIFY(text.contains("*.transillum.json"));
  }

  void the_menu_entry_is_valid() { validate("desktop-file-validate", {entry_file}); }

  void the_description_is_valid_data() {
    QTest::addColumn<QString>("pictures");
    QTest::newRow("without addresses") << "";
    QTest::newRow("with addresses") << "https://example.org/pictures";
  }
  void the_description_is_valid() {
    QFETCH(QString, pictures);
    QString text = test::contents_of(folder + "org.transillum.Viewer.metainfo.xml.in");
    text.replace("@PROJECT_VERSION@", "0.1.0").replace("@TRANSILLUM_DATE@", "2026-11-23");
    QString screenshots;
    if (!pictures.isEmpty()) {
      screenshots = test::contents_of(folder + "screenshots.xml.in");
      auto pictures_in_it = QRegularExpression("@/(.*\\.png)<").globalMatch(screenshots);
      QVERIFY(pictures_in_it.hasNext());
      while (pictures_in_it.hasNext()) {
        const QString picture = pictures_in_it.next().captured(1);
        QVERIFY2(QFile::exists(folder + "../pictures/" + picture), qPrintable(picture));
      }
      screenshots.replace("@TRANSILLUM_PICTURES_URL@", pictures);
    }
    text.replace("@TRANSILLUM_SCREENSHOTS@", screenshots);
    text.replace("@TRANSILLUM_URL@",
                 pictures.isEmpty() ? "" : "<url type=\"homepage\">https://example.org</url>\n");
    const QString file =
        test::write_file(data_.filePath("org.transillum.Viewer.metainfo.xml"), text.toUtf8());
    // Newer versions take no description without a home page.
    validate("appstreamcli", {"validate", "--no-net", file},
             pictures.isEmpty() ? "url-homepage-missing" : "");
  }

  void every_kind_of_file_has_a_type_that_the_menu_entry_takes() {
    const QStringList taken = entry("MimeType").split(';', Qt::SkipEmptyParts);
    const QMimeDatabase types;
    for (const QString& name : files()) {
      QStringList candidates;
      for (const QMimeType& type : types.mimeTypesForFileName(name)) {
        candidates += type.name();
      }
      QVERIFY2(std::any_of(candidates.begin(), candidates.end(),
                           [&](const QString& type) { return taken.contains(type); }),
               qPrintable(name + ": " + candidates.join(' ')));
    }
    QCOMPARE(types.mimeTypeForFile("work.transillum.json", QMimeDatabase::MatchExtension).name(),
             QStringLiteral("application/x-transillum-session+json"));
  }

  void the_menu_entry_runs_the_viewer_with_a_file_and_an_icon() {
    QCOMPARE(entry("Exec"), QStringLiteral("transillum-viewer %f"));
    QVERIFY(QFile::exists(folder + "icons/" + entry("Icon") + ".svg"));
    for (const int size : {16, 24, 32, 48, 64, 128, 256}) {
      const QImage icon(folder + QStringLiteral("icons/%1-%2.png").arg(entry("Icon")).arg(size));
      QCOMPARE(icon.size(), QSize(size, size));
    }
  }

  void each_kind_of_file_opens_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("scene") << "scene.obj";
    QTest::newRow("result") << "result.vtp";
    QTest::newRow("session") << "work.transillum.json";
  }
  void each_kind_of_file_opens() {
    QFETCH(QString, name);
    const QString file = data_.filePath(name), picture = data_.filePath("picture.png");
    if (name.endsWith(".obj")) {
      write_obj(file.toStdString(), describe_scene("furnace"));
    } else if (name.endsWith(".vtp")) {
      SolveOptions options;
      options.directions = 8;
      write_result(file.toStdString(), solve(load_scene("furnace"), options));
    } else {
      test::write_file(file, R"({"show": {"scene": "furnace", "options": {"directions": 8}}})");
    }
    QFile::remove(picture);
    // Runs the entry's Exec, with the file for %f.
    QProcess process;
    process.setProcessChannelMode(QProcess::MergedChannels);
    process.start(TRANSILLUM_VIEWER, {file, "--screenshot", picture});
    QVERIFY(process.waitForFinished(120'000));
    const QByteArray output = process.readAll();
    QVERIFY2(process.exitCode() == 0, output);
    QVERIFY(!QImage(picture).isNull());
  }

 private:
  QTemporaryDir data_;
};

const test::Registered registered("desktop", test::run_as_viewer<DesktopTest>);

}  // namespace transillum::viewer::desktop_test

#include "desktop_test.moc"
