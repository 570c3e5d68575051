// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/results/options_json.h"

#include "options/option_table.h"

namespace transillum {

using Json = nlohmann::ordered_json;

Json options_json(const RunOptions& run) {
  Json json;
  for (const Option& o : options()) {
    if (o.in_files && !o.reads_scene) {
      json[o.name] = Json::parse(o.to_json(run));
    }
  }
  const int averaged = run.solve.averaged_iterations;
  json["averaged-iterations"] = averaged > 0 ? Json(averaged) : Json();
  return json;
}

}  // namespace transillum
