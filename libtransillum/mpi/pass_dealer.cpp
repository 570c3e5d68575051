// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "pass_dealer.h"

namespace transillum::mpi {

PassDealer::PassDealer(MPI_Comm comm, const BlockSchedule& schedule)
    : comm_(comm), schedule_(schedule) {
  MPI_Comm_rank(comm, &rank_);
}

void PassDealer::send(int word) {
  asked_ = true;
  word_ = word;
  if (rank_ != 0) {
    MPI_Irecv(answer_, 4, MPI_INT, 0, answer_tag, comm_, &receiving_);
    MPI_Isend(&word_, 1, MPI_INT, 0, request_tag, comm_, &sending_);
  }
}

PassBlock PassDealer::deal(int word, int limit) {
  if (word == stop_word) {
    schedule_.stop();
  }
  return schedule_.take(limit);
}

bool PassDealer::serve(int limit) {
  if (rank_ != 0) {
    return false;
  }
  bool served = false;
  if (asked_ && !own_) {
    own_ = deal(word_, limit);
    served = true;
  }
  for (;;) {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, request_tag, comm_, &there, &status);
    if (!there) {
      return served;
    }
    int word = 0;
    MPI_Recv(&word, 1, MPI_INT, status.MPI_SOURCE, request_tag, comm_, MPI_STATUS_IGNORE);
    const PassBlock block = deal(word, limit);
    const int answer[4] = {block.first, block.last, block.floor, block.stopped ? 1 : 0};
    // So short a message is sent at once; its receiver waits for it.
    MPI_Send(answer, 4, MPI_INT, status.MPI_SOURCE, answer_tag, comm_);
    served = true;
  }
}

std::optional<PassBlock> PassDealer::answer() {
  if (!asked_) {
    return {};
  }
  if (rank_ == 0) {
    if (!own_) {
      return {};
    }
    asked_ = false;
    const PassBlock block = *own_;
    own_.reset();
    return block;
  }
  int done = 0;
  MPI_Test(&receiving_, &done, MPI_STATUS_IGNORE);
  if (!done) {
    return {};
  }
  MPI_Wait(&sending_, MPI_STATUS_IGNORE);  // the request has arrived
  asked_ = false;
  return PassBlock{answer_[0], answer_[1], answer_[2], answer_[3] != 0};
}

}  // namespace transillum::mpi
