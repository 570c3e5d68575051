// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <mpi.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "mpi_waiting.h"
#include "pass_dealer.h"
#include "pass_makers.h"
#include "process_group.h"

namespace transillum::mpi {

/// The passes of one PatchSums::run(). They are added in message rounds of consecutive passes: when
/// every rank has made its part of a round, all exchange what they need of it, while their threads
/// continue with the next one.
class MessageRounds {
 public:
  /// @param exchange, dealing communicators for this purpose only
  /// @param unit MPI's type of 16 bytes
  MessageRounds(MPI_Comm exchange, MPI_Comm dealing, MPI_Datatype unit, const GroupPasses& passes);

  /// The same as PatchSums::run().
  bool run();
  /// Answers requests and takes passes, so that all threads have some; to be called while this rank
  /// adds passes or waits for others.
  void serve() {
    dealer_.serve(limit());
    deal_in();
  }
  std::uint64_t bytes_sent() const { return bytes_sent_; }

 private:
  /// Why a rank leaves the rounds, the most important last.
  enum Reason { going, told, paused, canceled, failed };
  enum class Exchange { none, counts, messages };

  int end_of_round() const;
  /// Passes from here on are not dealt yet.
  int limit() const { return added_ + message_rounds_ahead * round_; }
  bool deal_in();
  bool advance_exchange();
  bool is_ready() const;
  void begin_counts();
  void begin_messages();
  void add_round();
  void leave_for(Reason reason);
  int agreed_reason();

  MPI_Comm comm_;
  MPI_Datatype unit_;
  const GroupPasses& passes_;
  int rank_ = 0, size_ = 1;
  int round_ = 1;  ///< passes per round
  int added_;      ///< passes before this one are added
  PassMakers makers_;
  PassDealer dealer_;
  Pauses pauses_;

  int floor_;                ///< no pass before this one will be dealt to this rank
  bool stop_known_ = false;  ///< rank 0 knows that a rank leaves
  std::chrono::steady_clock::time_point next_ask_;  ///< not before
  Reason reason_ = going;
  bool over_ = false;  ///< all ranks leave

  Exchange exchange_ = Exchange::none;
  MPI_Request request_ = MPI_REQUEST_NULL;
  std::vector<std::int64_t> send_counts_, receive_counts_;  ///< units; -1: the rank leaves
  std::vector<int> send_sizes_, send_begin_, receive_sizes_, receive_begin_;
  std::vector<std::byte> send_, receive_;
  std::map<int, GroupMessages> own_;  ///< made here, of the round being exchanged
  std::uint64_t bytes_sent_ = 0;
};

}  // namespace transillum::mpi
