// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "mpi_group.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <climits>
#include <cstdint>
#include <stdexcept>

#include "message_rounds.h"
#include "mpi_waiting.h"

namespace transillum::mpi {
namespace {

constexpr int unit_bytes = 16;

int checked_count(std::size_t count) {
  if (count > INT_MAX) {
    throw std::runtime_error("too many values for one message of MPI");
  }
  return static_cast<int>(count);
}

}  // namespace

MpiGroup::MpiGroup() {
  MPI_Comm_dup(MPI_COMM_WORLD, &comm_);
  MPI_Comm_dup(MPI_COMM_WORLD, &dealing_);
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
  MPI_Type_contiguous(unit_bytes, MPI_BYTE, &unit_);
  MPI_Type_commit(&unit_);
}

MpiGroup::~MpiGroup() {
  MPI_Type_free(&unit_);
  MPI_Comm_free(&dealing_);
  MPI_Comm_free(&comm_);
}

void MpiGroup::wait(MPI_Request& request) {
  wait_for(request, [this] {
    if (rounds_ != nullptr) {
      rounds_->serve();
    }
  });
}

bool MpiGroup::run_messages(const GroupPasses& passes) {
  MessageRounds rounds(comm_, dealing_, unit_, passes);
  struct Current {
    MpiGroup& group;
    MessageRounds& rounds;
    ~Current() {
      group.sent_in_passes_ += static_cast<std::int64_t>(rounds.bytes_sent());
      group.rounds_ = nullptr;
    }
  };
  rounds_ = &rounds;
  const Current current{*this, rounds};
  return rounds.run();
}

void MpiGroup::complete(std::span<double> values, PatchId patches) {
  const std::size_t each = values.size() / static_cast<std::size_t>(patches);
  checked_count(values.size());
  std::vector<int> counts, begin;
  for (int r = 0; r < size_; ++r) {
    const PatchRange range = range_of(r, patches);
    counts.push_back(static_cast<int>(each * range.size()));
    begin.push_back(static_cast<int>(each * static_cast<std::size_t>(range.first)));
  }
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallgatherv(MPI_IN_PLACE, 0, MPI_DOUBLE, values.data(), counts.data(), begin.data(),
                  MPI_DOUBLE, comm_, &request);
  wait(request);
  sent_in_sums_ +=
      static_cast<std::int64_t>(owned(patches).size() * each * sizeof(double)) * (size_ - 1);
}

void MpiGroup::maxima(std::span<double> values) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(MPI_IN_PLACE, values.data(), checked_count(values.size()), MPI_DOUBLE, MPI_MAX,
                 comm_, &request);
  wait(request);
}

void MpiGroup::sums(std::span<std::int64_t> values) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(MPI_IN_PLACE, values.data(), checked_count(values.size()), MPI_INT64_T, MPI_SUM,
                 comm_, &request);
  wait(request);
}

void MpiGroup::gather(std::span<const std::byte> bytes,
                      const std::function<void(std::span<const std::byte>)>& take) {
  for (int r = 0; r < size_; ++r) {
    auto size = static_cast<std::int64_t>(bytes.size());
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(&size, 1, MPI_INT64_T, r, comm_, &request);
    wait(request);
    if (rank_ == 0 && r == 0) {
      take(bytes);
    }
    if (r == 0 || (rank_ != 0 && rank_ != r)) {
      continue;
    }
    // In whole units, the last of them filled up.
    const std::size_t units = (static_cast<std::size_t>(size) + unit_bytes - 1) / unit_bytes;
    std::vector<std::byte> part(rank_ == r ? bytes.begin() : bytes.end(), bytes.end());
    part.resize(units * unit_bytes);
    if (rank_ == r) {
      MPI_Isend(part.data(), checked_count(units), unit_, 0, 0, comm_, &request);
      wait(request);
    } else {
      MPI_Irecv(part.data(), checked_count(units), unit_, r, 0, comm_, &request);
      wait(request);
      take(std::span(part).first(static_cast<std::size_t>(size)));
    }
  }
}

std::string MpiGroup::traffic() {
  std::vector<std::int64_t> sent{sent_in_passes_, sent_in_sums_};
  sums(sent);
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  std::vector<double> largest{static_cast<double>(usage.ru_maxrss)};
  maxima(largest);
  constexpr double mega = 1e-6;
  return fmt::format(
      "{} processes sent {:.1f} MB for passes and {:.1f} MB for sums; the largest used {:.1f} MB "
      "of memory",
      size_, mega * static_cast<double>(sent[0]), mega * static_cast<double>(sent[1]),
      mega * 1024 * largest[0]);
}

}  // namespace transillum::mpi
