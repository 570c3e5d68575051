// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The first five minutes of a teacher with the screen of a projector, by mouse and keys alone.
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QTextBrowser>
#include <QToolButton>

#include "lessons/lesson_panel.h"
#include "lessons/question_box.h"
#include "scene/start_page.h"
#include "solved_window.h"

namespace transillum::viewer::first_minutes_test {

using namespace test;

namespace {

constexpr QSize small_screen(1280 - 16, 720 - 48);  // less the frame of a window

/// Whether a widget is on the screen as a whole, not cut off by the window or by a column.
bool is_whole(const QWidget& widget) {
  return widget.isVisible() && widget.visibleRegion().boundingRect() == widget.rect();
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
  void a_teacher_begins_with_a_lesson_on_a_projector() {
    const auto window = make_window(64);
    window->resize(small_screen);
    QApplication::setActiveWindow(window.get());
    handle_posted();
    // The first page: all of it fits the width, and nothing is solved.
    const auto* start = window->findChild<StartPage*>();
    QVERIFY(start->isVisible() && !window->scene.is_opening() && !window->scene.loaded());
    auto* teach = start->findChild<QAbstractButton*>("choose_layout_teach");
    QVERIFY(is_whole(*teach));
    for (const char* card : {"built_in_cornell-box", "built_in_flatland", "lesson_1", "lesson_4"}) {
      QVERIFY2(is_whole(*start->findChild<QWidget*>(card)), card);
    }
    save_picture(*window, "minutes-1-start");

    QTest::mouseClick(teach, Qt::LeftButton);
    QVERIFY(wait_for([&] { return window->snapshot() != nullptr; }) && comes_to_rest(*window));
    const auto* title = window->findChild<QLabel*>("lesson_title");
    QVERIFY(!start->isVisible() && is_whole(*title));
    QCOMPARE(title->text(), QString("One number per patch"));
    QVERIFY(window->size() == small_screen);
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

    QTest::keyClick(QApplication::focusWidget() ? QApplication::focusWidget() : window.get(),
                    Qt::Key_PageDown);
    QVERIFY(comes_to_rest(*window));
    QCOMPARE(title->text(), QString("Light comes from all directions"));
    QVERIFY(window->findChild<QDockWidget*>("direction_dock")->isVisible());
    save_picture(*window, "minutes-4-next");

    QTest::keyClick(window.get(), Qt::Key_P);
    QVERIFY(wait_for([&] { return window->isFullScreen(); }));
    QVERIFY(title->isVisible() && view->isVisible() && theme::scale() >= 1.2);
    QVERIFY(!window->menuBar()->isVisible());
    save_picture(*window, "minutes-5-projector");
    QTest::keyClick(window.get(), Qt::Key_Escape);
    QVERIFY(wait_for([&] { return !window->isFullScreen() && window->menuBar()->isVisible(); }));
    QVERIFY(theme::scale() == 1 && title->isVisible());
    QCOMPARE(title->text(), QString("Light comes from all directions"));
  }
};

const test::Registered registered("first_minutes", test::run_as_viewer<FirstMinutesTest>);

}  // namespace transillum::viewer::first_minutes_test

#include "first_minutes_test.moc"
