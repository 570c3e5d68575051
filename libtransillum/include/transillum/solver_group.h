// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A solve shared by several processes: what RadiositySolver asks of them. The library has no
// implementation for separate processes and needs no MPI; the program transillum-mpi implements
// SolverGroup with it (decisions/0063-processes.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/scene.h"

namespace TRANSILLUM_API transillum {

/// Consecutive patches: `first` to `last` - 1.
struct PatchRange {
  PatchId first = 0;  ///< the first patch
  PatchId last = 0;   ///< one past the last patch

  /// Whether patch i is one of them.
  bool contains(PatchId i) const { return first <= i && i < last; }
  /// Their number.
  std::size_t size() const { return static_cast<std::size_t>(last - first); }
};

/// One message for each member of a group, one after the other.
struct GroupMessages {
  std::unique_ptr<std::byte[]> bytes;  ///< bytes of all messages; each takes a multiple of 16
  std::vector<std::size_t> begin;      ///< per member: where its message begins; then their end

  /// The message for a member.
  std::span<const std::byte> to(int member) const {
    const auto r = static_cast<std::size_t>(member);
    return {bytes.get() + begin[r], begin[r + 1] - begin[r]};
  }
};

/// Passes that the members of a group make together, each pass by one of them.
struct GroupPasses {
  int first = 0;                      ///< the first pass
  int last = 0;                       ///< one past the last pass
  int threads = 1;                    ///< threads of this member
  std::uint64_t bytes_of_a_pass = 0;  ///< rough size of its messages to all members, bytes
  Cancellation cancellation;          ///< cancellation of this member
  /// Makes a pass: what each member needs of it. Called on any thread, several at a time.
  std::function<GroupMessages(int pass)> make;
  /// Adds a pass from the message for this member. Called in the order of the passes, on the thread
  /// that called SolverGroup::run(). An exception ends the whole group.
  std::function<void(int pass, std::span<const std::byte> message)> add;
  /// Called on every member after the same passes have been added; may call the group's functions.
  /// @returns whether to continue; the same on every member. May throw, if it does so on every
  /// member.
  std::function<bool()> after_round;
};

/// Thrown on members where nothing failed, but on another member of the group something did.
class MemberFailed : public std::runtime_error {
 public:
  /// Without further details: the other member has them.
  MemberFailed() : std::runtime_error("another process of the group has failed") {}
};

/// Processes that solve together. Each runs the same RadiositySolver and owns a range of patches:
/// it keeps the exchanges that meet them and sums what they receive. After every iteration all
/// members have B of all patches.
///
/// Every function but the constants must be called by all members, in the same order, and returns
/// when all have done so. Threads: one thread per member calls it.
class SolverGroup {
 public:
  virtual ~SolverGroup() = default;

  /// Which member this is, from 0.
  virtual int rank() const = 0;
  /// Number of members, at least 1.
  virtual int size() const = 0;

  /// Makes passes, spread over all members as they have time, and adds each on every member.
  /// @returns what the last GroupPasses::after_round() returned.
  /// @throws Canceled on every member where one was canceled, once the same passes have been added
  /// everywhere; where GroupPasses::make() throws on one member: there its error, MemberFailed on
  /// the others.
  virtual bool run(const GroupPasses& passes) = 0;

  /// Completes an array of all patches: each member gives the values of its own.
  /// @param values the same number for each of `patches` patches, one patch after the other.
  /// @param patches number of patches.
  virtual void complete(std::span<double> values, PatchId patches) = 0;
  /// Replaces each value by its largest over the members.
  virtual void maxima(std::span<double> values) = 0;
  /// Replaces each value by its sum over the members.
  virtual void sums(std::span<std::int64_t> values) = 0;
  /// The bytes of all members, in their order, on member 0; nothing on the others.
  virtual std::vector<std::byte> gather(std::span<const std::byte> bytes) = 0;

  /// The patches that a member owns.
  PatchRange range_of(int member, PatchId patches) const {
    const auto bound = [this, patches](std::int64_t k) {
      return static_cast<PatchId>(k * patches / size());
    };
    return {bound(member), bound(member + 1)};
  }
  /// The patches that this member owns.
  PatchRange owned(PatchId patches) const { return range_of(rank(), patches); }
  /// Whether `value` is true on any member.
  bool any(bool value);
  /// `value` of member 0, which is not negative.
  double from_first(double value);
  /// Runs `body` on every member.
  /// @throws where `body` throws on a member: there its error, MemberFailed on those where it did
  /// not.
  void agree(const std::function<void()>& body);
};

}  // namespace TRANSILLUM_API transillum
