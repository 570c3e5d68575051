// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/requests/recorded_map.h"

namespace transillum::viewer {

RecordedMap record_map(const MapRequest& request, const Cancellation& cancellation) {
  MapRecord record = record_local_map(*request.loaded->scene, *request.loaded->tree, request.omega,
                                      cancellation, request.memory)
                         .record;
  return {request.loaded, MapHistory(std::move(record)), request.iteration, request.direction,
          request.passes};
}

}  // namespace transillum::viewer
