// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "colors/kept_run_label.h"

#include <QVBoxLayout>

#include "widgets/theme.h"

namespace transillum::viewer {

KeptRunLabel::KeptRunLabel(const ColorChoice& colors, QWidget* canvas)
    : QLabel(tr("Kept run A, while the key is held"), canvas) {
  setObjectName("kept_run_label");
  setAttribute(Qt::WA_TransparentForMouseEvents);
  QPalette surroundings = palette();
  surroundings.setColor(QPalette::Window, theme::scene_background.lighter(140));
  surroundings.setColor(QPalette::WindowText, theme::on_dark);
  setPalette(surroundings);
  setAutoFillBackground(true);
  setMargin(5);
  auto* over = new QVBoxLayout(canvas);
  over->addWidget(this, 0, Qt::AlignHCenter | Qt::AlignTop);
  connect(&colors, &ColorChoice::changed, this,
          [this, &colors] { setVisible(colors.shows_kept_run()); });
  hide();
}

}  // namespace transillum::viewer
