// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <mpi.h>

#include <functional>
#include <string>

#include "process_group.h"

namespace transillum::mpi {

class MessageRounds;

/// The ranks of MPI as a group of processes. Waiting leaves the core to others. Only the thread
/// that initialized MPI may call it.
class MpiGroup : public ProcessGroup {
 public:
  /// All ranks; to be called by all. MPI must be initialized until the destructor has run.
  MpiGroup();
  ~MpiGroup() override;
  MpiGroup(const MpiGroup&) = delete;
  MpiGroup& operator=(const MpiGroup&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void complete(std::span<double> values, PatchId patches) override;
  void maxima(std::span<double> values) override;
  void sums(std::span<std::int64_t> values) override;
  void gather(std::span<const std::byte> bytes,
              const std::function<void(std::span<const std::byte>)>& take) override;

  /// Says what all ranks have sent so far and the most memory that one has used, in a sentence. To
  /// be called by all.
  std::string traffic();

 private:
  bool run_messages(const GroupPasses& passes) override;
  void wait(MPI_Request& request);

  int rank_ = 0, size_ = 1;
  MPI_Comm comm_ = MPI_COMM_NULL, dealing_ = MPI_COMM_NULL;
  MPI_Datatype unit_ = MPI_DATATYPE_NULL;  ///< 16 bytes
  MessageRounds* rounds_ = nullptr;        ///< message rounds under way
  std::int64_t sent_in_passes_ = 0, sent_in_sums_ = 0;
};

}  // namespace transillum::mpi
