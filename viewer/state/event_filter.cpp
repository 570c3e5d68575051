// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "state/event_filter.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <cmath>

#include "support/number_text.h"

namespace transillum::viewer {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("EventFilter", text); }

bool involves(const StepEvent& event, PatchId patch) {
  return patch == no_patch || event.below == patch || event.above == patch;
}

QString kinds_text(const EventFilter& filter) {
  const auto count = std::count(filter.kinds.begin(), filter.kinds.end(), true);
  if (count != 1) {
    return tr("%1 of %2 kinds").arg(count).arg(StepEvent::kind_count);
  }
  const auto only = std::find(filter.kinds.begin(), filter.kinds.end(), true);
  return tr("“%1”").arg(text_of(static_cast<StepEvent::Kind>(only - filter.kinds.begin())));
}

QString area_text(const EventFilter& filter) {
  const QString least = number_text(filter.least_area), largest = number_text(filter.largest_area);
  if (std::isinf(filter.largest_area)) {
    return tr("at least %1 m²").arg(least);
  }
  return filter.least_area > 0 ? tr("%1 to %2 m²").arg(least, largest)
                               : tr("at most %1 m²").arg(largest);
}

}  // namespace

bool EventFilter::passes(const StepEvent& event) const {
  return shows(event.kind) && least_area <= event.area && event.area <= largest_area &&
         involves(event, patch);
}

bool EventFilter::passes_at(const MapHistory& history, std::int32_t step, PatchId other) const {
  const auto events = events_of_step(history, step);
  return std::any_of(events.begin(), events.end(), [&](const StepEvent& event) {
    return passes(event) && involves(event, other);
  });
}

QString text_of(const EventFilter& filter) {
  const EventFilter all;
  QStringList parts;
  if (filter.kinds != all.kinds) {
    parts << kinds_text(filter);
  }
  if (filter.least_area != all.least_area || filter.largest_area != all.largest_area) {
    parts << area_text(filter);
  }
  if (filter.patch != no_patch) {
    parts << tr("patch %1").arg(filter.patch);
  }
  return parts.join(QStringLiteral(", "));
}

}  // namespace transillum::viewer
