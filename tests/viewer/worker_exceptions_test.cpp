// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Exceptions on the threads of SolveRunner and of the map painter, at each place where they can
// occur: the program continues, the user gets a message, and the next request succeeds.
//
// Two functions of the library are wrapped in this program by functions that first call a hook: one
// that SolveRunner calls for each snapshot, one that the painter calls for each picture.
#include <QTest>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <new>

#include "map/map_canvas.h"
#include "model/solver/solve_runner.h"
#include "solved_window.h"
#include "thrown.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/visibility_map.h"

namespace {

/// A function that another thread calls.
class Hook {
 public:
  void set(std::function<void()> function) {
    const std::lock_guard lock(mutex_);
    function_ = std::move(function);
  }
  void operator()() {
    std::function<void()> function;
    {
      const std::lock_guard lock(mutex_);
      function = function_;
    }
    if (function) {
      function();
    }
  }

 private:
  std::mutex mutex_;
  std::function<void()> function_;
};
Hook on_snapshot, on_picture;

/// Allocations of this thread that still succeed, and the number that fail after them.
thread_local int allocations_left = -1, failing_allocations = 0;
std::atomic<bool> allocations_may_fail = false;

bool allocation_fails() {
  if (!allocations_may_fail || allocations_left < 0 || allocations_left-- > 0) {
    return false;
  }
  allocations_left = --failing_allocations > 0 ? 0 : -1;
  return true;
}

}  // namespace

void* operator new(std::size_t size) {
  void* const memory = allocation_fails() ? nullptr : std::malloc(size);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

// The linker replaces each call of the member functions, whose first argument is `this`, by one of
// wrapped_…(), and calls them for original_…() (option --wrap).
using transillum::MapRecord, transillum::RadiositySolver, transillum::Solution;

Solution original_solution(const RadiositySolver* solver) asm(
    "__real__ZNK10transillum15RadiositySolver8solutionEv");
Solution wrapped_solution(const RadiositySolver* solver) asm(
    "__wrap__ZNK10transillum15RadiositySolver8solutionEv");
Solution wrapped_solution(const RadiositySolver* solver) {
  on_snapshot();
  return original_solution(solver);
}

std::vector<std::int32_t> original_map_after(const MapRecord* record, std::int32_t k) asm(
    "__real__ZNK10transillum9MapRecord9map_afterEi");
std::vector<std::int32_t> wrapped_map_after(const MapRecord* record, std::int32_t k) asm(
    "__wrap__ZNK10transillum9MapRecord9map_afterEi");
std::vector<std::int32_t> wrapped_map_after(const MapRecord* record, std::int32_t k) {
  on_picture();
  return original_map_after(record, k);
}

using namespace transillum;
using namespace transillum::viewer;
using namespace transillum::viewer::test;

namespace {

SolveOptions with_replicas(int directions = 16) {
  SolveOptions options;
  options.directions = directions;
  options.replicas = 4;
  options.threads = 2;
  return options;
}

/// A runner with its newest snapshot and failure.
struct Watched {
  SolveRunner runner;
  std::shared_ptr<const SolverSnapshot> snapshot;
  QString failure;

  Watched() {
    QObject::connect(&runner, &SolveRunner::snapshot_ready, &runner,
                     [this](auto newest) { snapshot = newest; });
    QObject::connect(&runner, &SolveRunner::failed, &runner,
                     [this](const QString& message, bool) { failure = message; });
  }
  void open(Goal then = {Goal::Kind::finished}) {
    runner.open({"furnace", {with_replicas()}, then});
  }
  bool finishes_with(int directions) {
    return wait_for([&] {
      return runner.state() == RunState::finished && snapshot && snapshot->progress.finished &&
             snapshot->options.directions == directions;
    });
  }
};

/// Stops the worker's thread in its n-th snapshot (from 0) until it is released.
class Stopper {
 public:
  explicit Stopper(int n) {
    on_snapshot.set([this, n] {
      if (count_++ == n) {
        reached_ = true;
        while (!released_) {
          std::this_thread::yield();
        }
        if (throw_) {
          throw_();
        }
      }
    });
  }
  ~Stopper() { on_snapshot.set({}); }
  bool reached() {
    return wait_for([this] { return reached_.load(); });
  }
  void release(std::function<void()> then = {}) {
    throw_ = std::move(then);
    released_ = true;
  }
  int count() const { return count_; }

 private:
  std::atomic<int> count_ = 0;
  std::atomic<bool> reached_ = false, released_ = false;
  std::function<void()> throw_;
};

}  // namespace

class WorkerExceptionsTest : public QObject {
  Q_OBJECT

  /// The number of the last snapshot of a run with one direction at a time, which makes exactly two
  /// snapshots: after loading and after the direction.
  static constexpr int last_of_one_direction = 1;

 private slots:
  void canceled_while_the_last_snapshot_is_posted_data() {
    QTest::addColumn<QString>("action");
    for (const char* action : {"stop", "restart", "open", "end"}) {
      QTest::newRow(action) << QString(action);
    }
  }
  void canceled_while_the_last_snapshot_is_posted() {
    QFETCH(const QString, action);
    auto w = std::make_unique<Watched>();
    Stopper stopper(last_of_one_direction);
    w->open({Goal::Kind::direction});
    QVERIFY(stopper.reached());
    const auto cancel = [] { throw Canceled(); };
    if (action == "end") {
      // The destructor waits for the worker.
      std::thread later([&] { stopper.release(cancel); });
      w.reset();
      later.join();
      return;
    }
    if (action == "stop") {
      w->runner.stop();
    } else if (action == "restart") {
      w->runner.restart(with_replicas(24), {Goal::Kind::finished});
    } else {
      w->runner.open({"furnace", {with_replicas(24)}, {Goal::Kind::finished}});
    }
    stopper.release(cancel);
    if (action == "stop") {
      QVERIFY(wait_for([&] { return w->runner.state() == RunState::paused; }));
      w->runner.restart(with_replicas(24), {Goal::Kind::finished});
    }
    QVERIFY(w->finishes_with(24));
    QCOMPARE(w->failure, QString());
  }

  void any_exception_of_a_snapshot_becomes_a_message_data() {
    QTest::addColumn<int>("snapshot");
    QTest::addColumn<int>("exception");
    for (int snapshot = 0; snapshot <= last_of_one_direction; ++snapshot) {
      for (int exception = 0; exception < 4; ++exception) {
        QTest::addRow("snapshot %d, exception %d", snapshot, exception) << snapshot << exception;
      }
    }
  }
  void any_exception_of_a_snapshot_becomes_a_message() {
    QFETCH(const int, snapshot);
    QFETCH(const int, exception);
    const char* messages[] = {"emory", "no such thing", "Unknown error", ""};
    Watched w;
    Stopper stopper(snapshot);
    w.open({Goal::Kind::direction});
    QVERIFY(stopper.reached());
    stopper.release([exception] { throw_kind(exception); });
    if (exception < 3) {
      QVERIFY(wait_for([&] { return !w.failure.isEmpty(); }));
      QVERIFY2(w.failure.contains(messages[exception]), qPrintable(w.failure));
    }
    w.failure.clear();
    w.runner.restart(with_replicas(24), {Goal::Kind::finished});
    QVERIFY(w.finishes_with(24));
    QCOMPARE(w.failure, QString());
  }

  // Beginning with each allocation after the snapshot's values, some fail: first allocations of
  // the snapshot, then of its message, of the state, and of the message on the failure.
  void any_allocation_may_fail() {
    for (const int failing : {1, 4, 30}) {
      for (int allocation = 0; allocation < 40; ++allocation) {
        Watched w;
        Stopper stopper(last_of_one_direction);
        w.open({Goal::Kind::direction});
        QVERIFY(stopper.reached());
        allocations_may_fail = true;
        stopper.release([=] {
          failing_allocations = failing;
          allocations_left = allocation;
        });
        QVERIFY(wait_for([&] { return w.runner.state() == RunState::paused; }));
        allocations_may_fail = false;
        w.runner.restart(with_replicas(24), {Goal::Kind::finished});
        QVERIFY2(w.finishes_with(24), qPrintable(QString::number(allocation)));
      }
    }
  }

  // Starting a run cancels the solver of the previous run, which cannot continue any more.
  void a_run_that_could_not_start_is_tried_again() {
    Watched w;
    w.open({Goal::Kind::direction});
    QVERIFY(wait_for([&] { return w.runner.state() == RunState::paused && w.snapshot; }));
    SolveOptions impossible = with_replicas(8);
    impossible.replicas = 9;
    for (const bool again : {false, true}) {
      w.failure.clear();
      if (again) {
        w.runner.run();
      } else {
        w.runner.restart(impossible, {Goal::Kind::finished});
      }
      QVERIFY(wait_for([&] { return !w.failure.isEmpty(); }, 10000));
      QVERIFY2(w.failure.contains("replicas"), qPrintable(w.failure));
      QVERIFY(wait_for([&] { return w.runner.state() == RunState::paused; }));
    }
    w.failure.clear();
    w.runner.restart(with_replicas(24), {Goal::Kind::finished});
    QVERIFY(w.finishes_with(24));
    QCOMPARE(w.failure, QString());
  }

  void the_painter_goes_on_after_any_exception_data() {
    QTest::addColumn<int>("exception");
    for (int exception = 0; exception < 3; ++exception) {
      QTest::addRow("exception %d", exception) << exception;
    }
  }
  void the_painter_goes_on_after_any_exception() {
    QFETCH(const int, exception);
    SolvedWindow solved("furnace");
    QVERIFY(solved.ready);
    TestWindow& window = *solved.window;
    window.focus.go_to({0, 3, 2});
    QVERIFY(wait_for([&] { return window.settled(); }));
    MapCanvas& canvas = *solved.map_view->canvas();
    const QImage before = canvas.grab().toImage();
    const auto main_thread = std::this_thread::get_id();
    on_picture.set([=] {
      if (std::this_thread::get_id() != main_thread) {
        throw_kind(exception);
      }
    });
    int painted = 0;
    connect(&canvas, &MapCanvas::painted, this, [&] { ++painted; });
    canvas.set_view({2, {}});
    QVERIFY(wait_for([&] { return painted > 0 && canvas.up_to_date(); }));
    on_picture.set({});
    canvas.set_view({});
    QVERIFY(wait_for([&] { return canvas.up_to_date(); }));
    QVERIFY(canvas.grab().toImage() == before);
  }
};

int main(int argc, char** argv) { return run_as_viewer<WorkerExceptionsTest>(argc, argv); }
#include "worker_exceptions_test.moc"
