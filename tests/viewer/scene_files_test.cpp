// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The reading of scene files (units, orientation), which is remembered for each file, and the
// export of results as colors for other programs, with its preview.
#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QFile>
#include <QLabel>
#include <QMenu>
#include <QMimeData>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>
#include <QTimer>
#include <QUrl>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "model/snapshot_values.h"
#include "open_scene.h"
#include "solved_window.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "window/command_line.h"
#include "window/files/color_export_dialog.h"
#include "window/files/export_actions.h"
#include "window/files/file_actions.h"
#include "window/files/reading.h"

namespace transillum::viewer::scene_files_test {

using namespace test;

namespace {

/// Calls `use` with the dialog of a class once it is open.
template <class Dialog, class Use>
void when_open(const Use& use) {
  auto* timer = new QTimer(qApp);
  QObject::connect(timer, &QTimer::timeout, timer, [timer, use] {
    if (auto* dialog = qobject_cast<Dialog*>(QApplication::activeModalWidget())) {
      if (use(*dialog)) {
        timer->deleteLater();
      }
    }
  });
  timer->start(20);
}

QPushButton* accepting(const QDialog& dialog) {
  for (QPushButton* button : dialog.findChildren<QPushButton*>()) {
    if (button->isDefault()) {
      return button;
    }
  }
  return nullptr;
}

/// Opens the file as the user does, and waits for it.
bool opens(TestWindow& window, const QString& path) {
  const auto before = window.scene.loaded();
  window.files().try_open(path);
  return wait_for([&] { return window.scene.loaded() != before && window.settled(); });
}

double width(TestWindow& window) {
  const auto bounds = window.scene.loaded()->scene->bounds();
  return bounds.high.x - bounds.low.x;
}

}  // namespace

class SceneFilesTest : public QObject {
  Q_OBJECT

 private slots:
  void units_and_orientation_are_remembered_for_a_file() {
    const QTemporaryDir folder;
    const QString path = write_open_scene(folder.path());
    const auto window = make_window(16);
    auto* reading = window->findChild<QAction*>("reading");
    auto* bar = window->findChild<Banner*>("reading_bar");
    QVERIFY(opens(*window, path));
    QCOMPARE(width(*window), 4.0);
    QVERIFY(bar->isHidden() && reading->isEnabled());

    bool shown = false;
    when_open<ReadingDialog>([&](ReadingDialog& dialog) {
      dialog.findChild<QComboBox*>("reading_unit")->setCurrentText("centimeters");
      shown = dialog.findChild<QDoubleSpinBox*>("reading_scale")->value() == 0.01 &&
              !dialog.findChild<QCheckBox*>("reading_photometric")->isEnabled();
      dialog.findChild<QComboBox*>("reading_orient")->setCurrentIndex(1);
      save_picture(dialog, "reading-dialog");
      QTest::mouseClick(accepting(dialog), Qt::LeftButton);
      return true;
    });
    reading->trigger();
    QVERIFY(shown);
    QVERIFY(wait_for([&] { return std::abs(width(*window) - 0.04) < 1e-12 && window->settled(); }));
    QVERIFY(bar->isHidden());  // the user has just chosen it

    QVERIFY(opens(*window, "cornell-box"));
    QVERIFY(!reading->isEnabled());
    QVERIFY(opens(*window, path));
    QVERIFY(std::abs(width(*window) - 0.04) < 1e-12);
    QVERIFY(window->scene.input().orient);
    QVERIFY2(bar->text().contains("lengths in centimeters, faces turned"), qPrintable(bar->text()));
    save_picture(*window, "reading-bar");

    const auto before = window->scene.loaded();
    QTest::mouseClick(window->findChild<QPushButton*>("usual_reading"), Qt::LeftButton);
    QVERIFY(wait_for([&] { return window->scene.loaded() != before && window->settled(); }));
    QCOMPARE(width(*window), 4.0);
    QVERIFY(bar->isHidden());
    QCOMPARE(window->files().reading().size(), 0);
  }

  void a_file_of_the_recent_ones_is_read_as_before() {
    const QTemporaryDir folder;
    const QString path = write_open_scene(folder.path());
    const QString settings_path = folder.filePath("kept.ini");
    {
      const auto window = make_window(16);
      SceneInput input;
      input.read.scale = 0.0254;
      input.read.join = true;
      window->files().open(path, {}, input);
      QVERIFY(wait_for([&] { return window->scene.loaded() && window->settled(); }));
      QSettings settings(settings_path, QSettings::IniFormat);
      window->files().save(settings);
    }
    const auto window = make_window(16);
    const QSettings settings(settings_path, QSettings::IniFormat);
    window->files().load(settings);
    QMenu* recent = nullptr;
    for (QMenu* menu : window->findChildren<QMenu*>()) {
      recent = menu->title() == "Open recent" ? menu : recent;
    }
    QVERIFY(recent);
    emit recent->aboutToShow();
    recent->actions().front()->trigger();
    QVERIFY(wait_for([&] { return window->scene.loaded() && window->settled(); }));
    QVERIFY(std::abs(width(*window) - 4 * 0.0254) < 1e-12);
    QCOMPARE(window->scene.input().read.join, std::optional(true));
    QVERIFY(window->findChild<Banner*>("reading_bar")->text().contains("lengths in inches"));
  }

  void only_so_many_files_are_remembered_and_damaged_ones_left_out() {
    const QTemporaryDir folder;
    ReadingMemory memory;
    SceneInput input;
    input.read.scale = 0.5;
    for (int k = 0; k < ReadingMemory::most_files + 7; ++k) {
      memory.remember(QString("/scene-%1.obj").arg(k), input);
    }
    QCOMPARE(memory.size(), ReadingMemory::most_files);
    QVERIFY(!memory.find("/scene-6.obj") && memory.find("/scene-7.obj"));
    memory.remember("/scene-7.obj", {});  // read as usual
    QVERIFY(!memory.find("/scene-7.obj"));

    QSettings settings(folder.filePath("a.ini"), QSettings::IniFormat);
    memory.save(settings);
    QStringList entries = settings.value("files/reading").toStringList();
    entries.prepend("{\"file\": \"/x.obj\", \"read\": {\"scale\": -1}}");
    entries.prepend("no JSON");
    entries.prepend("{\"file\": 3}");
    settings.setValue("files/reading", entries);
    ReadingMemory other;
    other.load(settings);
    QVERIFY(!other.find("/x.obj"));
    QCOMPARE(other.find("/scene-100.obj")->read.scale, 0.5);
  }

  void the_preview_has_the_colors_of_the_exported_file() {
    const SolvedWindow solved("cornell-box");
    QVERIFY(solved.ready);
    const auto snapshot = solved.window->snapshot();
    ColorExportDialog dialog(snapshot, solved.scene_view->view_point(), {0, 1, 0});
    dialog.show();
    QVERIFY(wait_for([&] { return dialog.ready(); }));
    save_picture(dialog, "export-colors");
    const auto* preview = dialog.findChild<QLabel*>("color_preview");
    const QImage automatic = preview->pixmap(Qt::ReturnByValue).toImage();
    QVERIFY(color_count(automatic) > 8);
    QVERIFY(!dialog.display().exposure && !dialog.display().up);

    auto* exposure = dialog.findChild<QDoubleSpinBox*>("color_exposure");
    QVERIFY(!exposure->isEnabled());
    const double value = automatic_exposure(solution_of(*snapshot));
    QVERIFY(std::abs(exposure->value() - value) < 1e-6);
    dialog.findChild<QCheckBox*>("color_automatic")->setChecked(false);
    exposure->setValue(4 * value);
    QVERIFY(preview->pixmap(Qt::ReturnByValue).toImage() != automatic);
    QVERIFY(dialog.display().exposure);

    // The patch in the middle has the color that the format's readers compute.
    const QImage picture = preview->pixmap(Qt::ReturnByValue).toImage();
    const ViewPoint view = solved.scene_view->view_point();
    const auto hit = snapshot->loaded->picker->first_lit_hit(view.eye, view.target - view.eye);
    QVERIFY(hit);
    const Rgb b = snapshot->radiosity[std::size_t(hit->patch)];
    const auto byte = [&](double channel) {
      const double x = std::min(1.0, exposure->value() * channel);
      return std::lround(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055));
    };
    const QColor middle = picture.pixelColor(picture.rect().center());
    QVERIFY(std::abs(middle.red() - byte(b.r)) <= 1 && std::abs(middle.blue() - byte(b.b)) <= 1);
    dialog.findChild<QComboBox*>("color_up")->setCurrentText("+z");
    QVERIFY((*dialog.display().up == Vec3{0, 0, 1}));
    auto* light_map = dialog.findChild<QCheckBox*>("color_light_map");
    QVERIFY(light_map->isEnabled() && !dialog.display().light_map);
    light_map->setChecked(true);
    QVERIFY(dialog.display().light_map);
    dialog.findChild<QComboBox*>("color_format")->setCurrentIndex(2);
    QCOMPARE(dialog.ending(), QString(".ply"));
    QVERIFY(!dialog.display().up && !dialog.display().light_map && !light_map->isEnabled());
  }

  void units_of_a_command_line_come_before_remembered_ones() {
    const QTemporaryDir folder;
    const QString path = write_open_scene(folder.path());
    const auto open_by = [&](TestWindow& window, std::vector<std::string> words) {
      words.insert(words.begin(), "transillum-viewer");
      words.push_back(path.toStdString());
      std::vector<const char*> arguments;
      for (const std::string& word : words) {
        arguments.push_back(word.c_str());
      }
      std::ostringstream out, error;
      const CommandLine line =
          parse_command_line(static_cast<int>(arguments.size()), arguments.data(), out, error)
              .command_line;
      const auto before = window.scene.loaded();
      window.files().open(QString::fromStdString(line.scene), {}, line.options.input,
                          line.reading_given);
      return wait_for([&] { return window.scene.loaded() != before && window.settled(); });
    };
    const auto window = make_window(16);
    QVERIFY(open_by(*window, {"--units", "cm"}));
    QVERIFY(std::abs(width(*window) - 0.04) < 1e-12);
    QVERIFY(open_by(*window, {}));  // remembered
    QVERIFY(std::abs(width(*window) - 0.04) < 1e-12);
    QVERIFY(open_by(*window, {"--units", "m"}));
    QCOMPARE(width(*window), 4.0);
    // The usual reading was chosen last, so nothing is remembered.
    QCOMPARE(window->files().reading().size(), 0);
    QVERIFY(open_by(*window, {}));
    QCOMPARE(width(*window), 4.0);
  }

  void a_file_of_each_format_can_be_dropped_data() {
    QTest::addColumn<QString>("file");
    for (const char* file : {"cube.glb", "ascii.ply", "binary.stl", "cube.off", "room.vs3",
                             "room.rad", "ascii.vtp", "ascii-version-4.vtk"}) {
      QTest::newRow(file) << QString(file);
    }
    QTest::newRow("obj") << "two.obj";
  }
  void a_file_of_each_format_can_be_dropped() {
    QFETCH(QString, file);
    const QTemporaryDir folder;
    // The first byte of the corpus chooses the reader that is fuzzed.
    const QString corpus = QStringLiteral(TRANSILLUM_SOURCE "/data/corpus/fuzz/formats/") + file;
    const QString path =
        write_file(folder.filePath(file),
                   file.endsWith(".obj")
                       ? "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nf 1 2 3\nf 6 5 4\n"
                       : contents_of(corpus).mid(1));
    const auto window = make_window(16);
    // The file is dropped over the scene: the child under the pointer leaves the event to the
    // window.
    auto* under = window->childAt(window->rect().center());
    QVERIFY(under);
    QVERIFY(drop_file(*window, path) && !under->acceptDrops());
    QVERIFY2(wait_for([&] { return window->scene.loaded() && window->settled(); }, 10000),
             qPrintable(window->banner_text()));
    QVERIFY2(window->windowTitle().startsWith(file), qPrintable(window->windowTitle()));
    QVERIFY(window->scene.loaded()->scene->patch_count() > 0);
  }

  void the_export_writes_what_the_library_writes_whole_or_not_at_all() {
    const QTemporaryDir folder;
    const SolvedWindow solved("cornell-box");
    QVERIFY(solved.ready);
    auto* exports = solved.window->findChild<ExportActions*>();
    DisplayOptions display;
    display.exposure = 0.25;
    for (const char* ending : {".glb", ".gltf", ".ply"}) {
      const QString path = folder.filePath(QString("a") + ending);
      exports->write_colors(path, display);
      QVERIFY(wait_for([&] { return !exports->writing(); }));
      const QString other = folder.filePath(QString("b") + ending);
      write_result(other.toStdString(), solution_of(*solved.window->snapshot()), display);
      QVERIFY(!contents_of(path).isEmpty());
      QCOMPARE(contents_of(path), contents_of(other));
    }
    QVERIFY_EXCEPTION_THROWN(exports->write_colors(folder.filePath("none/a.glb"), display),
                             InputError);
    QVERIFY_EXCEPTION_THROWN(exports->write_colors(folder.filePath("a.txt"), display), InputError);
    display.exposure = -1;
    QVERIFY_EXCEPTION_THROWN(exports->write_colors(folder.filePath("c.glb"), display), InputError);
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files).size(), 6);
  }

  void the_menu_opens_the_export_and_cancel_writes_nothing() {
    const SolvedWindow solved("cornell-box");
    QVERIFY(solved.ready);
    bool seen = false;
    when_open<ColorExportDialog>([&](ColorExportDialog& dialog) {
      if (!dialog.ready()) {
        return false;
      }
      seen = true;
      QTest::keyClick(&dialog, Qt::Key_Escape);
      return true;
    });
    solved.trigger("export_colors");
    QVERIFY(seen);
    QVERIFY(!solved.window->findChild<ExportActions*>()->writing());
  }
};

const test::Registered registered("scene_files", test::run_as_viewer<SceneFilesTest>);

}  // namespace transillum::viewer::scene_files_test

#include "scene_files_test.moc"
