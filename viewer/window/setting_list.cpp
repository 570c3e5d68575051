// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/setting_list.h"

#include "options/option_table.h"
#include "support/number_text.h"
#include "widgets/page_dialog.h"

namespace transillum::viewer {

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

void show_settings(QWidget& parent) {
  (new PageDialog("settings_page", PageDialog::tr("Settings"), setting_page(), parent))->show();
}

}  // namespace transillum::viewer
