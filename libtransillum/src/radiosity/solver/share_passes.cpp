// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The passes of one share of a solve. Input: the solve's options, of which no result depends on the
// share.
#include <fmt/format.h>

#include <charconv>

#include "base/worker_threads.h"
#include "radiosity/exchange/pass_plan.h"
#include "radiosity/exchange/sums_in_memory.h"
#include "radiosity/solver/shares.h"
#include "radiosity/solver/solver_input.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {

std::string Share::text() const { return fmt::format("{}/{}", number, of); }

Share share_from_text(const std::string& text) {
  Share share;
  const char* end = text.data() + text.size();
  const auto [slash, no_number] = std::from_chars(text.data(), end, share.number);
  if (no_number == std::errc() && slash != end && *slash == '/') {
    const auto [rest, no_count] = std::from_chars(slash + 1, end, share.of);
    if (no_count == std::errc() && rest == end && share.number >= 1 && share.number <= share.of) {
      return share;
    }
  }
  throw InputError(
      fmt::format("\"{}\" is not a share such as 3/16: K/N with whole numbers, 1 <= K <= N", text));
}

void check_can_be_shared(const SolveOptions& options, const Share& share) {
  options.validate();
  if (!takes_directions(options.engine)) {
    throw InputError(
        fmt::format("engine {}: it makes no passes to be shared out", name_of(options.engine)));
  }
  if (options.goal.is_set()) {
    throw InputError(
        "accuracy: it chooses the passes by the results of others, so they cannot be "
        "shared out");
  }
  if (traits_of(options.scheme).renews_directions) {
    throw InputError(
        "scheme semi-iterative: the number of its passes depends on results, so they "
        "cannot be shared out");
  }
  if (share.of > options.directions) {
    throw InputError(fmt::format("share {}: there are only {} passes to be shared out",
                                 share.text(), options.directions));
  }
}

void make_passes(const std::shared_ptr<const Scene>& scene, const SolveOptions& options,
                 const std::shared_ptr<const BspTree>& tree, const Share& share,
                 const std::function<void(int, const Transfers&)>& add,
                 const Cancellation& cancellation) {
  check_can_be_shared(options, share);
  const TransferEngine engine =
      make_engine(options.engine, scene, tree, used_engine_options(options), cancellation);
  const std::vector<Vec3> directions = PassPlan(options).directions(0);
  const auto pass_of = [&](int n) { return share.number - 1 + n * share.of; };
  const int count = (options.directions - share.number) / share.of + 1;
  PassLoop loop;
  loop.last = count;
  loop.threads = thread_count(options.threads);
  loop.make = [&](int n) {
    Pass pass;
    pass.transfers = engine(at(directions, pass_of(n)), cancellation);
    return pass;
  };
  loop.add = [&](int n, const Pass& pass) {
    cancellation.throw_if_canceled();
    add(pass_of(n), pass.transfers);
  };
  sums_in_memory()->run(loop);
}

}  // namespace transillum
