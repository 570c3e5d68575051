// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The passes of an iteration in a group of processes: each is made by one member, split into what
// each member needs of it, and added on every member in the order of the passes.
//
// Why one process gives the same bits: what a patch receives is summed by its owner, which gets
// all exchanges of the patch, in the order of one process; maxima do not depend on the order; sums
// over patches within a pass are made by the member that made it (decisions/0063-processes.md).
#include "process_group.h"

#include <bit>
#include <stdexcept>
#include <utility>

#include "pass_messages.h"

namespace transillum::mpi {
namespace {

/// A number that differs between almost any two lists of values, exact as a double.
double fingerprint(std::span<const double> values) {
  std::uint64_t hash = 0;
  for (const double value : values) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 32;
  }
  constexpr int digits = 52;
  return static_cast<double>(hash >> (64 - digits));
}

}  // namespace

bool ProcessGroup::run(const PassLoop& loop) {
  bool going = true;
  GroupPasses passes;
  passes.first = loop.first;
  passes.last = loop.last;
  passes.threads = loop.threads;
  passes.bytes_of_a_pass = expected_message_bytes(loop.patches);
  passes.cancellation = loop.cancellation;
  passes.make = [&](int k) { return split(loop.make(k), *this, loop.patches); };
  passes.add = [&](int k, std::span<const std::byte> message) {
    Pass pass = joined_pass(message, owned(loop.patches));
    loop.prepare(k, pass);
    loop.add(k, std::move(pass));
    going = loop.observe(k) && going;
  };
  passes.after_message_round = [&] {
    loop.settle();
    return !any(!going);
  };
  return run_messages(passes);
}

void ProcessGroup::check_same(std::span<const double> values) {
  const double own = fingerprint(values);
  std::vector<double> bounds{own, -own};
  maxima(bounds);
  if (bounds[0] != -bounds[1]) {
    throw std::runtime_error(
        "the processes of the group computed different values: their machines or programs differ");
  }
}

}  // namespace transillum::mpi
