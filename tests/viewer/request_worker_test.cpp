// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// RequestWorker: exceptions of jobs become messages, the newest request replaces older ones, pauses
// between jobs.
#include "support/request_worker.h"

#include <QtTest>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

#include "registered.h"

namespace transillum::viewer::request_worker_test {

namespace {

/// The actions of a worker: written on its thread, read by the test.
class Log {
 public:
  void add(int number, const QString& text = {}) {
    {
      const std::lock_guard lock(mutex_);
      entries_.emplace_back(number, text);
    }
    changed_.notify_all();
  }
  std::vector<std::pair<int, QString>> wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(30), [&] { return entries_.size() >= count; });
    return entries_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::pair<int, QString>> entries_;
};

/// Blocks jobs until it is opened.
class Gate {
 public:
  void open() {
    {
      const std::lock_guard lock(mutex_);
      open_ = true;
    }
    changed_.notify_all();
  }
  void pass() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return open_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool open_ = false;
};

using Entries = std::vector<std::pair<int, QString>>;

}  // namespace

class RequestWorkerTest : public QObject {
  Q_OBJECT

 private slots:
  void reports_every_exception_and_goes_on() {
    Log done, failed;
    RequestWorker<int> worker(
        [&](int number, const Cancellation&) {
          switch (number) {
            case 1:
              throw std::bad_alloc();
            case 2:
              throw std::runtime_error("no such thing");
            case 3:
              throw 7;  // NOLINT(hicpp-exception-baseclass)
            default:
              done.add(number);
          }
        },
        [&](int number, const QString& message) { failed.add(number, message); });
    const char* messages[] = {"Not enough memory", "no such thing", "Unknown error"};
    for (int number = 1; number <= 3; ++number) {
      worker.request(number);
      const Entries entries = failed.wait_for(static_cast<std::size_t>(number));
      QCOMPARE(entries.size(), static_cast<std::size_t>(number));
      QCOMPARE(entries.back().first, number);
      QCOMPARE(entries.back().second, QString(messages[number - 1]));
    }
    worker.request(4);
    QCOMPARE(done.wait_for(1), (Entries{{4, {}}}));
  }

  void continues_after_a_throwing_failure_handler() {
    Log done;
    RequestWorker<int> worker(
        [&](int number, const Cancellation&) {
          done.add(number);
          throw std::runtime_error("failed");
        },
        [](int, const QString&) { throw std::bad_alloc(); });
    worker.request(1);
    done.wait_for(1);
    worker.request(2);
    QCOMPARE(done.wait_for(2), (Entries{{1, {}}, {2, {}}}));
  }

  void runs_the_newest_request_only() {
    Log begun, done;
    Gate gate;
    RequestWorker<int> worker(
        [&](int number, const Cancellation&) {
          begun.add(number);
          gate.pass();
          done.add(number);
        },
        [](int, const QString&) {});
    worker.request(1);
    begun.wait_for(1);
    for (int number = 2; number <= 5; ++number) {
      worker.request(number, CurrentJob::finish);
    }
    gate.open();
    QCOMPARE(done.wait_for(2), (Entries{{1, {}}, {5, {}}}));
  }

  void cancels_the_current_job_without_a_message() {
    Log begun, done, failed;
    RequestWorker<int> worker(
        [&](int number, const Cancellation& cancellation) {
          begun.add(number);
          // NOLINTNEXTLINE(bugprone-infinite-loop): the cancellation ends it
          while (number == 1) {
            cancellation.throw_if_canceled();
            std::this_thread::yield();
          }
          done.add(number);
        },
        [&](int number, const QString& message) { failed.add(number, message); });
    worker.request(1);
    begun.wait_for(1);
    worker.request(2);
    QCOMPARE(done.wait_for(1), (Entries{{2, {}}}));
    QVERIFY(failed.wait_for(0).empty());
  }

  void clear_returns_the_waiting_request() {
    Log begun;
    Gate gate;
    RequestWorker<int> worker(
        [&](int number, const Cancellation&) {
          begun.add(number);
          gate.pass();
        },
        [](int, const QString&) {});
    QVERIFY(!worker.clear());
    worker.request(1);
    begun.wait_for(1);
    worker.request(2, CurrentJob::finish);
    const std::optional<int> waiting = worker.clear();
    gate.open();
    QVERIFY(waiting);
    QCOMPARE(*waiting, 2);
  }

  void a_request_after_the_pause_begins_at_its_end() {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds pause{40};
    Log done;
    Clock::time_point times[2];
    RequestWorker<int> worker(
        [&](int number, const Cancellation&) {
          times[number] = Clock::now();
          done.add(number);
        },
        [](int, const QString&) {}, {pause, 0});
    worker.request(0, CurrentJob::finish, Start::at_once);
    done.wait_for(1);
    worker.request(1, CurrentJob::finish, Start::after_pause);
    QCOMPARE(done.wait_for(2), (Entries{{0, {}}, {1, {}}}));
    QVERIFY(times[1] - times[0] >= pause);  // the first job ended after its time
  }

  void a_request_at_once_replaces_one_that_waits_and_ends_its_pause() {
    Log done;
    RequestWorker<int> worker([&](int number, const Cancellation&) { done.add(number); },
                              [](int, const QString&) {}, {std::chrono::minutes(5), 0});
    worker.request(1, CurrentJob::finish, Start::at_once);
    done.wait_for(1);
    worker.request(2, CurrentJob::finish, Start::after_pause);
    worker.request(3, CurrentJob::finish, Start::at_once);
    QCOMPARE(done.wait_for(2), (Entries{{1, {}}, {3, {}}}));
  }

  void the_destructor_does_not_wait_for_the_pause() {
    Log done;
    std::chrono::steady_clock::time_point begin;
    {
      RequestWorker<int> worker([&](int number, const Cancellation&) { done.add(number); },
                                [](int, const QString&) {}, {std::chrono::minutes(5), 0});
      worker.request(1, CurrentJob::finish, Start::at_once);
      done.wait_for(1);
      worker.request(2, CurrentJob::finish, Start::after_pause);
      begin = std::chrono::steady_clock::now();
    }
    QVERIFY(std::chrono::steady_clock::now() - begin < std::chrono::minutes(1));
    QCOMPARE(done.wait_for(1), (Entries{{1, {}}}));
  }
};

const test::Registered registered("request_worker", test::run_without_widgets<RequestWorkerTest>);

}  // namespace transillum::viewer::request_worker_test

#include "request_worker_test.moc"
