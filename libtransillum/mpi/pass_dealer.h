// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <mpi.h>

#include <optional>

#include "block_schedule.h"

namespace transillum::mpi {

/// The exchange of requests and blocks between a rank and rank 0. One request per rank at a time.
class PassDealer {
 public:
  /// @param comm a communicator for this purpose only
  /// @param schedule of rank 0
  PassDealer(MPI_Comm comm, const BlockSchedule& schedule);

  /// Rank 0: answers requests. Passes from `limit` on are not dealt yet.
  /// @returns whether there were any
  bool serve(int limit);
  /// Asks for a block. Not while asked().
  void ask() { send(ask_word); }
  /// Asks rank 0 to deal no more, to anyone. Not while asked().
  void ask_to_stop() { send(stop_word); }
  /// Whether a request is not answered yet.
  bool asked() const { return asked_; }
  /// The answer, once it is there.
  std::optional<PassBlock> answer();

 private:
  static constexpr int ask_word = 0, stop_word = 1;
  static constexpr int request_tag = 1, answer_tag = 2;
  void send(int word);
  PassBlock deal(int word, int limit);

  MPI_Comm comm_;
  int rank_ = 0;
  BlockSchedule schedule_;
  bool asked_ = false;
  int word_ = 0;                  ///< content of the request under way
  std::optional<PassBlock> own_;  ///< rank 0: answer to itself
  int answer_[4] = {};
  MPI_Request receiving_ = MPI_REQUEST_NULL, sending_ = MPI_REQUEST_NULL;
};

}  // namespace transillum::mpi
