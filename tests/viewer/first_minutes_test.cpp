// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The first five minutes of a teacher, a researcher and a developer, by mouse and keys alone, on a
// small screen and on a large one.
#include <QClipboard>
#include <QComboBox>
#include <QDockWidget>
#include <QDropEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QPushButton>
#include <QSpinBox>
#include <QTabWidget>
#include <QTableView>
#include <QTemporaryDir>
#include <QTextBrowser>
#include <QToolButton>
#include <QTreeWidget>

#include "lessons/lesson_panel.h"
#include "lessons/question_box.h"
#include "scene/start_page.h"
#include "screen_checks.h"
#include "solved_window.h"
#include "test_files.h"
#include "transillum/files.h"
#include "transillum/scene.h"

namespace transillum::viewer::first_minutes_test {

using namespace test;

namespace {

/// The window of a user who has just started the program.
std::unique_ptr<TestWindow> first_window(const QSize& size) {
  auto window = make_window(64);
  window->files().set_divides(true);
  window->resize(size);
  QApplication::setActiveWindow(window.get());
  handle_posted();
  return window;
}

/// Presses a key where the focus is.
void press(QWidget& window, int key, Qt::KeyboardModifiers modifiers = {}) {
  // Without a window manager, no window is active after a menu was closed.
  window.activateWindow();
  wait_for([&] { return window.isActiveWindow(); }, 5000);
  QWidget* target = QApplication::focusWidget();
  QTest::keyClick(target ? target : &window, static_cast<Qt::Key>(key), modifiers);
}

/// Does a command by typing words of it.
/// @returns whether the first entry has these words
bool do_command(TestWindow& window, const QString& words) {
  press(window, Qt::Key_K, Qt::ControlModifier);
  auto* query = window.findChild<QLineEdit*>("palette_query");
  if (!query) {
    return false;
  }
  QTest::keyClicks(query, words);
  const auto* list = window.findChild<QTreeWidget*>("palette_list");
  const bool found = list->topLevelItemCount() > 0 &&
                     list->topLevelItem(0)->text(0).contains(words, Qt::CaseInsensitive);
  QTest::keyClick(query, Qt::Key_Return);
  return found && wait_for([&] { return !window.findChild<QLineEdit*>("palette_query"); });
}

/// Types a value into a field, in place of the one that it has.
void type_into(QWidget& field, const QString& value) {
  field.setFocus();
  QTest::keyClick(&field, Qt::Key_A, Qt::ControlModifier);
  QTest::keyClicks(&field, value);
  QTest::keyClick(&field, Qt::Key_Return);
}

/// Drops a file on the window, as the file manager of a desktop does.
void drop_on(QWidget& window, const QString& path) {
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(path)});
  const QPoint place = window.rect().center();
  QDragEnterEvent enter(place, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&window, &enter);
  QDropEvent drop(place, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&window, &drop);
}

/// Chooses an entry of the menu that a right click has opened, by its name.
bool choose(const char* entry) {
  QMenu* menu = nullptr;
  const auto is_open = [&menu] {
    menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    return menu != nullptr;
  };
  if (!wait_for(is_open)) {
    return false;
  }
  for (QAction* action : menu->actions()) {
    if (action->objectName() == QLatin1String(entry) && action->isEnabled()) {
      QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
      return true;
    }
  }
  menu->close();
  return false;
}

/// Enters a name in the file dialog that opens next.
void answer_file_dialog(const QString& path) {
  auto* timer = new QTimer(qApp);
  QObject::connect(timer, &QTimer::timeout, timer, [timer, path] {
    if (auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget())) {
      timer->deleteLater();
      dialog->selectFile(path);
      QTest::keyClick(dialog->findChild<QLineEdit*>("fileNameEdit"), Qt::Key_Return);
    }
  });
  timer->start(10);
}

/// A room of six walls and a small lamp, as a program for modeling writes it.
QString write_room(const QTemporaryDir& folder) {
  const std::string path = folder.filePath("office.obj").toStdString();
  write_obj(path, describe_scene("cornell-box"));
  return QString::fromStdString(path);
}

QToolButton* button_of(const QWidget& window, const char* action) {
  for (auto* button : window.findChildren<QToolButton*>()) {
    if (button->defaultAction() && button->defaultAction()->objectName() == QLatin1String(action)) {
      return button;
    }
  }
  return nullptr;
}

/// A point of the scene at which a patch that receives light is drawn.
QPoint place_of_a_patch(const SceneView& view) {
  for (int y = view.canvas()->height() / 2; y < view.canvas()->height() - 8; y += 5) {
    for (int x = 8; x < view.canvas()->width() - 8; x += 7) {
      const PatchId patch = view.patch_at({x, y});
      if (patch != no_patch && is_inside(view, {x, y}, patch)) {
        return {x, y};
      }
    }
  }
  return {-1, -1};
}

}  // namespace

class FirstMinutesTest : public QObject {
  Q_OBJECT

 private slots:
  void a_teacher_begins_with_a_lesson_on_a_projector_data() { add_screens(); }
  void a_teacher_begins_with_a_lesson_on_a_projector() {
    QFETCH(QSize, screen);
    const auto window = first_window(screen);
    // The first page: all of it fits the width, and nothing is solved.
    const auto* start = window->findChild<StartPage*>();
    QVERIFY(start->isVisible() && !window->scene.is_opening() && !window->scene.loaded());
    auto* teach = start->findChild<QAbstractButton*>("choose_layout_teach");
    QVERIFY(is_whole(*teach));
    for (const char* card : {"built_in_cornell-box", "built_in_flatland", "lesson_1", "lesson_4"}) {
      QVERIFY2(is_whole(*start->findChild<QWidget*>(card)), card);
    }
    QCOMPARE(cut_texts(*window), QStringList());
    save_picture(*window, "minutes-1-start");

    QTest::mouseClick(teach, Qt::LeftButton);
    QVERIFY(wait_for([&] { return window->snapshot() != nullptr; }) && comes_to_rest(*window));
    const auto* title = window->findChild<QLabel*>("lesson_title");
    QVERIFY(!start->isVisible() && is_whole(*title));
    QCOMPARE(title->text(), QString("One number per patch"));
    QVERIFY(window->size() == screen);
    QVERIFY(controls_of(*window).size() <= 30);
    QCOMPARE(cut_texts(*window), QStringList());
    auto* view = window->findChild<SceneView*>();
    QVERIFY(view->width() > 0.4 * window->width());
    save_picture(*window, "minutes-2-lesson");

    // An answer by a click in the scene; then the button beside the question.
    const QPoint place = place_of_a_patch(*view);
    QVERIFY(place.x() >= 0);
    QTest::mouseClick(view->canvas(), Qt::LeftButton, {}, place);
    QToolButton* reveal = button_of(*window, "question_reveal");
    QVERIFY(reveal && is_whole(*reveal) && reveal->isEnabled());
    QTest::mouseClick(reveal, Qt::LeftButton);
    const auto* question = window->findChild<QuestionBox*>();
    QVERIFY(wait_for([&] { return question->solved(); }) && comes_to_rest(*window));
    QVERIFY(window->colors.quantity() == Quantity::radiosity);
    save_picture(*window, "minutes-3-answer");

    press(*window, Qt::Key_PageDown);
    QVERIFY(comes_to_rest(*window));
    QCOMPARE(title->text(), QString("Light comes from all directions"));
    QVERIFY(window->findChild<QDockWidget*>("direction_dock")->isVisible());
    save_picture(*window, "minutes-4-next");

    QTest::keyClick(window.get(), Qt::Key_P);
    QVERIFY(wait_for([&] { return window->isFullScreen(); }));
    QVERIFY(title->isVisible() && view->isVisible() && theme::scale() >= 1.2);
    QVERIFY(!window->menuBar()->isVisible());
    // The page is about the panel, which is shown beside the scene.
    QVERIFY(window->findChild<QDockWidget*>("direction_dock")->isVisible());
    QVERIFY(view->width() > 0.2 * window->width());
    save_picture(*window, "minutes-5-projector");
    QTest::keyClick(window.get(), Qt::Key_Escape);
    QVERIFY(wait_for([&] { return !window->isFullScreen() && window->menuBar()->isVisible(); }));
    QVERIFY(theme::scale() == 1 && title->isVisible());
    QCOMPARE(title->text(), QString("Light comes from all directions"));
  }

  void a_researcher_asks_how_wrong_an_own_scene_is_data() { add_screens(); }
  void a_researcher_asks_how_wrong_an_own_scene_is() {
    QFETCH(QSize, screen);
    const QTemporaryDir folder;
    const auto window = first_window(screen);
    drop_on(*window, write_room(folder));
    QVERIFY(wait_for([&] { return window->snapshot() != nullptr; }) && comes_to_rest(*window));
    // Faces are divided, and a bar says so.
    auto* keep = window->findChild<QAbstractButton*>("keep_faces");
    QVERIFY(is_whole(*keep));
    QVERIFY(window->snapshot()->radiosity.size() > 1000);
    const QStringList controls = controls_of(*window);
    QVERIFY2(controls.size() <= 45, qPrintable(controls.join("; ")));
    QCOMPARE(cut_texts(*window), QStringList());
    save_picture(*window, "researcher-1-own");

    // Fewer patches, and a draft, by the one button.
    auto* solve = window->findChild<QAbstractButton*>("restart");
    auto* draft = window->findChild<QAbstractButton*>("draft");
    auto* patches = window->findChild<QSpinBox*>("patches_wanted");
    QVERIFY(is_whole(*solve) && is_whole(*draft) && is_whole(*patches));
    QTest::mouseClick(draft, Qt::LeftButton);
    type_into(*patches, "200");
    QTest::mouseClick(solve, Qt::LeftButton);
    QVERIFY(wait_for([&] {
      const auto now = window->snapshot();
      return now && now->radiosity.size() < 400 && now->progress.finished;
    }));
    QVERIFY(comes_to_rest(*window));

    // The light paths of a patch, from its menu.
    auto* view = window->findChild<SceneView*>();
    const QPoint place = place_of_a_patch(*view);
    QVERIFY(place.x() >= 0);
    QTest::mouseClick(view->canvas(), Qt::RightButton, {}, place);
    QVERIFY(choose("show_paths"));
    QVERIFY(window->findChild<QDockWidget*>("paths_dock")->isVisible());
    QVERIFY(comes_to_rest(*window));
    QVERIFY(window->findChild<QAbstractItemView*>("path_table")->model()->rowCount() > 1);
    QCOMPARE(cut_texts(*window), QStringList());
    save_picture(*window, "researcher-2-patch");

    // How wrong is the surface?
    QVERIFY(do_command(*window, "surfaces"));
    QVERIFY(window->findChild<QDockWidget*>("parts_dock")->isVisible());
    auto* tabs = window->findChild<QTabWidget*>("surface_tabs");
    QTest::mouseClick(tabs->tabBar(), Qt::LeftButton, {},
                      tabs->tabBar()->tabRect(tabs->count() - 1).center());
    auto* measure = window->findChild<QAbstractButton*>("measure_surfaces");
    QVERIFY(is_whole(*measure) && measure->isEnabled());
    QTest::mouseClick(measure, Qt::LeftButton);
    const auto* errors = window->findChild<QTableView*>("error_table")->model();
    QVERIFY(wait_for([&] { return errors->rowCount() > 2; }) && comes_to_rest(*window));
    const auto* total = window->findChild<QLabel*>("error_total");
    QVERIFY2(total->text().contains('%'), qPrintable(total->text()));
    save_picture(*window, "researcher-3-errors");

    const QString session = folder.filePath("office.transillum.json");
    answer_file_dialog(session);
    press(*window, Qt::Key_S, Qt::ControlModifier);
    QVERIFY(wait_for([&] { return QFileInfo::exists(session); }));
  }

  void a_developer_steps_through_a_direction_data() { add_screens(); }
  void a_developer_steps_through_a_direction() {
    QFETCH(QSize, screen);
    const auto window = first_window(screen);
    QTest::mouseClick(window->findChild<QAbstractButton*>("choose_layout_debug"), Qt::LeftButton);
    QVERIFY(wait_for([&] { return window->snapshot() && window->snapshot()->progress.finished; }) &&
            comes_to_rest(*window));
    const auto* map = window->findChild<QDockWidget*>("map_dock");
    const auto area = [](const QSize& s) { return 1.0 * s.width() * s.height(); };
    QVERIFY(area(map->size()) >= 0.49 * area(window->size()));
    const QStringList controls = controls_of(*window);
    QVERIFY2(controls.size() <= 45, qPrintable(controls.join("; ")));
    QCOMPARE(cut_texts(*window), QStringList());
    save_picture(*window, "developer-1-map");

    const Focus& focus = window->focus;
    const auto goes_to = [&](int step) {
      return wait_for([&] { return focus.arrived() && focus.position().step == step; });
    };
    const int step = focus.position().step;
    QVERIFY(step > 1);
    press(*window, Qt::Key_Comma);
    QVERIFY(goes_to(step - 1));
    auto* forward = button_of(*window, "step_on");
    QVERIFY(forward && is_whole(*forward));
    QTest::mouseClick(forward, Qt::LeftButton);
    QVERIFY(goes_to(step));
    QVERIFY(wait_for([&] { return window->views().map.up_to_date(); }));

    // Back to where a patch takes part.
    QVERIFY(do_command(*window, "breakpoints"));
    auto* patch = window->findChild<QSpinBox*>("breakpoint_patch");
    QVERIFY(is_whole(*patch));
    type_into(*patch, "16");
    QCOMPARE(window->breakpoints.list().size(), std::size_t{1});
    auto* back = button_of(*window, "run_back");
    QVERIFY(back && is_whole(*back) && back->isEnabled());
    QTest::mouseClick(back, Qt::LeftButton);
    QVERIFY(wait_for([&] {
      return focus.arrived() && focus.position().step >= 0 &&
             holds(window->breakpoints.list().front(), focus.map()->history, focus.position().step);
    }));
    QVERIFY(comes_to_rest(*window));
    QCOMPARE(cut_texts(*window), QStringList());
    save_picture(*window, "developer-2-breakpoint");

    press(*window, Qt::Key_M, Qt::ControlModifier | Qt::AltModifier);
    const QString command = QGuiApplication::clipboard()->text();
    QVERIFY2(command.startsWith("transillum map cornell-box") && command.contains("--step") &&
                 command.endsWith("--out map.svg"),
             qPrintable(command));
  }

 private:
  static void add_screens() {
    QTest::addColumn<QSize>("screen");
    QTest::newRow("1280 x 720") << small_screen;
    QTest::newRow("1600 x 1000") << large_screen;
  }
};

const test::Registered registered("first_minutes", test::run_as_viewer<FirstMinutesTest>);

}  // namespace transillum::viewer::first_minutes_test

#include "first_minutes_test.moc"
