// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "support/checked_bytes.h"

#include <QCryptographicHash>

namespace transillum::viewer {

namespace {

// To be changed with the format: version, checksum, bytes.
const QByteArray version = QByteArrayLiteral("transillum-1:");

QByteArray checksum_of(const QByteArray& bytes) {
  return QCryptographicHash::hash(bytes, QCryptographicHash::Sha256);
}

}  // namespace

QByteArray with_checksum(const QByteArray& bytes) { return version + checksum_of(bytes) + bytes; }

std::optional<QByteArray> without_checksum(const QByteArray& checked) {
  if (!checked.startsWith(version)) {
    return std::nullopt;
  }
  const int begin =
      static_cast<int>(version.size()) + QCryptographicHash::hashLength(QCryptographicHash::Sha256);
  QByteArray bytes = checked.mid(begin);
  if (checked.left(begin) != version + checksum_of(bytes)) {
    return std::nullopt;
  }
  return bytes;
}

}  // namespace transillum::viewer
