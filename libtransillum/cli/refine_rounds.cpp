// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The rounds of --refine-by: progress and a line for each.
#include "refine_rounds.h"

#include <fmt/format.h>

#include "messages.h"
#include "progress_display.h"

namespace transillum::cli {

Refinement refine_in_rounds(const SolveCall& call, const std::shared_ptr<const Scene>& scene,
                            const SolveOptions& options, const Cancellation& cancellation) {
  ProgressDisplay display(call.quiet);
  int number = 1;
  const auto begin = [&] { display.begin(fmt::format("round {}", number)); };
  begin();
  const char* figure = *call.scene.run.refine.by == RefineBy::jump ? "RMS jump" : "L2 error";
  Refinement refined = refine(
      scene, options, call.scene.run.refine.options(),
      [&](const RefinementRound& round, const Solution& /*solved*/) {
        display.clear();
        if (!call.quiet) {
          print_message(fmt::format("round {}: {} patches, {} {:.3g} % of B, {:.2g} s", number,
                                    round.patches, figure, 100 * round.figure, round.seconds));
        }
        ++number;
        begin();
      },
      [&](const RadiositySolver& watched) {
        const SolveProgress progress = watched.progress();
        if (progress.direction > 0) {
          display.show_passes(
              fmt::format("round {}, iteration {}, ", number, progress.iteration + 1), progress);
        }
        return true;
      },
      cancellation);
  display.clear();
  return refined;
}

}  // namespace transillum::cli
