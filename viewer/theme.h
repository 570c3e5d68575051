// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QColor>
#include <QIcon>

class QApplication;

/// The window's looks: one palette, one set of icons, used everywhere.
namespace transillum::viewer::theme {

inline const QColor window{0xf4, 0xf5, 0xf7};
inline const QColor paper{0xff, 0xff, 0xff};
inline const QColor ink{0x1b, 0x21, 0x2a};
inline const QColor ink_dim{0x5a, 0x64, 0x72};
inline const QColor rule{0xd3, 0xd8, 0xde};
inline const QColor accent{0x1f, 0x66, 0xc2};
inline const QColor warm{0xd9, 0x5f, 0x02};  ///< second line of a chart
inline const QColor good{0x1a, 0x7f, 0x4b};
inline const QColor selection{0xff, 0x3e, 0x9e};  ///< in no scene and no colour map

/// A step of the visibility map: told apart by brightness too.
inline const QColor processed{0xff, 0xe0, 0x4d};   ///< the polygon of the step
inline const QColor inside{0xe6, 0x7e, 0x22};      ///< what it cut out of V
inline const QColor difference{0x19, 0xe3, 0xff};  ///< where pixels show not what is there
inline const QColor outside{0x4f, 0xb3, 0xe8};     ///< what it left of the same

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
/// Drawn for 1x and 2x screens.
QIcon icon(Icon which);

/// Style, palette and fonts of the whole application.
void apply(QApplication& application);

}  // namespace transillum::viewer::theme
