// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QColor>
#include <QIcon>

class QApplication;

/// The appearance of the application: one palette and one set of icons for all windows.
namespace transillum::viewer::theme {

/// The user's choice of appearance.
struct Appearance {
  bool dark = false;
  bool projector = false;  ///< larger text (by screen size), thicker lines, more contrast

  friend bool operator==(const Appearance&, const Appearance&) = default;
};

/// Colors that follow the appearance. Main thread only.
inline QColor window, paper, ink, ink_dim, rule, accent, good;
inline QColor warm;          ///< second curve of a chart
inline QColor exchange_ink;  ///< text about light that is exchanged: `inside`, readable on `paper`
inline QColor hover;         ///< under the pointer
inline QColor title;         ///< behind a dock's title
inline QColor finished;      ///< finished part of a lane of the timeline

/// Colors that are the same in every appearance.
inline const QColor on_yellow{0x1b, 0x21, 0x2a};  ///< text on `processed`
inline const QColor selection{0xff, 0x3e,
                              0x9e};  ///< also in icons/*_event.svg; in no scene or color map

/// A step of the visibility map; the colors differ in brightness too.
inline const QColor processed{0xff, 0xe0, 0x4d};   ///< polygon of the step
inline const QColor inside{0xe6, 0x7e, 0x22};      ///< inside list: parts of V covered by it
inline const QColor difference{0x19, 0xe3, 0xff};  ///< pixels that show a wrong patch
inline const QColor outside{0x4f, 0xb3, 0xe8};     ///< outside list: the rest of the cut polygons

inline const QColor region{0xb9, 0x8a, 0xff};  ///< R of a global map

/// The scene has a dark, neutral background, so that colors are judged correctly.
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
  study,
  info,
  clear  ///< like `close`, in the color of text
};
/// An icon that follows the appearance and the screen's resolution, also after it was created.
QIcon icon(Icon which);

/// Factor for line widths and text, at least 1. Any thread.
double scale();
/// `pixels` times scale(), rounded. Any thread.
int scaled(int pixels);

/// Sets style, palette and fonts of the application, at the start or later.
void apply(QApplication& application, const Appearance& appearance = {});
const Appearance& appearance();

}  // namespace transillum::viewer::theme
