// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "support/failure_text.h"

#include <QCoreApplication>
#include <exception>
#include <new>

namespace transillum::viewer {

QString current_failure_text() {
  const auto tr = [](const char* text) { return QCoreApplication::translate("Failure", text); };
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return tr("Not enough memory");
  } catch (const std::exception& error) {
    const QString text = QString::fromUtf8(error.what());
    return text.isEmpty() ? tr("Unknown error") : text;
  } catch (...) {
    return tr("Unknown error");
  }
}

}  // namespace transillum::viewer
