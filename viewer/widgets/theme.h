// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QColor>
#include <QIcon>

class QApplication;

/// The window's looks: one palette, one set of icons, used everywhere.
namespace transillum::viewer::theme {

/// How the window may look.
struct Appearance {
  bool dark = false;
  bool projector = false;  ///< larger type, by the screen's size, thicker lines, more contrast

  friend bool operator==(const Appearance&, const Appearance&) = default;
};

/// These follow the appearance; the thread of the window may read them.
inline QColor window, paper, ink, ink_dim, rule, accent, good;
inline QColor warm;   ///< second line of a chart
inline QColor hover;  ///< under the pointer
inline QColor title;  ///< behind a dock's title

/// The others are the same in each appearance.
inline const QColor on_yellow{0x1b, 0x21, 0x2a};  ///< text on `processed`
inline const QColor selection{0xff, 0x3e, 0x9e};  ///< in no scene and no color map

/// A step of the visibility map: told apart by brightness too.
inline const QColor processed{0xff, 0xe0, 0x4d};   ///< the polygon of the step
inline const QColor inside{0xe6, 0x7e, 0x22};      ///< what it cut out of V
inline const QColor difference{0x19, 0xe3, 0xff};  ///< where pixels show not what is there
inline const QColor outside{0x4f, 0xb3, 0xe8};     ///< what it left of the same

inline const QColor region{0xb9, 0x8a, 0xff};  ///< R of a global map

/// Light is looked at before a dark, neutral ground.
inline const QColor scene_background{0x1d, 0x21, 0x27};
inline const QColor on_dark{0xec, 0xef, 0xf3};
inline const QColor on_dark_dim{0xa4, 0xad, 0xb8};

enum class Icon {
  open,
  run,
  pause,
  one_direction,
  one_iteration,
  stop,
  frame,
  warning,
  error,
  close,
  scene,
  step_on,
  step_back,
  phase_on,
  next_event,
  previous_event,
  next_exchange,
  previous_exchange,
  next_direction,
  previous_direction,
  newest,
  study
};
/// Drawn in the size and the colors that are wanted, whenever it is.
QIcon icon(Icon which);

/// What lines are thicker and type is larger by; any thread.
double scale();
/// So many pixels, larger by that.
int scaled(int pixels);

/// Style, palette and fonts of the whole application, at its start or later.
void apply(QApplication& application, const Appearance& appearance = {});
const Appearance& appearance();

}  // namespace transillum::viewer::theme
