// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QByteArray>
#include <optional>

namespace transillum::viewer {

/// Qt restores the state and the geometry of a window from bytes without checking them, and may
/// crash on damaged ones. Hence they are kept with a version and a checksum.
QByteArray with_checksum(const QByteArray& bytes);
/// The bytes passed to with_checksum(); none if `checked` is damaged or of another version.
std::optional<QByteArray> without_checksum(const QByteArray& checked);

}  // namespace transillum::viewer
