// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "colors/kept_run_label.h"

#include <QVBoxLayout>

#include "transillum/at.h"

namespace transillum::viewer {

KeptRunLabel::KeptRunLabel(const ColorChoice& colors, QWidget* canvas) : Plate(canvas) {
  setObjectName("kept_run_label");
  auto* over = new QVBoxLayout(canvas);
  over->addWidget(this, 0, Qt::AlignHCenter | Qt::AlignTop);
  connect(&colors, &ColorChoice::changed, this, [this, &colors] {
    setVisible(colors.shows_kept_run());
    if (colors.shows_kept_run()) {
      const KeptRun& run = at(colors.kept_runs().all(), colors.kept_runs().first());
      setText(tr("A: %1, while the key is held").arg(run.name));
    }
  });
}

}  // namespace transillum::viewer
