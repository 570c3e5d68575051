// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/patch_sums.h"

namespace transillum::mpi {

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

/// A PassLoop as messages: passes that the members of a group make together, each pass by one of
/// them.
struct GroupPasses {
  int first = 0;                      ///< the first pass
  int last = 0;                       ///< one past the last pass
  int threads = 1;                    ///< threads of this member
  std::uint64_t bytes_of_a_pass = 0;  ///< rough size of its messages to all members, bytes
  Cancellation cancellation;          ///< cancels this member
  /// Makes a pass: what each member needs of it. Called on any thread, several at a time.
  std::function<GroupMessages(int pass)> make;
  /// Adds a pass from the message for this member. Called in the order of the passes, on the thread
  /// that called ProcessGroup::run(). An exception ends the whole group.
  std::function<void(int pass, std::span<const std::byte> message)> add;
  /// Called on every member after the same passes have been added; may call the group's functions.
  /// @returns whether to continue; the same on every member. May throw, if it does so on every
  /// member.
  std::function<bool()> after_message_round;
};

/// Processes that solve together, the members of a group, each of which keeps the sums of the
/// patches it owns. A pass is split into one message for each.
class ProcessGroup : public PatchSums {
 public:
  bool run(const PassLoop& loop) override;
  void check_same(std::span<const double> values) override;

 protected:
  /// Makes passes, spread over all members as they have time, and adds each on every member.
  /// @returns what the last GroupPasses::after_message_round() returned.
  /// @throws as PatchSums::run()
  virtual bool run_messages(const GroupPasses& passes) = 0;
};

}  // namespace transillum::mpi
