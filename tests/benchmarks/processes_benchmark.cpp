// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A model of transillum-mpi for many processes, from parts that one core can measure. A solver of
// one process of N is run for real: it makes passes, splits them into messages for N processes and
// adds the messages for itself; the other processes do not exist. From the times of its parts, a
// simulation of the schedule by which passes are dealt (libtransillum/mpi/block_schedule.h) gives
// the time of a machine with N cores. decisions/0063-processes.md states the assumptions.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <queue>
#include <random>

#include "block_schedule.h"
#include "measure.h"
#include "process_group.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solve_options.h"

namespace transillum::benchmarks {
namespace {

// The network: bytes per second and process, and seconds per message.
constexpr double bandwidth = 1e9, latency = 5e-6;

/// Times of the parts of a pass in a process of N.
struct PassTimes {
  std::vector<double> make;  ///< with splitting, s
  double add = 0;            ///< mean, s
  double bytes = 0;          ///< bytes of the messages of a pass to all processes, mean
  double kept = 0;           ///< bytes of form factors in one process
  double iteration = 0;      ///< an iteration from kept sums, without messages, s
};

/// Process `rank` of a group in which no other exists.
class LonelyGroup : public mpi::ProcessGroup {
 public:
  LonelyGroup(int rank, int size, PassTimes& times) : rank_(rank), size_(size), times_(times) {}
  int rank() const override { return rank_; }
  int size() const override { return size_; }
  bool run_messages(const mpi::GroupPasses& passes) override {
    bool going = true;
    for (int k = passes.first; going && k < passes.last; ++k) {
      mpi::GroupMessages messages;
      times_.make.push_back(
          seconds_of(CLOCK_THREAD_CPUTIME_ID, [&] { messages = passes.make(k); }));
      times_.add += seconds_of(CLOCK_THREAD_CPUTIME_ID, [&] { passes.add(k, messages.to(rank_)); });
      times_.bytes += static_cast<double>(messages.begin.back());
      going = passes.after_message_round();
    }
    times_.add /= passes.last - passes.first;
    times_.bytes /= passes.last - passes.first;
    return going;
  }
  void complete(std::span<double>, PatchId) override {}
  void maxima(std::span<double>) override {}
  void sums(std::span<std::int64_t> values) override {
    // Pairs of owned lower patches, and about as many others; a source and an area each.
    times_.kept = (2 - 1.0 / size_) * 12 * static_cast<double>(values[0]);
  }
  void gather(std::span<const std::byte>,
              const std::function<void(std::span<const std::byte>)>&) override {}

 private:
  int rank_, size_;
  PassTimes& times_;
};

/// The middle process of `size`, which solves with so many passes.
PassTimes measure(const std::shared_ptr<const Scene>& scene,
                  const std::shared_ptr<const BspTree>& tree, int size, int passes) {
  PassTimes times;
  const SolveOptions options{.directions = passes, .iterations = 2, .threads = 1};
  RadiositySolver solver(
      scene, options, {.tree = tree, .sums = std::make_shared<LonelyGroup>(size / 2, size, times)});
  solver.advance(RadiositySolver::Until::iteration);
  try {
    times.iteration = seconds_of(CLOCK_THREAD_CPUTIME_ID,
                                 [&] { solver.advance(RadiositySolver::Until::iteration); });
  } catch (const std::runtime_error&) {
    // The values of the other processes are missing.
  }
  return times;
}

/// Seconds until all passes are added in all processes, each with one core.
double simulated_passes(const PassTimes& times, int size, int passes) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> pick(0, times.make.size() - 1);
  mpi::BlockSchedule schedule(0, passes, size);
  const int round = size * mpi::passes_per_thread(static_cast<std::uint64_t>(times.bytes));
  const int rounds = (passes + round - 1) / round;
  const auto in_round = [&](int r) { return std::min(round, passes - r * round); };
  const auto exchange = [&](int r) {
    return latency * 2 * size + in_round(r) * times.bytes / size / bandwidth;
  };
  std::vector<double> finished(static_cast<std::size_t>(rounds));  ///< all passes of it made
  std::vector<double> debt(static_cast<std::size_t>(size));        ///< work of adding that is to be
                                                                   ///< done
  using Free = std::pair<double, int>;
  std::priority_queue<Free, std::vector<Free>, std::greater<>> processes;
  for (int p = 0; p < size; ++p) {
    processes.emplace(0.0, p);
  }
  int added = 0;   // rounds
  double now = 0;  // when the last of them was exchanged
  int dealt = 0;
  while (dealt < passes) {
    auto [time, p] = processes.top();
    processes.pop();
    const mpi::PassBlock block = schedule.take((added + mpi::message_rounds_ahead) * round);
    if (block.first == block.last) {  // waits for the exchange of a round
      now = std::max(now, finished[static_cast<std::size_t>(added)]) + exchange(added);
      for (double& seconds : debt) {
        seconds += in_round(added) * times.add;
      }
      ++added;
      processes.emplace(std::max(time, now), p);
      continue;
    }
    dealt = block.last;
    auto& own = debt[static_cast<std::size_t>(p)];
    time += latency + own;
    own = 0;
    for (int k = block.first; k < block.last; ++k) {
      time += times.make[pick(random)];
      auto& end = finished[static_cast<std::size_t>(k / round)];
      end = std::max(end, time);
    }
    processes.emplace(time, p);
  }
  for (; added < rounds; ++added) {
    now = std::max(now, finished[static_cast<std::size_t>(added)]) + exchange(added) +
          in_round(added) * times.add;
  }
  return now;
}

double sum(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) {
    sum += value;
  }
  return sum;
}

int number_in(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr ? std::atoi(text) : otherwise;
}

/// The shortest times of some repetitions, by number of processes; the machine may do other work.
std::map<int, PassTimes> measured_times(const std::shared_ptr<const Scene>& scene,
                                        const std::shared_ptr<const BspTree>& tree) {
  const int passes = number_in("TRANSILLUM_MEASURED", 96);
  std::map<int, PassTimes> all;
  for (int repetition = 0; repetition < 4; ++repetition) {
    for (const int size : {1, 2, 16, 128, 1024}) {
      const PassTimes times = measure(scene, tree, size, passes);
      PassTimes& best = all.try_emplace(size, times).first->second;
      for (std::size_t k = 0; k < best.make.size(); ++k) {
        best.make[k] = std::min(best.make[k], times.make[k]);
      }
      best.add = std::min(best.add, times.add);
      best.iteration = std::min(best.iteration, times.iteration);
    }
  }
  return all;
}

/// Environment: TRANSILLUM_SCENE, TRANSILLUM_PASSES (M), TRANSILLUM_MEASURED (passes measured).
void measure_processes(benchmark::State& state) {
  const char* spec = std::getenv("TRANSILLUM_SCENE");
  for (auto _ : state) {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const BspTree> tree;
    const double before = seconds_of(CLOCK_THREAD_CPUTIME_ID, [&] {
      scene = load_scene(spec != nullptr ? spec : "sphere-flake");
      tree =
          std::make_shared<const BspTree>(*scene, Cancellation{}, std::function<void(double)>{}, 1);
    });
    const PatchId patches = scene->patch_count();
    fmt::print("{} patches, scene and tree {:.2f} s\n", patches, before);
    std::map<int, double> alone;
    for (const auto& [size, times] : measured_times(scene, tree)) {
      fmt::print("N = {:4}: make {:.2f} ms, add {:.3f} ms, {:.2f} MB sent a pass, {:.2f} MB kept\n",
                 size, 1e3 * sum(times.make) / static_cast<double>(times.make.size()),
                 1e3 * times.add, 1e-6 * times.bytes * (size - 1) / size, 1e-6 * times.kept);
      for (const int passes : {1024, number_in("TRANSILLUM_PASSES", 65536)}) {
        const double seconds = simulated_passes(times, size, passes);
        alone.try_emplace(passes, seconds);
        // B and what is gathered, completed in each iteration.
        const double arrays = 2 * (24.0 * patches / bandwidth + latency * std::log2(size));
        constexpr int iterations = 20;
        fmt::print(
            "  M = {:6}: passes {:.3f} s, efficiency {:.3f}; iteration {:.2f} + {:.2f} ms; "
            "all {:.2f} s\n",
            passes, seconds, alone[passes] / size / seconds, 1e3 * times.iteration, 1e3 * arrays,
            before + seconds + iterations * (times.iteration + arrays));
      }
      std::fflush(stdout);
    }
  }
}
BENCHMARK(measure_processes)->Name("Processes")->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace transillum::benchmarks
