// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/menus/help_pages.h"

#include <QAction>
#include <QCoreApplication>
#include <QFile>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QRegularExpression>
#include <QTextBrowser>

#include "options/option_table.h"
#include "support/number_text.h"
#include "widgets/dialogs.h"
#include "widgets/markdown.h"
#include "widgets/theme.h"

// The resources of a static library must be initialized explicitly.
static void init_documents() { Q_INIT_RESOURCE(documents); }

namespace transillum::viewer {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("HelpDialogs", text); }

QString file_of(const QUrl& page) { return QLatin1Char(':') + page.path(); }

/// A document in Markdown without its pictures, and without the links to documents that are not
/// part of the program.
QString document_text(const QUrl& page) {
  QFile file(file_of(page));
  if (!file.open(QIODevice::ReadOnly)) {
    return {};
  }
  static const QRegularExpression picture(QStringLiteral("!\\[[^\\]]*\\]\\([^)]*\\)"));
  static const QRegularExpression link(QStringLiteral("\\[([^\\]]*)\\]\\(([^)#]+)[^)]*\\)"));
  QString text = QString::fromUtf8(file.readAll()).remove(picture);
  int from = 0;
  for (auto match = link.match(text); match.hasMatch(); match = link.match(text, from)) {
    const bool leads = QFile::exists(file_of(page.resolved(QUrl(match.captured(2)))));
    from = leads ? match.capturedEnd() : match.capturedStart() + match.capturedLength(1);
    if (!leads) {
      text.replace(match.capturedStart(), match.capturedLength(), match.captured(1));
    }
  }
  return text;
}

}  // namespace

QString setting_page() {
  QString rows;
  for (const Option& setting : options()) {
    const QString name = QString::fromStdString(setting.name);
    rows += QStringLiteral("<tr><td><b>%1</b></td><td>%2</td><td>%3</td><td>%4</td></tr>")
                .arg(setting.in_files ? name : name + '*',
                     capitalized(QString::fromStdString(setting.help)).toHtmlEscaped(),
                     QString::fromStdString(setting.values).toHtmlEscaped(),
                     QString::fromStdString(setting.default_value()).toHtmlEscaped());
  }
  return PageDialog::tr(
             "<h3>Settings of a solve</h3><p>On the command line, put two dashes before the name. "
             "Lessons and sessions use the names as they are; those with an asterisk are for the "
             "command line only.</p>"
             "<table cellpadding=4><tr><th align=left>Name</th><th align=left>Meaning</th>"
             "<th align=left>Value</th><th align=left>Default</th></tr>") +
         rows + QStringLiteral("</table>");
}

namespace {

QString plain(QString text) { return text.remove('&'); }

void add_keys(const QMenu& menu, std::vector<KeyUse>& keys) {
  for (const QAction* action : menu.actions()) {
    if (action->menu()) {
      add_keys(*action->menu(), keys);
      continue;
    }
    QStringList shortcuts;
    for (const QKeySequence& key : action->shortcuts()) {
      shortcuts << key.toString(QKeySequence::NativeText);
    }
    if (!shortcuts.isEmpty()) {
      keys.push_back({shortcuts.join(' '), plain(action->text()), action->isEnabled()});
    }
  }
}

// The uses of the pointer, and the keys that belong to one view; no action has them.
KeySection pointer_section() {
  const auto tr = [](const char* text) { return QMainWindow::tr(text); };
  return {
      tr("Pointer"),
      {{tr("Scene"), tr("drag: rotate; Shift+drag or middle button: pan; wheel: zoom; click: "
                        "select a patch; Ctrl+click: add it, or remove it")},
       {tr("Color bar"), tr("drag: select the patches with values in a range")},
       {tr("Map"), tr("drag: pan; wheel: zoom; double-click: fit; click: select a patch and "
                      "list the patches on its line; right-click: run to a point")},
       {tr("Timeline"), tr("drag: go to a step; Shift+drag: step by step; arrow keys: one step, "
                           "with Ctrl one direction")},
       {tr("Kept runs"), tr("F2 or double-click: rename; Del: remove")},
       {tr("Surfaces"), tr("Return: select the patches of the row; E: make it emit; R: reflect")},
       {tr("Directions"), tr("drag: rotate the sphere; click: go to a direction")}}};
}

QString html(const KeySection& section) {
  QString rows = QStringLiteral("<h3>%1</h3><table cellspacing=0 cellpadding=3>")
                     .arg(section.menu.toHtmlEscaped());
  for (const KeyUse& key : section.keys) {
    rows += QStringLiteral(
                "<tr><td style='white-space: pre'><b>%1</b>&nbsp;&nbsp;</td>"
                "<td style='color: %3'>%2</td></tr>")
                .arg(key.keys.toHtmlEscaped(), key.text.toHtmlEscaped(),
                     (key.enabled ? theme::ink : theme::ink_dim).name());
  }
  return rows + QStringLiteral("</table>");
}

}  // namespace

std::vector<KeySection> keys_of(const QMainWindow& window) {
  std::vector<KeySection> sections;
  for (const QAction* action : window.menuBar()->actions()) {
    if (!action->menu()) {
      continue;
    }
    KeySection section{plain(action->text()), {}};
    add_keys(*action->menu(), section.keys);
    if (!section.keys.empty()) {
      sections.push_back(std::move(section));
    }
  }
  return sections;
}

QString key_page(const QMainWindow& window) {
  std::vector<KeySection> sections = keys_of(window);
  sections.push_back(pointer_section());
  std::size_t rows = 0, placed_rows = 0;
  for (const KeySection& section : sections) {
    rows += section.keys.size() + 2;
  }
  QString columns[2];
  for (const KeySection& section : sections) {
    columns[2 * placed_rows < rows ? 0 : 1] += html(section);
    placed_rows += section.keys.size() + 2;
  }
  return QStringLiteral(
             "<table width='100%'><tr><td width='50%' valign='top'>%1</td>"
             "<td valign='top'>%2</td></tr></table>")
      .arg(columns[0], columns[1]);
}

namespace {

void show_guide(QWidget& parent) {
  init_documents();
  auto* dialog = new PageDialog("guide", tr("User guide"), {}, parent);
  auto* browser = dialog->findChild<QTextBrowser*>();
  browser->setOpenLinks(false);
  const auto show = [browser](const QUrl& page) {
    const QUrl whole = browser->property("page").toUrl().resolved(page);
    const QString text = document_text(whole);
    if (!text.isEmpty()) {
      browser->setProperty("page", whole);
      browser->setMarkdown(text);
      constexpr double margin = 16;
      browser->document()->setDocumentMargin(margin);
      spread_paragraphs(*browser->document());
    }
  };
  QObject::connect(browser, &QTextBrowser::anchorClicked, browser, show);
  show(QUrl(QStringLiteral("qrc:/documents/viewer/USER_GUIDE.md")));
  dialog->show();
}

void show_about(QWidget& parent) {
  QMessageBox::about(
      &parent, tr("About transillum"),
      tr("<p><b>transillum %1</b></p><p>Diffuse light by the transillumination method of "
         "Szirmay-Kalos, Fóris, Neumann and Csébfalvi.</p><p>GPL-3.0-or-later.</p>")
          .arg(QStringLiteral(TRANSILLUM_VERSION)));
}

void show_settings(QWidget& parent) {
  (new PageDialog("settings_page", PageDialog::tr("All settings"), setting_page(), parent))->show();
}

void show_keys(QMainWindow& window) {
  (new PageDialog("keys", QMainWindow::tr("Keys and mouse"), key_page(window), window))->show();
}

}  // namespace

void show_tips_of_menus(const QMainWindow& window) {
  for (QMenu* menu : window.findChildren<QMenu*>()) {
    menu->setToolTipsVisible(true);
  }
}

void add_help_pages(QMenu& menu, QMainWindow& window) {
  const auto add = [&](const QString& text, auto show) {
    return menu.addAction(text, &window, [&window, show] { show(window); });
  };
  add(QMainWindow::tr("User guide"), show_guide);
  add(QMainWindow::tr("Keys and mouse"), show_keys)
      ->setShortcuts({QKeySequence(Qt::Key_Question), QKeySequence(Qt::Key_F1)});
  add(QMainWindow::tr("All settings"), show_settings);
  add(QMainWindow::tr("About transillum"), show_about);
}

}  // namespace transillum::viewer
