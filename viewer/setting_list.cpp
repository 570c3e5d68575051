// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "setting_list.h"

#include <nlohmann/json.hpp>

#include "page_dialog.h"
#include "run_options.h"

namespace transillum::viewer {

namespace {

QString default_of(const nlohmann::json& value) {
  if (value.is_null()) return QStringLiteral("none");
  if (value.is_boolean()) return value.get<bool>() ? QStringLiteral("yes") : QStringLiteral("no");
  return QString::fromStdString(value.is_string() ? value.get<std::string>() : value.dump());
}

}  // namespace

QString setting_page() {
  const nlohmann::json defaults = to_json(RunOptions{});
  QString rows;
  for (const Setting& setting : settings())
    rows += QStringLiteral("<tr><td><b>%1</b></td><td>%2</td><td>%3</td><td>%4</td></tr>")
                .arg(setting.name, QString::fromUtf8(setting.sentence).toHtmlEscaped(),
                     QString::fromUtf8(setting.type).toHtmlEscaped(),
                     default_of(defaults.at(setting.name)).toHtmlEscaped());
  return PageDialog::tr(
             "<h3>Settings of a solve</h3><p>The command line has them with two dashes, "
             "lessons and sessions as they stand here.</p>"
             "<table cellpadding=4><tr><th align=left>name</th><th align=left>what it "
             "does</th><th align=left>value</th><th align=left>default</th></tr>") +
         rows + QStringLiteral("</table>");
}

void show_settings(QWidget& parent) {
  (new PageDialog("settings_page", PageDialog::tr("Settings"), setting_page(), parent))->show();
}

}  // namespace transillum::viewer
