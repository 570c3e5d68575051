// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "support/failure_text.h"

#include <QCoreApplication>
#include <new>
#include <system_error>

namespace transillum::viewer {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("Failure", text); }

}  // namespace

QString remedy_hint(Remedy remedy) {
  switch (remedy) {
    case Remedy::none:
      break;
    case Remedy::directions:
      return tr(" (increase Passes)");
    case Remedy::directions_or_row_normalization:
      return tr(" (increase Passes, or set Normalization to Rows)");
    case Remedy::directions_or_symmetric_normalization:
      return tr(" (increase Passes, or set Normalization to Symmetric)");
    case Remedy::memory:
      return tr(" (start the program with a larger --memory)");
  }
  return {};
}

QString failure_text(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error)) {
    return tr("Not enough memory");
  }
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  if (system && system->code() == std::errc::resource_unavailable_try_again) {
    return tr("Not enough memory, or too many threads, to start a thread");
  }
  const QString text = QString::fromUtf8(error.what());
  const auto* solve_error = dynamic_cast<const SolveError*>(&error);
  return text.isEmpty() ? tr("Unknown error")
                        : text + remedy_hint(solve_error ? solve_error->remedy() : Remedy::none);
}

QString current_failure_text() {
  try {
    throw;
  } catch (const std::exception& error) {
    return failure_text(error);
  } catch (...) {
    return tr("Unknown error");
  }
}

}  // namespace transillum::viewer
