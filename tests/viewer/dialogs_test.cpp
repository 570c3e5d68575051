// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Dialogs and panels on the screen of a projector, and what they say: why a button is disabled, and
// what a setting means.
#include <QAbstractSpinBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QRegularExpression>
#include <QTabBar>
#include <QTemporaryDir>
#include <QTextBrowser>
#include <QTextDocument>

#include "lessons/lesson_panel.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "screen_checks.h"
#include "solved_window.h"
#include "transillum/files.h"
#include "widgets/fold.h"

namespace transillum::viewer::dialogs_test {

using namespace test;

namespace {

using Examine = std::function<void(QDialog&)>;

QAction* action_with_text(const QWidget& window, const QString& text) {
  for (QAction* action : window.findChildren<QAction*>()) {
    if (action->text().remove('&') == text) {
      return action;
    }
  }
  return nullptr;
}

/// The disabled actions of a window that do not say why.
QStringList silent_actions(const QWidget& window) {
  QStringList silent;
  for (const auto* action : window.findChildren<QAction*>()) {
    const QString why = action->property("why_disabled").toString();
    const bool asks = !action->isEnabled() && action->isVisible() && !action->text().isEmpty();
    if (asks && !action->isSeparator() && (why.isEmpty() || !action->toolTip().endsWith(why))) {
      silent << action->objectName() + ' ' + action->text();
    }
  }
  return silent;
}

/// Opens a dialog, which may have an event loop of its own, examines and closes it.
/// @returns whether one was opened
bool examine_dialog(QAction& opening, const Examine& examine) {
  bool found = false;
  QTimer poll;
  QObject::connect(&poll, &QTimer::timeout, &poll, [&] {
    for (QWidget* top : QApplication::topLevelWidgets()) {
      auto* dialog = qobject_cast<QDialog*>(top);
      if (dialog && dialog->isVisible()) {
        poll.stop();
        examine(*dialog);
        found = true;
        dialog->close();
        return;
      }
    }
  });
  poll.start(10);
  opening.trigger();
  return wait_for([&found] { return found; });
}

/// The control by which a button is disabled: itself, its action, or a widget around it.
const QObject* disabled_by(const QAbstractButton& button) {
  if (const auto* tool = qobject_cast<const QToolButton*>(&button)) {
    if (tool->defaultAction() && !tool->defaultAction()->isEnabled()) {
      return tool->defaultAction();
    }
  }
  for (const QWidget* widget = &button; widget; widget = widget->parentWidget()) {
    if (widget->testAttribute(Qt::WA_ForceDisabled)) {
      return widget;
    }
  }
  return &button;
}

/// The disabled buttons on the screen that do not say why.
/// @param disabled  is increased by the number of disabled buttons
QStringList silent_buttons(const QWidget& window, int& disabled) {
  QStringList silent;
  for (const auto* button : window.findChildren<QAbstractButton*>()) {
    if (!is_on_screen(*button) || button->isEnabled() ||
        qobject_cast<const QTabBar*>(button->parentWidget())) {
      continue;
    }
    ++disabled;
    if (qobject_cast<const FoldHeader*>(button) && button->toolTip().startsWith("none")) {
      continue;  // the state of the section is the reason
    }
    const QObject* cause = disabled_by(*button);
    const QString why = cause->property("why_disabled").toString();
    const QString tip = cause->property("toolTip").toString();
    if (why.isEmpty() || !tip.endsWith(why)) {
      silent << button->objectName() + ' ' + button->text();
    }
  }
  return silent;
}

QString plain_tip(const QWidget& widget) {
  QTextDocument text;
  if (Qt::mightBeRichText(widget.toolTip())) {
    text.setHtml(widget.toolTip());
  } else {
    text.setPlainText(widget.toolTip());
  }
  return text.toPlainText().trimmed();
}

/// Whether a value without a unit is meant: a number of things, or a text.
bool is_without_unit(const QString& label) {
  static const QStringList names{"Quality", "Patches",      "Passes",  "Seed",
                                 "Stop at", "Most patches", "Replicas"};
  return names.contains(label);
}

}  // namespace

class DialogsTest : public QObject {
  Q_OBJECT

 private slots:
  void disabled_actions_say_why() {
    const auto window = make_window(8);
    const auto silent = [&window] { return silent_actions(*window).join('\n'); };
    QCOMPARE(silent(), QString());
    for (const auto* menu : window->findChildren<QMenu*>()) {
      const auto actions = menu->actions();
      const bool says = menu->toolTipsVisible() ||
                        std::all_of(actions.begin(), actions.end(),
                                    [](const QAction* action) { return action->isEnabled(); });
      QVERIFY2(says, qPrintable(menu->title()));
    }
    window->open("cornell-box", {Goal::Kind::finished});
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }));
    QCOMPARE(silent(), QString());
    window->focus.go_to({0, 1, 3});
    window->selection.select(4);
    QVERIFY(wait_for([&] { return window->settled(); }));
    QCOMPARE(silent(), QString());
    window->views().lessons.show_page(0, 0);
    QVERIFY(wait_for([&] { return window->settled(); }));
    QCOMPARE(silent(), QString());
  }

  void every_dialog_fits_a_small_screen_data() {
    QTest::addColumn<QString>("opening");
    QTest::addColumn<bool>("is_resizable");
    for (const char* name : {"Study…", "Save session…", "Save scene…", "Result…", "Keys and mouse",
                             "Export for Blender or the web…", "All settings", "Visibility map…",
                             "Find a command…", "Convergence charts…", "Open…", "User guide"}) {
      QTest::newRow(name) << QString::fromUtf8(name) << true;
    }
    for (const char* name :
         {"About transillum", "Save figure…", "Save film…", "Units and orientation…"}) {
      QTest::newRow(name) << QString::fromUtf8(name) << false;
    }
  }
  void every_dialog_fits_a_small_screen() {
    QFETCH(QString, opening);
    QFETCH(bool, is_resizable);
    const QTemporaryDir folder;
    const QString file = folder.filePath("furnace.obj");
    write_obj(file.toStdString(), describe_scene("furnace"));
    const SolvedWindow solved(file, {.directions = 8, .first_shot = {}});
    QVERIFY(solved.ready);
    solved.window->resize(small_screen);
    handle_posted();
    QAction* action = action_with_text(*solved.window, opening);
    QVERIFY(action && action->isEnabled());
    QVERIFY(examine_dialog(*action, [&](QDialog& dialog) {
      if (is_resizable) {
        dialog.resize(dialog.size().boundedTo(small_screen));
      }
      const auto fits = [&dialog] {
        return dialog.size().boundedTo(small_screen) == dialog.size();
      };
      QVERIFY2(wait_for(fits, 5000),
               qPrintable(QStringLiteral("%1 x %2").arg(dialog.width()).arg(dialog.height())));
      QCOMPARE(cut_buttons(dialog), QStringList());
      QCOMPARE(cut_texts(dialog), QStringList());
      save_picture(dialog, "dialog-" + opening.section(' ', 0, 0).remove(QChar(0x2026)));
    }));
  }

  void the_guide_has_all_its_pages() {
    const auto window = make_window();
    QAction* guide = action_with_text(*window, "User guide");
    QVERIFY(guide && examine_dialog(*guide, [](QDialog& dialog) {
              auto* browser = dialog.findChild<QTextBrowser*>();
              const QString index = browser->toPlainText();
              QVERIFY(index.contains("11 Export") && !index.contains("](") &&
                      !index.contains("!["));
              for (const char* page : {"guide/03-scenes.md", "04-solving.md", "../USER_GUIDE.md",
                                       "../libtransillum/GLOSSARY.md"}) {
                const QString before = browser->toPlainText();
                emit browser->anchorClicked(QUrl(QString(page)));
                QVERIFY2(browser->toPlainText() != before, page);
              }
            }));
  }

  void every_panel_fits_a_small_screen() {
    const SolvedWindow solved("cornell-box");
    QVERIFY(solved.ready);
    solved.window->resize(small_screen);
    for (const char* layout : {"layout_teach", "layout_inspect", "layout_debug"}) {
      solved.trigger(layout);
      for (const std::string& panel : solved.window->views().docks.panels()) {
        solved.window->views().docks.bring_to_front(panel);
        QVERIFY(comes_to_rest(*solved.window));
        const auto* dock =
            solved.window->findChild<QWidget*>(QString::fromStdString(panel + "_dock"));
        const QStringList cut = cut_buttons(*dock);
        QVERIFY2(cut.isEmpty(), qPrintable(layout + (": " + dock->objectName()) + cut.join("; ")));
      }
    }
  }

  void disabled_buttons_say_why() {
    const auto window = make_window(8);
    window->resize(large_screen);
    int disabled = 0;
    const auto examine = [&](const char* state) {
      for (const std::string& panel : window->views().docks.panels()) {
        window->views().docks.bring_to_front(panel);
        handle_posted();
        const QStringList silent = silent_buttons(*window, disabled);
        QVERIFY2(
            silent.isEmpty(),
            qPrintable(QStringLiteral("%1, %2: %3").arg(state, panel.c_str(), silent.join("; "))));
      }
    };
    examine("no scene");
    QVERIFY(disabled > 20);
    window->open("cornell-box", {Goal::Kind::direction});
    QVERIFY(comes_to_rest(*window));
    examine("paused");
    window->runner.run();
    QVERIFY(wait_for([&] { return window->runner.state() == RunState::finished; }) &&
            comes_to_rest(*window));
    for (const char* layout : {"layout_debug", "layout_inspect", "layout_teach"}) {
      window->findChild<QAction*>(layout)->trigger();
      examine(layout);
    }
  }

  // In the panel of settings, whatever is chosen in it.
  void labels_have_units_and_tips_of_one_sentence() {
    const SolvedWindow solved("gallery", {.directions = 8});
    QVERIFY(solved.ready);
    auto* panel = solved.window->findChild<SettingsPanel*>();
    for (auto* header : panel->findChildren<FoldHeader*>()) {
      header->setChecked(true);
    }
    static const QRegularExpression further_sentence(R"([.!?]\s+[A-Z])");
    int labels = 0;
    auto* engine = panel->findChild<QComboBox*>("engine");
    const auto examine = [&] {
      for (const auto* label : panel->findChildren<QLabel*>()) {
        const QWidget* field = label->buddy();
        if (!field || !label->isVisibleTo(panel)) {
          continue;
        }
        const QString tip = plain_tip(*label);
        QVERIFY2(tip.size() > 12, qPrintable(label->text()));
        QVERIFY2(!tip.section('\n', 0, 0).contains(further_sentence), qPrintable(tip));
        const bool is_number = field->inherits("QAbstractSpinBox") || field->inherits("QLineEdit");
        QVERIFY2(!is_number || label->text().contains(", ") || is_without_unit(label->text()),
                 qPrintable(label->text()));
        ++labels;
      }
    };
    for (int k = 0; k < engine->count(); ++k) {
      engine->setCurrentIndex(k);
      examine();
    }
    panel->findChild<QAbstractButton*>("normal")->click();
    panel->findChild<QComboBox*>("refine_by")->setCurrentIndex(1);
    panel->findChild<QComboBox*>("sampling")->setCurrentText("Random");
    examine();
    QVERIFY(labels > 100);
  }
};

const test::Registered registered("dialogs", test::run_as_viewer<DialogsTest>);

}  // namespace transillum::viewer::dialogs_test

#include "dialogs_test.moc"
