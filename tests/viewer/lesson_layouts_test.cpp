// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Every page of every built-in lesson, in the layout to teach and on a projector, on a small and a
// large screen: the panels that the page needs are shown, its text can be read, and its question
// can be answered. Solves are not waited for: sizes do not depend on them.
#include <QDockWidget>
#include <QFontInfo>
#include <QLineEdit>
#include <QRadioButton>
#include <QScreen>
#include <QScrollBar>
#include <QTextBrowser>

#include "lessons/control_widget.h"
#include "lessons/lesson_panel.h"
#include "lessons/question_box.h"
#include "screen_checks.h"
#include "transillum/at.h"
#include "window_support.h"

namespace transillum::viewer::lesson_layouts_test {

using namespace test;

namespace {

/// A window of a fixed size that shows a page.
struct Room {
  std::unique_ptr<TestWindow> window = make_window();
  LessonPanel& panel = window->views().lessons;
  QTextBrowser* text = window->findChild<QTextBrowser*>("lesson_text");
  QuestionBox* question = &panel.question();
  QStringList faults;

  const Lesson::Page& page() const {
    return at(at(panel.lessons(), panel.lesson()).pages, panel.page());
  }
  void require(bool holds, const QString& fault) {
    if (!holds) {
      faults << fault;
    }
  }
  /// Whether a view has room enough to show something.
  static bool shows(const QWidget* view) {
    constexpr int least = 150;
    return view && view->isVisible() && view->width() >= least && view->height() >= least &&
           view->window()->rect().contains({view->mapTo(view->window(), {}), view->size()});
  }

  /// On a projector, a view that is large has only the scene beside it.
  void check_panels(bool projects) {
    const std::string& large = page().large;
    std::vector<std::string> panels{"lesson"};
    if (!large.empty() && large != "scene") {
      panels.push_back(large);
    }
    if (large.empty() || !projects) {
      panels.insert(panels.end(), page().state.panels.begin(), page().state.panels.end());
    }
    require(!projects || shows(window->findChild<SceneView*>()), "the scene is hidden");
    for (const std::string& name : panels) {
      const auto* dock =
          window->findChild<QDockWidget*>(QString::fromStdString(name) + QStringLiteral("_dock"));
      const bool thin = name == "timeline";
      require(thin ? is_whole(*dock) : shows(dock->widget()),
              QString("%1 %2 x %3").arg(name.c_str()).arg(dock->width()).arg(dock->height()));
    }
  }
  void check_text() {
    constexpr int least_lines = 3;
    // A slanted letter at the end of a line may reach into the margin.
    require(text->horizontalScrollBar()->maximum() <= text->document()->documentMargin(),
            "text is cut at the side");
    require(text->viewport()->height() >= least_lines * text->fontMetrics().lineSpacing(),
            QString("text has %1 px").arg(text->viewport()->height()));
    for (const auto* label : panel.findChildren<QLabel*>()) {
      const bool wraps = label->isVisible() && label->wordWrap();
      require(!wraps || label->height() >= label->heightForWidth(label->width()),
              label->objectName() + " is cut");
    }
    for (const auto* control : panel.findChildren<ControlWidget*>()) {
      require(control->geometry().left() >= 0 &&
                  control->geometry().right() < text->viewport()->width(),
              control->objectName() + " is cut");
    }
    faults << cut_buttons(panel) << cut_texts(panel) << cut_texts(window->views().map);
  }
  void check_question() {
    if (!page().question) {
      return;
    }
    const auto usable = [](const QWidget* widget) {
      return widget && is_whole(*widget) && widget->isEnabled() &&
             widget->width() >= widget->minimumSizeHint().width();
    };
    const auto all = question->findChildren<QRadioButton*>();
    switch (page().question->kind) {
      case Question::Kind::choice:
        require(all.size() == std::ssize(page().question->choices), "choices are missing");
        require(std::all_of(all.begin(), all.end(), usable), "a choice is cut");
        break;
      case Question::Kind::patch:
        require(shows(window->findChild<SceneView*>()) || shows(window->views().map.canvas()),
                "no patch can be clicked");
        break;
      case Question::Kind::number:
        require(usable(question->findChild<QLineEdit*>()), "the number is cut");
        break;
      case Question::Kind::area:
        require(shows(window->views().map.canvas()), "the map cannot be clicked");
        break;
      case Question::Kind::outline:
        require(shows(window->findChild<SceneView*>()), "the scene cannot be clicked");
        break;
      case Question::Kind::curve:
        require(usable(question->findChild<QWidget*>("question_chart")), "the chart is cut");
        break;
    }
    for (const auto* button : question->findChildren<QToolButton*>()) {
      const bool reveals = button->defaultAction() == question->actions().front();
      require(!reveals || usable(button), "the answer cannot be revealed");
    }
  }
  /// A projected page is not scrolled, and on a large screen its type is 28 px of 1080 lines; so is
  /// the question's.
  void check_projected(const QSize& screen) {
    require(text->verticalScrollBar()->maximum() == 0, "text has to be scrolled");
    const double lines = std::min(QGuiApplication::primaryScreen()->size().height(), 1080);
    const int type = QFontInfo(text->font()).pixelSize();
    require(screen.height() < lines || type >= 0.9 * 28 * lines / 1080,
            QString("type of %1 px").arg(type));
    for (const auto* label : question->findChildren<QLabel*>()) {
      const bool is_text = label->wordWrap() && label->objectName() != "question_counts";
      require(screen.height() < lines || !is_text || QFontInfo(label->font()).pixelSize() >= type,
              QString("question of %1 px").arg(QFontInfo(label->font()).pixelSize()));
    }
  }
  QStringList faults_of(const QSize& screen, bool projects) {
    faults.clear();
    const QSize least = window->minimumSizeHint();
    require(least.boundedTo(screen) == least,
            QString("needs %1 x %2").arg(least.width()).arg(least.height()));
    check_panels(projects);
    check_text();
    check_question();
    if (projects) {
      check_projected(screen);
    }
    return faults;
  }
};

}  // namespace

class LessonLayoutsTest : public QObject {
  Q_OBJECT

 private slots:
  void each_page_shows_what_it_needs_data() {
    QTest::addColumn<QSize>("screen");
    QTest::addColumn<bool>("projects");
    const QSize frame(16, 48);
    for (const QSize& screen : {QSize(1280, 720), QSize(1920, 1080)}) {
      QTest::addRow("layout, %d lines", screen.height()) << screen - frame << false;
      QTest::addRow("projector, %d lines", screen.height()) << screen << true;
    }
  }
  void each_page_shows_what_it_needs() {
    QFETCH(QSize, screen);
    QFETCH(bool, projects);
    Room room;
    room.window->setFixedSize(screen);
    room.panel.show_page(0, 0);
    auto* projector = room.window->findChild<QAction*>("projector");
    projector->setChecked(projects);
    QStringList found;
    for (int lesson = 0; lesson < std::ssize(room.panel.lessons()); ++lesson) {
      for (int page = 0; page < std::ssize(at(room.panel.lessons(), lesson).pages); ++page) {
        room.panel.show_page(lesson, page);
        int checks = 0;  // in a row: layouts are queued
        const auto fits = [&] {
          checks = room.faults_of(screen, projects).isEmpty() ? checks + 1 : 0;
          return checks == 3;
        };
        const QString name = QString("%1.%2").arg(lesson + 1).arg(page + 1);
        if (!wait_for(fits, 10000)) {
          found << name + ": " + room.faults.join(", ");
        }
        save_picture(*room.window,
                     QString("page-%1-%2-%3").arg(name).arg(screen.height()).arg(projects));
      }
    }
    projector->setChecked(false);
    QVERIFY2(found.isEmpty(), qPrintable('\n' + found.join('\n')));
  }
};

const test::Registered registered("lesson_layouts", test::run_as_viewer<LessonLayoutsTest>);

}  // namespace transillum::viewer::lesson_layouts_test

#include "lesson_layouts_test.moc"
