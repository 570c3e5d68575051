// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Protocol. A message round is a range of consecutive passes; passes are dealt in rising order, at
// most three rounds ahead of what is added. A rank enters the exchange of a round when it has made
// all of the round's passes dealt to it and knows that it will get no more of them (floor). An
// exchange is one Ialltoall of sizes and one Ialltoallv of messages. A rank that cannot continue
// asks rank 0 to deal no more and enters its next exchange with the size -1, and so does everyone
// who then finds that nothing more is dealt; after such an exchange all leave and agree on the
// reason.
#include "message_rounds.h"

#include <algorithm>
#include <climits>
#include <cstring>
#include <exception>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace transillum::mpi {
namespace {

constexpr std::size_t unit_bytes = 16;

/// Before each message of an exchange.
struct MessageHead {
  std::int64_t pass = 0, bytes = 0;
};
static_assert(sizeof(MessageHead) == unit_bytes);

}  // namespace

MessageRounds::MessageRounds(MPI_Comm exchange, MPI_Comm dealing, MPI_Datatype unit,
                             const GroupPasses& passes)
    : comm_(exchange),
      unit_(unit),
      passes_(passes),
      added_(passes.first),
      makers_(passes),
      dealer_(dealing, BlockSchedule(0, 0, 1)),
      floor_(passes.first) {
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
  int workers = passes.threads;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(MPI_IN_PLACE, &workers, 1, MPI_INT, MPI_SUM, comm_, &request);
  wait_for(request);
  round_ = workers * passes_per_thread(passes.bytes_of_a_pass);
  dealer_ = PassDealer(dealing, BlockSchedule(passes.first, passes.last, workers));
  const auto size = static_cast<std::size_t>(size_);
  send_counts_.resize(size);
  receive_counts_.resize(size);
  for (auto* list : {&send_sizes_, &send_begin_, &receive_sizes_, &receive_begin_}) {
    list->resize(size);
  }
}

int MessageRounds::end_of_round() const { return std::min(passes_.last, added_ + round_); }

void MessageRounds::leave_for(Reason reason) {
  reason_ = std::max(reason_, reason);
  makers_.stop();
}

bool MessageRounds::run() {
  while (added_ < passes_.last && !over_) {
    if (makers_.failed()) {
      leave_for(passes_.cancellation.canceled() ? canceled : failed);
    } else if (passes_.cancellation.canceled()) {
      leave_for(canceled);
    }
    const bool served = dealer_.serve(limit());
    const bool dealt = deal_in();
    const bool advanced = advance_exchange();
    if (served || dealt || advanced) {
      pauses_.restart();
    } else {
      makers_.pause(pauses_.next());
    }
  }
  makers_.stop();
  switch (agreed_reason()) {
    case failed:
      if (makers_.error() && reason_ == failed) {
        std::rethrow_exception(makers_.error());
      }
      throw OtherProcessFailed();
    case canceled:
      throw Canceled();
    case paused:
      return false;
    default:
      return true;
  }
}

/// Asks for passes where few are waiting, and takes them. Returns whether anything happened.
bool MessageRounds::deal_in() {
  if (const auto block = dealer_.answer()) {
    floor_ = block->floor;
    if (block->stopped) {
      stop_known_ = true;
      leave_for(told);
    } else if (block->first == block->last) {
      // Rank 0 has added fewer rounds than this rank.
      next_ask_ = std::chrono::steady_clock::now() + std::chrono::microseconds(500);
      return false;
    }
    makers_.add(block->first, block->last);
    return true;
  }
  if (dealer_.asked()) {
    return false;
  }
  if (reason_ != going && !stop_known_) {
    stop_known_ = true;
    dealer_.ask_to_stop();
    return true;
  }
  const bool wanted = makers_.waiting() < 2 * static_cast<std::size_t>(passes_.threads);
  if (reason_ == going && wanted && floor_ < std::min(limit(), passes_.last) &&
      std::chrono::steady_clock::now() >= next_ask_) {
    dealer_.ask();
    return true;
  }
  return false;
}

/// Whether this rank can enter the exchange of the round.
bool MessageRounds::is_ready() const {
  return (reason_ != going && stop_known_) ||
         (floor_ >= end_of_round() && makers_.made_below(end_of_round()));
}

bool MessageRounds::advance_exchange() {
  if (exchange_ == Exchange::none) {
    if (!is_ready()) {
      return false;
    }
    begin_counts();
    return true;
  }
  int done = 0;
  MPI_Test(&request_, &done, MPI_STATUS_IGNORE);
  if (!done) {
    return false;
  }
  if (exchange_ == Exchange::counts) {
    begin_messages();
  } else {
    exchange_ = Exchange::none;
    add_round();
  }
  return true;
}

void MessageRounds::begin_counts() {
  exchange_ = Exchange::counts;
  std::fill(send_counts_.begin(), send_counts_.end(), reason_ == going ? 0 : -1);
  send_.clear();
  if (reason_ == going) {
    own_ = makers_.take_below(end_of_round());
    std::size_t total = 0;
    for (const auto& [k, messages] : own_) {
      total += messages.begin.back() - messages.to(rank_).size() +
               static_cast<std::size_t>(size_ - 1) * unit_bytes;
    }
    send_.reserve(total);
    for (int r = 0; r < size_; ++r) {
      if (r == rank_) {
        continue;
      }
      const std::size_t begin = send_.size();
      for (const auto& [k, messages] : own_) {
        const auto message = messages.to(r);
        const MessageHead head{k, static_cast<std::int64_t>(message.size())};
        const auto head_bytes = std::as_bytes(std::span(&head, 1));
        send_.insert(send_.end(), head_bytes.begin(), head_bytes.end());
        send_.insert(send_.end(), message.begin(), message.end());
      }
      send_counts_[static_cast<std::size_t>(r)] =
          static_cast<std::int64_t>((send_.size() - begin) / unit_bytes);
    }
  }
  MPI_Ialltoall(send_counts_.data(), 1, MPI_INT64_T, receive_counts_.data(), 1, MPI_INT64_T, comm_,
                &request_);
}

void MessageRounds::begin_messages() {
  if (std::any_of(receive_counts_.begin(), receive_counts_.end(),
                  [](std::int64_t count) { return count < 0; })) {
    exchange_ = Exchange::none;
    over_ = true;
    return;
  }
  const auto lay_out = [](const std::vector<std::int64_t>& counts, std::vector<int>& sizes,
                          std::vector<int>& begin) {
    std::int64_t total = 0;
    for (std::size_t r = 0; r < counts.size(); ++r) {
      sizes[r] = static_cast<int>(counts[r]);
      begin[r] = static_cast<int>(total);
      total += counts[r];
    }
    if (total > INT_MAX) {
      throw std::runtime_error("the messages of a round of passes exceed 32 GB");
    }
    return static_cast<std::size_t>(total);
  };
  lay_out(send_counts_, send_sizes_, send_begin_);
  receive_.resize(lay_out(receive_counts_, receive_sizes_, receive_begin_) * unit_bytes);
  bytes_sent_ += send_.size();
  exchange_ = Exchange::messages;
  MPI_Ialltoallv(send_.data(), send_sizes_.data(), send_begin_.data(), unit_, receive_.data(),
                 receive_sizes_.data(), receive_begin_.data(), unit_, comm_, &request_);
}

void MessageRounds::add_round() {
  std::map<int, std::span<const std::byte>> messages;
  for (const auto& [k, of_a_pass] : own_) {
    messages[k] = of_a_pass.to(rank_);
  }
  for (std::span<const std::byte> rest(receive_); !rest.empty();) {
    MessageHead head;
    std::memcpy(&head, rest.data(), sizeof(head));
    const auto bytes = static_cast<std::size_t>(head.bytes);
    messages[static_cast<int>(head.pass)] = rest.subspan(unit_bytes, bytes);
    rest = rest.subspan(unit_bytes + bytes);
  }
  const int end = end_of_round();
  for (int k = added_; k < end; ++k) {
    passes_.add(k, messages.at(k));
    serve();
  }
  added_ = end;
  own_.clear();
  if (!passes_.after_message_round()) {
    leave_for(paused);
    over_ = true;
  }
}

/// Waits until all ranks have left, and until rank 0 has answered all requests.
int MessageRounds::agreed_reason() {
  const auto wait_for_answer = [this] {
    while (dealer_.asked()) {
      dealer_.serve(limit());
      if (!dealer_.answer()) {
        makers_.pause(pauses_.next());
      }
    }
  };
  wait_for_answer();
  int reason = reason_;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(MPI_IN_PLACE, &reason, 1, MPI_INT, MPI_MAX, comm_, &request);
  wait_for(request, [this] { dealer_.serve(limit()); });
  return reason;
}

}  // namespace transillum::mpi
