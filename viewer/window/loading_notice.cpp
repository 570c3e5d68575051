// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/loading_notice.h"

#include <QFileInfo>
#include <QMainWindow>
#include <QPushButton>

#include "scene/scene_page.h"
#include "widgets/banner.h"

namespace transillum::viewer {

namespace {

constexpr int delay_ms = 200;

}  // namespace

LoadingNotice::LoadingNotice(const WindowFrame& frame) : QObject(&frame.window), frame_(frame) {
  delay_.setSingleShot(true);
  delay_.setInterval(delay_ms);
  QPushButton* cancel = frame_.page.loading_bar()->add_button("cancel_loading", tr("Cancel"));
  cancel->setToolTip(tr("Stop loading and keep the open scene (Esc)"));
  connect(cancel, &QPushButton::clicked, &frame_.state.runner, &SolveRunner::stop);
  connect(frame_.page.loading_bar(), &Banner::closed, &frame_.state.runner, &SolveRunner::stop);
  connect(&delay_, &QTimer::timeout, this, &LoadingNotice::show);
  connect(&frame_.state.runner, &SolveRunner::state_changed, this, &LoadingNotice::show_state);
  connect(&frame_.state.runner, &SolveRunner::load_progressed, this,
          [this](const QString& phase, double share) {
            phase_ = phase;
            share_ = share;
            if (!title_before_.isEmpty()) {
              show();
            }
          });
}

void LoadingNotice::show_state(RunState state) {
  if (state == RunState::loading) {
    delay_.start();
    return;
  }
  delay_.stop();
  frame_.page.loading_bar()->dismiss();
  frame_.page.set_loading({});
  // Otherwise the new scene has set it.
  if (!title_before_.isEmpty() && frame_.window.windowTitle() == loading_title_) {
    frame_.window.setWindowTitle(title_before_);
  }
  title_before_.clear();
}

void LoadingNotice::show() {
  const QString name =
      QFileInfo(QString::fromStdString(frame_.state.scene.requested_spec())).fileName();
  if (title_before_.isEmpty()) {
    title_before_ = frame_.window.windowTitle();
    loading_title_ = tr("Loading %1 – transillum").arg(name);
    frame_.window.setWindowTitle(loading_title_);
    frame_.page.set_loading(name);
  }
  const QString text =
      share_ < 0 ? phase_
                 : tr("%1: %2 %").arg(phase_, QString::number(static_cast<int>(100 * share_)));
  frame_.page.loading_bar()->show_message(Banner::Kind::offer, text);
}

}  // namespace transillum::viewer
