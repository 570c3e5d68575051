// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// How a solve sums what its passes bring to its patches: the one interface between RadiositySolver
// and where the sums are kept. By default this process keeps the sums of all patches. The program
// transillum-mpi keeps the sums of a patch in one of several processes; the library needs no MPI
// (decisions/0063-processes.md).
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
#include "transillum/transfers.h"

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

/// The result of one pass.
struct Pass {
  Transfers transfers;           ///< between all patches; once prepared, coverages of owned() only
  std::vector<Transfer> sorted;  ///< exchanges as sums of them are kept; empty: they are not kept
  // Values over all patches, of a pass along a new direction:
  ClosureDefect closure;       ///< largest defects
  double projected = 0;        ///< projected area, m²
  double covered = 0;          ///< the part of it with a patch above, m²
  std::int64_t exchanges = 0;  ///< number of exchanges
};

/// Passes to be made and added.
struct PassLoop {
  int first = 0;                   ///< the first pass
  int last = 0;                    ///< one past the last pass
  int threads = 1;                 ///< that make them, in this process
  PatchId patches = 0;             ///< number of patches of the scene
  Cancellation cancellation = {};  ///< cancels this process
  /// Makes a pass. Called on any thread, several at a time; must not read what `add` writes.
  std::function<Pass(int pass)> make;
  /// Prepares a pass for `add`, in the process that adds it. Called on any thread.
  std::function<void(int pass, Pass& made)> prepare = [](int, Pass&) {};
  /// Adds a pass. Called in the order of the passes, on one thread at a time.
  std::function<void(int pass, Pass made)> add;
  /// Called in all processes after the same pass has been added; may call functions of PatchSums.
  std::function<void()> settle = [] {};
  /// Called after each pass, on the thread of `add`; returns whether to continue. Where several
  /// processes solve, it may be called before `settle`.
  std::function<bool(int pass)> observe = [](int) { return true; };
};

/// Thrown in processes where nothing failed, but in another process of the solve something did.
class OtherProcessFailed : public std::runtime_error {
 public:
  /// Without further details: the other process has them.
  OtherProcessFailed() : std::runtime_error("another process of the group has failed") {}
};

/// Where the sums over the passes of a solve are kept. Each process runs the same RadiositySolver
/// and owns a range of patches: it sums what they receive and keeps the exchanges that meet them.
/// After every iteration all processes have B of all patches.
///
/// Every function but the constants must be called in all processes, in the same order, and returns
/// when all have done so. Threads: one thread per process calls it.
class PatchSums {
 public:
  virtual ~PatchSums() = default;

  /// Which process this is, from 0.
  virtual int rank() const = 0;
  /// Number of processes, at least 1.
  virtual int size() const = 0;

  /// Makes passes and adds each in every process. After PassLoop::observe() returns false, passes
  /// under way are still added.
  /// @returns whether it never did, in any process.
  /// @throws Canceled in every process where one was canceled, once the same passes have been added
  /// everywhere; what PassLoop::make() throws, and in the other processes OtherProcessFailed.
  virtual bool run(const PassLoop& loop) = 0;

  /// Completes an array of all patches: each process gives the values of its own.
  /// @param values the same number for each of `patches` patches, one patch after the other.
  /// @param patches number of patches.
  virtual void complete(std::span<double> values, PatchId patches) = 0;
  /// Replaces each value by its largest over the processes.
  virtual void maxima(std::span<double> values) = 0;
  /// Replaces each value by its sum over the processes.
  virtual void sums(std::span<std::int64_t> values) = 0;
  /// Calls take() in process 0 with the bytes of each process, in their order, one at a time.
  virtual void gather(std::span<const std::byte> bytes,
                      const std::function<void(std::span<const std::byte>)>& take) = 0;
  /// Checks that all processes have the same values.
  /// @throws std::runtime_error in all of them.
  virtual void check_same(std::span<const double> values) = 0;

  /// The patches that a process owns.
  PatchRange range_of(int process, PatchId patches) const;
  /// The patches that this process owns.
  PatchRange owned(PatchId patches) const { return range_of(rank(), patches); }
  /// Whether this process does what one process does: prints, writes files.
  bool is_first() const { return rank() == 0; }
  /// Whether `value` is true in any process.
  bool any(bool value);
  /// `value` of process 0, which is not negative.
  double from_first(double value);
  /// Runs `body` in every process.
  /// @throws where `body` throws in a process: there its error, OtherProcessFailed where it did
  /// not.
  void agree(const std::function<void()>& body);
  /// The cancellation of work that the other processes wait for: `requested`, or none if there are
  /// others, which stop together.
  Cancellation own(const Cancellation& requested) const;
};

}  // namespace TRANSILLUM_API transillum
