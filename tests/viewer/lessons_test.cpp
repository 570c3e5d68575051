// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lessons in the viewer's window: pages set it up, errors are reported, pages turn in any order.
#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QLabel>
#include <QMouseEvent>
#include <QSettings>
#include <QSlider>
#include <QTemporaryDir>
#include <QTextBrowser>

#include "lessons/lesson_panel.h"
#include "scene/callout_layer.h"
#include "solved_window.h"
#include "stepping/algorithm_view.h"
#include "test_files.h"
#include "transillum/at.h"
#include "window/base/view_state_applier.h"
#include "window/files/export_actions.h"

namespace transillum::viewer::lessons_test {

using namespace test;

namespace {

/// A window for lessons.
struct Taught {
  std::unique_ptr<TestWindow> window = make_window();
  LessonPanel* panel = window->findChild<LessonPanel*>();

  bool settles() {
    return wait_for([this] { return window->settled(); }) &&
           wait_for([this] { return window->settled(); });
  }
  QString text(const char* name) const { return window->findChild<QLabel*>(name)->text(); }
  void trigger(const char* action) const { window->findChild<QAction*>(action)->trigger(); }
  const Focus& focus() const { return window->focus; }
};

/// A window that shows the first page of a lesson.
struct Opened : Taught {
  QTemporaryDir folder;
  bool ready = false;

  explicit Opened(const QByteArray& lesson) {
    const QString path = folder.filePath("lesson.json");
    write_file(path, lesson);
    window->files().try_open(path);
    ready = settles();
  }
};

/// A page with controls.
struct Controlled : Opened {
  Controlled()
      : Opened(R"({"title": "T", "pages": [{"text": ["Above.", "",
          "With {M} directions, {set}, of {rho} and {step}", "", "Below."],
          "show": {"layout": "teach", "scene": "furnace", "options": {"directions": 16},
                   "camera": {"eye": [9, 8, 7], "target": [0, 0, 0], "up": [0, 0, 1], "angle": 20},
                   "focus": {"direction": 2, "step": 3}},
          "controls": {"M": {"option": "directions", "values": [4, 16, 32]},
                       "set": {"option": "sampling", "values": ["random", "fibonacci"]},
                       "rho": {"reflectance": "glowing", "from": 0, "to": 0.8},
                       "step": {"focus": "step"}}}]})") {}

  template <class Widget>
  Widget* part(const char* control, const char* name) const {
    return window->findChild<QWidget*>(control)->findChild<Widget*>(name);
  }
};

/// A page with callouts, then one with a large panel, then a usual one.
struct Named : Opened {
  const CalloutLayer* layer;
  QTextBrowser* text;

  Named()
      : Opened(R"({"title": "T", "pages": [
          {"text": "Patch *i*, ω and *A*(i, j, ω) with *B*ᵢ.",
           "show": {"layout": "teach", "panels": ["map"], "scene": "cornell-box",
                    "options": {"directions": 8}, "select": 16, "focus": {"direction": 5, "step": "exchange", "phase": "split"}},
           "callouts": [{"text": "the top", "patch": 16},
                        {"text": "here", "point": [0.2, 0.3, 0.1]}]},
          {"text": "Large.", "large": "map"}, {"text": "Usual."}]})"),
        layer(window->findChild<CalloutLayer*>()),
        text(window->findChild<QTextBrowser*>("lesson_text")) {
    ready = ready && wait_for([this] { return names() == QStringList{"the top", "here"}; });
  }
  QStringList names() const {
    QStringList all;
    for (const CalloutLayer::Placed& callout : layer->callouts()) {
      all << callout.text;
    }
    return all;
  }
};

}  // namespace

class LessonsTest : public QObject {
  Q_OBJECT

 private slots:
  void pages_set_up_the_window() {
    Taught taught;
    TestWindow& window = *taught.window;
    const QTemporaryDir folder;
    const QString path = folder.filePath("mine.json");
    write_file(path, R"({"title": "Mine", "pages": [
      {"title": "One", "text": "first", "show": {"layout": "teach", "scene": "furnace",
        "options": {"directions": 16}, "solve": 5, "select": 4}},
      {"title": "Two", "text": "second", "show": {"focus": {"direction": 9, "step": 3,
        "phase": "split"}, "colors": {"show": "luminance"},
        "camera": {"eye": [9, 8, 7], "target": [0, 0, 0], "up": [0, 0, 1], "angle": 20}}},
      {"text": "third", "show": {"options": {"directions": 8}, "solve": "finished",
        "focus": {"iteration": 2, "direction": 2, "step": "exchange"}}}]})");
    window.files().try_open(path);
    QVERIFY(taught.settles());
    QCOMPARE(taught.text("lesson_title"), QString("One"));
    QCOMPARE(taught.text("lesson_place"), QString("1 of 3"));
    QCOMPARE(window.findChild<QTextBrowser*>("lesson_text")->toPlainText(), QString("first"));
    QCOMPARE(window.snapshot()->progress.direction, 5);
    QCOMPARE(window.selection.patch(), PatchId{4});
    QVERIFY(window.views().docks.current() == Layout::teach);

    taught.trigger("lesson_next");
    QVERIFY(taught.settles());
    QCOMPARE(window.snapshot()->progress.direction, 5);  // not solved again
    QVERIFY(!taught.focus().following());
    QCOMPARE(taught.focus().position().direction, 8);
    QCOMPARE(taught.focus().position().step, 2);
    QVERIFY(taught.focus().phase() == Phase::split);
    QVERIFY(window.colors.scale().mode == ColorMode::luminance);
    QCOMPARE(window.findChild<SceneView*>()->view_point().eye.x, 9.0);

    taught.trigger("lesson_next");
    QVERIFY(taught.settles());
    QCOMPARE(taught.text("lesson_title"), QString("Mine"));
    QCOMPARE(window.runner.state(), RunState::finished);
    QCOMPARE(window.snapshot()->progress.passes, 8);
    QCOMPARE(taught.focus().position().iteration, 1);
    QVERIFY(taught.focus().map()->history.step(taught.focus().position().step).exchanges > 0);
    QCOMPARE(window.findChild<QAction*>("lesson_next")->text(), QString("Next lesson"));

    // The first page shows fewer directions than are solved: they are solved again.
    taught.trigger("lesson_previous");
    taught.trigger("lesson_previous");
    QVERIFY(taught.settles());
    QCOMPARE(window.snapshot()->progress.direction, 5);
    QCOMPARE(window.snapshot()->progress.iteration, 0);
    QVERIFY(taught.focus().following());
    QVERIFY(window.colors.scale().mode == ColorMode::true_color);
    QVERIFY(!window.findChild<QAction*>("lesson_previous")->isEnabled());

    // Changes by the user are reverted.
    window.selection.select(1);
    taught.trigger("lesson_again");
    QVERIFY(taught.settles());
    QCOMPARE(window.selection.patch(), PatchId{4});
  }

  // The widgets are in the lines of the text, where their names were.
  void controls_are_in_the_text() {
    Controlled taught;
    QVERIFY(taught.ready);
    const auto* text = taught.window->findChild<QTextBrowser*>("lesson_text");
    QVERIFY(!text->toPlainText().contains('{'));
    for (const char* control : {"control_M", "control_set", "control_rho", "control_step"}) {
      auto* widget = taught.window->findChild<QWidget*>(control);
      QVERIFY(widget->isVisible() && text->viewport()->rect().contains(widget->geometry()));
      QVERIFY(widget->y() > 10);  // below the first line
    }
    save_picture(*taught.window, "lesson-controls");
  }

  void controls_of_options_solve_again_and_keep_the_view() {
    Controlled taught;
    QVERIFY(taught.ready);
    TestWindow& window = *taught.window;
    auto* directions = taught.part<QSlider>("control_M", "slider");
    QCOMPARE(directions->value(), 1);
    window.findChild<SceneView*>()->view_from_side(Side::top);
    const ViewPoint turned = window.findChild<SceneView*>()->view_point();
    QTest::keyClick(directions, Qt::Key_Right);
    QVERIFY(wait_for([&] { return window.snapshot()->options.directions == 32; }));
    QVERIFY(taught.settles());
    QVERIFY(window.findChild<SceneView*>()->view_point() == turned);
    QCOMPARE(taught.focus().position().step, 2);
    auto* set = taught.part<QComboBox>("control_set", "choice");
    set->setFocus();
    QTest::keyClick(set, Qt::Key_Home);
    QVERIFY(wait_for([&] { return window.snapshot()->options.sampling == Sampling::random; }));
  }

  void a_control_of_a_material_relights_and_follows_undo() {
    Controlled taught;
    QVERIFY(taught.ready);
    auto* rho = taught.part<QSlider>("control_rho", "slider");
    QCOMPARE(rho->value(), 63);  // 0.5 of 0.8
    rho->setValue(0);
    QVERIFY(
        wait_for([&] { return std::abs(taught.window->snapshot()->radiosity[0].r - 1) < 1e-9; }));
    taught.trigger("undo");
    QTRY_COMPARE(rho->value(), 63);
    // In the furnace B = E / (1 - rho), and rho is the factor of the changes; both up to the error
    // of 16 directions.
    QVERIFY(taught.window->colors.exposure_is_automatic());
    QTest::keyClick(rho, Qt::Key_End);
    QVERIFY(
        wait_for([&] { return std::abs(taught.window->snapshot()->radiosity[0].r - 5) < 0.02; }));
    const SolveStatistics& statistics = taught.window->snapshot()->statistics;
    QVERIFY(std::abs(statistics.iteration_records.back().contraction - 0.8) < 1e-3);
    QVERIFY(std::abs(statistics.rho_max - 0.8) < 1e-12);
    QVERIFY(!taught.window->colors.exposure_is_automatic());  // else the picture would not change
  }

  void a_control_of_the_step_moves_the_focus_and_follows_it() {
    Controlled taught;
    QVERIFY(taught.ready);
    auto* step = taught.part<QSlider>("control_step", "slider");
    step->setValue(7);
    QTRY_COMPARE(taught.focus().position().step, 6);
    taught.trigger("step_on");
    QTRY_COMPARE(step->value(), 8);
  }

  void exported_pictures_have_the_callouts_of_the_page() {
    Taught taught;
    TestWindow& window = *taught.window;
    const QTemporaryDir folder;
    const QString path = folder.filePath("named.json");
    write_file(path, R"({"title": "T", "pages": [
      {"text": "One.", "show": {"layout": "teach", "scene": "cornell-box",
        "options": {"directions": 8}, "focus": {"direction": 5, "step": "last"}},
       "callouts": [{"text": "the top", "patch": 16}, {"text": "here", "point": [0.2, 0.3, 0.1]}]},
      {"text": "Two."}]})");
    window.files().try_open(path);
    QVERIFY(taught.settles());
    const auto* layer = window.findChild<CalloutLayer*>();
    QTRY_COMPARE(layer->callouts().size(), std::size_t{2});
    auto* view = window.findChild<SceneView*>();
    const auto& exports = *window.findChild<ExportActions*>();
    const auto exported_map = [&] {
      exports.write_map_picture(folder.filePath("map.svg"));
      exports.write_map_picture(folder.filePath("map.png"));
      return contents_of(folder.filePath("map.svg"));
    };
    // There, the top is behind other patches.
    QVERIFY(exported_map().contains(">here</text>"));
    const QImage named_map(folder.filePath("map.png"));
    const QPointF anchor = layer->callouts()[0].anchor;
    // At twice the size, the point of the callout is at twice the distance.
    const QImage named = view->picture(2);
    const QPoint point = (2 * anchor * view->devicePixelRatioF()).toPoint();
    QCOMPARE(QColor(named.pixel(point)), theme::on_dark);
    save_picture(*view, "callout");
    window.findChild<LessonPanel*>()->show_page(0, 1);
    QVERIFY(taught.settles());
    QTRY_VERIFY(layer->callouts().empty());
    QVERIFY(QColor(view->picture(2).pixel(point)) != theme::on_dark);
    QVERIFY(!exported_map().contains("here"));
    QVERIFY(QImage(folder.filePath("map.png")) != named_map);
  }

  void callouts_are_where_their_patches_are_drawn() {
    Named taught;
    QVERIFY(taught.ready);
    const auto anchor = [&taught] { return taught.layer->callouts()[0].anchor; };
    auto* view = taught.window->findChild<SceneView*>();
    QCOMPARE(view->patch_at(anchor().toPoint()), PatchId{16});
    // The callout moves with the camera.
    const QPointF before = anchor();
    view->view_from_side(Side::top);
    QTRY_VERIFY(anchor() != before);
  }

  void an_index_is_below_the_line() {
    Named taught;
    QVERIFY(taught.ready);
    const QTextCursor index = taught.text->document()->find("Bi");
    QVERIFY(!index.isNull());
    QVERIFY(index.charFormat().verticalAlignment() == QTextCharFormat::AlignSubScript);
  }

  void a_symbol_under_the_pointer_is_named_in_all_views() {
    Named taught;
    QVERIFY(taught.ready);
    const auto point_at = [&](const char* word) {
      QTextCursor cursor = taught.text->document()->find(word);
      cursor.setPosition(cursor.selectionStart());
      const QPoint position = taught.text->cursorRect(cursor).center() + QPoint(3, 0);
      QMouseEvent move(QEvent::MouseMove, position, taught.text->viewport()->mapToGlobal(position),
                       Qt::NoButton, Qt::NoButton, Qt::NoModifier);
      QApplication::sendEvent(taught.text->viewport(), &move);
    };
    auto* map = taught.window->findChild<MapCanvas*>("map_canvas");
    const QImage before = map->grab().toImage();
    point_at("A(");
    QVERIFY(taught.names().mid(2).contains("i"));
    QTRY_VERIFY(map->grab().toImage() != before);
    int marked = 0;
    for (const QLabel* line : taught.window->findChild<AlgorithmView*>()->findChildren<QLabel*>()) {
      marked += line->styleSheet().contains(theme::region.name()) ? 1 : 0;
    }
    QVERIFY(marked > 0);
    save_picture(*taught.window, "lesson-symbol");
    point_at("Patch");
    QTRY_COMPARE(taught.names().size(), 2);
  }

  void a_page_enlarges_a_panel_for_itself() {
    Named taught;
    QVERIFY(taught.ready);
    const auto* map_dock = taught.window->findChild<QDockWidget*>("map_dock");
    const int usual = map_dock->width();
    taught.trigger("lesson_next");
    QTRY_VERIFY(map_dock->width() > 1.25 * usual);
    save_picture(*taught.window, "lesson-large");
    taught.trigger("lesson_next");
    QTRY_VERIFY2(std::abs(map_dock->width() - usual) < 8,
                 qPrintable(QString("%1, before %2").arg(map_dock->width()).arg(usual)));
  }

  void callouts_are_those_of_the_page_and_its_scene() {
    Named taught;
    QVERIFY(taught.ready);
    taught.trigger("lesson_next");
    QTRY_VERIFY(taught.names().isEmpty());
    taught.trigger("lesson_previous");
    QTRY_COMPARE(taught.names().size(), 2);
    // The callouts are not shown in a scene that the user opens.
    taught.window->files().open_scene("furnace");
    QTRY_VERIFY(taught.names().isEmpty());
  }

  void a_bad_lesson_is_reported_and_changes_nothing() {
    Taught taught;
    const std::size_t lessons = taught.panel->lessons().size();
    const QTemporaryDir folder;
    const QString path = folder.filePath("bad.json");
    write_file(
        path,
        R"({"title": "T", "pages": [{"text": ""}, {"text": "", "show": {"panels": ["mop"]}}]})");
    taught.window->files().try_open(path);
    const QString message = taught.window->banner_text();
    QVERIFY2(message.contains("bad.json, page 2") && message.contains("mop"), qPrintable(message));
    QCOMPARE(taught.panel->lessons().size(), lessons);
    QCOMPARE(taught.panel->lesson(), -1);
  }

  // Turning pages leads through the first hour, and after it to the lesson that follows its last.
  void the_first_hour_is_turned_from_lesson_to_lesson() {
    Taught taught;
    const auto& lessons = taught.panel->lessons();
    std::vector<int> hour;
    for (int k = 0; k < std::ssize(lessons); ++k) {
      if (at(lessons, k).first_hour) {
        hour.push_back(k);
      }
    }
    QVERIFY(hour.size() > 2 && hour.back() - hour.front() >= std::ssize(hour));
    for (std::size_t k = 0; k < hour.size(); ++k) {
      const int next = k + 1 < hour.size() ? hour[k + 1] : hour[k] + 1;
      taught.panel->show_page(hour[k], static_cast<int>(at(lessons, hour[k]).pages.size()) - 1);
      QVERIFY(taught.settles());
      taught.trigger("lesson_next");
      QCOMPARE(taught.panel->lesson(), next);
      QVERIFY(taught.settles());
      taught.trigger("lesson_previous");
      QCOMPARE(taught.panel->lesson(), hour[k]);
      QVERIFY(taught.settles());
    }
  }

  void a_missing_scene_is_reported_and_the_next_page_works() {
    Taught taught;
    const QTemporaryDir folder;
    const QString path = folder.filePath("lost.json");
    write_file(path, R"({"title": "T", "pages": [{"text": "", "show": {"scene": "lost.obj"}},
                    {"text": "", "show": {"scene": "furnace", "options": {"directions": 4}}}]})");
    taught.window->files().try_open(path);
    QVERIFY(wait_for([&] { return taught.window->banner_text().contains("lost.obj"); }));
    taught.trigger("lesson_next");
    QVERIFY(taught.settles());
    QCOMPARE(QString::fromStdString(taught.window->scene.spec()), QString("furnace"));
  }

  void missing_patches_and_directions_are_reported() {
    Taught taught;
    const QTemporaryDir folder;
    const QString path = folder.filePath("beyond.json");
    write_file(path, R"({"title": "T", "pages": [
      {"text": "", "show": {"scene": "furnace", "options": {"directions": 4}, "select": 99}},
      {"text": "", "show": {"select": 1, "focus": {"direction": 5}}}]})");
    taught.window->files().try_open(path);
    QVERIFY(taught.settles());
    QVERIFY(taught.window->banner_text().contains("no patch 99"));
    taught.trigger("lesson_next");
    QVERIFY(wait_for([&] { return taught.window->banner_text().contains("no direction 5"); }));
  }

  void every_panel_is_described() {
    const QByteArray text =
        contents_of(QStringLiteral(TRANSILLUM_SOURCE "/viewer/LESSON_FORMAT.md"));
    const Taught taught;
    const std::vector<std::string> panels = taught.window->views().docks.panels();
    QVERIFY(panels.size() > 10);
    for (const std::string& panel : panels) {
      QVERIFY2(text.contains(('"' + panel + '"').c_str()), panel.c_str());
    }
  }

  void turning_past_the_last_page_opens_the_next_lesson() {
    Selection selection;
    Focus focus;
    QUndoStack undo;
    MaterialEdits edits(undo);
    LessonPanel panel(built_in_lessons(), selection, focus, edits);
    panel.show();
    const auto at = [&panel] { return std::pair(panel.lesson(), panel.page()); };
    const auto* next = panel.findChild<QAction*>("lesson_next");
    auto* previous = panel.findChild<QAction*>("lesson_previous");
    const int last = static_cast<int>(panel.lessons().front().pages.size()) - 1;
    panel.show_page(0, last);
    panel.findChild<QAction*>("lesson_next")->trigger();
    QCOMPARE(at(), std::pair(1, 0));
    previous->trigger();
    QCOMPARE(at(), std::pair(0, last));
    const int lessons = static_cast<int>(panel.lessons().size());
    const int end = static_cast<int>(panel.lessons().back().pages.size()) - 1;
    panel.show_page(lessons - 1, end);
    QVERIFY(!next->isEnabled());
    // The list of lessons does not handle these keys.
    for (const int key : {Qt::Key_PageDown, Qt::Key_PageUp}) {
      panel.show_page(key == Qt::Key_PageUp ? 0 : lessons - 1, key == Qt::Key_PageUp ? 0 : end);
      const auto before = at();
      QTest::keyClick(panel.findChild<QComboBox*>("lesson_list"), static_cast<Qt::Key>(key));
      QCOMPARE(at(), before);
    }
  }

  void opening_a_scene_resets_what_a_lesson_set() {
    Taught taught;
    TestWindow& window = *taught.window;
    window.colors.set_logarithmic(true);
    window.files().open_lesson("2", 3);
    QVERIFY(taught.settles());
    QVERIFY(window.views().map.labels_shown() && !taught.focus().following());
    // The lesson's scene and another one, each after the exposure was fixed.
    for (const std::string& scene : {window.scene.spec(), std::string("furnace")}) {
      window.colors.set_exposure(-3);
      window.findChild<SceneView*>()->view_from_side(Side::top);
      const auto before = window.snapshot()->loaded;
      window.files().open_scene(QString::fromStdString(scene));
      QVERIFY(wait_for([&] { return window.snapshot() && window.snapshot()->loaded != before; }));
      QVERIFY(taught.settles());
      QCOMPARE(window.scene.spec(), scene);
      QCOMPARE(window.snapshot()->options.directions, 32);
      QVERIFY(taught.focus().following());
      QVERIFY(window.colors.exposure_is_automatic() && window.colors.scale().logarithmic);
      QVERIFY(!window.views().map.labels_shown());
      auto* view = window.findChild<SceneView*>();
      const ViewPoint shown = view->view_point();
      window.findChild<SceneView*>()->reset_view();
      QVERIFY(view->view_point() == shown);
    }
  }

  void the_first_page_shows_what_was_read_and_continues_there() {
    const QTemporaryDir folder;
    QSettings settings(folder.filePath("settings.ini"), QSettings::IniFormat);
    Taught taught;
    taught.panel->show_page(0, 2);
    taught.panel->show_page(0, 1);
    QVERIFY(taught.settles());
    QCOMPARE(taught.panel->pages_seen(0), 3);
    QCOMPARE(taught.panel->pages_seen(1), 0);
    taught.trigger("start");
    auto* card = taught.window->findChild<QAbstractButton*>("lesson_1");
    // The bar is as long as three pages of five.
    const QImage picture = card->grab().toImage();
    const auto is_bar = [&picture](double place) {
      return picture.pixelColor(static_cast<int>(place * picture.width()), picture.height() - 3) ==
             theme::accent;
    };
    QVERIFY(is_bar(0.55) && !is_bar(0.65));
    save_picture(*taught.window, "lessons-read");
    card->click();
    QVERIFY(taught.settles());
    QCOMPARE(taught.panel->page(), 2);
    taught.panel->save(settings);

    // The next window continues there; a lesson that has been read begins again.
    Taught later;
    later.panel->load(settings);
    QCOMPARE(later.panel->pages_seen(0), 3);
    later.panel->continue_lesson(0);
    QCOMPARE(later.panel->page(), 2);
    later.panel->show_page(0, static_cast<int>(later.panel->lessons()[0].pages.size()) - 1);
    later.panel->continue_lesson(0);
    QCOMPARE(later.panel->page(), 0);
  }

  void a_lesson_tells_on_its_first_page_what_it_needs() {
    const Opened taught(R"({"title": "T", "minutes": 7, "needs": "paper", "pages": [
        {"text": "One.", "show": {"scene": "furnace", "options": {"directions": 4}}},
        {"text": "Two."}]})");
    QVERIFY(taught.ready);
    const auto* text = taught.window->findChild<QTextBrowser*>("lesson_text");
    QVERIFY2(text->toPlainText().contains("needs paper"), qPrintable(text->toPlainText()));
    taught.trigger("lesson_next");
    QCOMPARE(text->toPlainText(), QString("Two."));
  }

  void turning_pages_quickly_ends_with_the_last() {
    Taught taught;
    QVERIFY(!taught.panel->lessons().empty());
    const auto& first = taught.panel->lessons().front();
    for (int page = 0; page < static_cast<int>(first.pages.size()); ++page) {
      taught.panel->show_page(0, page);
    }
    QVERIFY(taught.settles());
    const ViewState& last = first.pages.back().state;
    QCOMPARE(taught.window->scene.spec(), last.scene);
    QCOMPARE(taught.window->selection.patch(), last.selection);
  }

  void every_built_in_page_can_be_shown_data() {
    QTest::addColumn<int>("lesson");
    for (int k = 0; k < static_cast<int>(built_in_lessons().size()); ++k) {
      QTest::newRow(at(built_in_lessons(), k).title.c_str()) << k;
    }
  }
  void every_built_in_page_can_be_shown() {
    QFETCH(int, lesson);
    Taught taught;
    check_panels(at(built_in_lessons(), lesson), "lesson", taught.window->views().docks.panels());
    const auto& pages = at(built_in_lessons(), lesson).pages;
    for (int k = 0; k < static_cast<int>(pages.size()); ++k) {
      // Few directions, to save time: what is checked here does not depend on their number.
      ViewState state = at(pages, k).state;
      state.options.solve.directions =
          std::max(state.focus ? state.focus->direction + 1 : 4, state.options.solve.replicas);
      state.options.solve.iterations = state.focus ? state.focus->iteration + 1 : 1;
      taught.window->findChild<ViewStateApplier*>()->show(state);
      QVERIFY2(taught.settles(), qPrintable(QString("page %1").arg(k + 1)));
      QCOMPARE(taught.window->banner_text(), QString());
      QVERIFY2(taught.panel->isVisible(), qPrintable(QString("page %1 hides its text").arg(k + 1)));
      QCOMPARE(taught.window->selection.patch(), state.selection);
      QCOMPARE(!taught.focus().following(), state.focus.has_value());
      if (state.focus) {
        QCOMPARE(taught.focus().position().direction, state.focus->direction);
      }
      QVERIFY(!at(pages, k).text.empty());
    }
  }
};

const test::Registered registered("lessons", test::run_as_viewer<LessonsTest>);

}  // namespace transillum::viewer::lessons_test

#include "lessons_test.moc"
