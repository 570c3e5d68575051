// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// How long the UI thread is blocked while the solver runs, and how long seeks and sliders take.
// Prints the measured times; the bounds are generous, for slow machines.
#include <QElapsedTimer>
#include <QTimer>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "window_support.h"

namespace transillum::viewer::responsiveness_test {

using namespace test;

namespace {

/// The times that threads were ready to run but waited for a processor.
class ProcessorWaits {
 public:
  /// Watches this thread, and those by which Mesa draws without a GPU: this thread waits for them.
  ProcessorWaits() {
    for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
      std::string name;
      if (std::getline(std::ifstream(thread.path() / "comm"), name) &&
          name.starts_with("llvmpipe")) {
        threads_.push_back(thread.path() / "schedstat");
      }
    }
    waited_.resize(threads_.size());
    longest_since_last();
  }

  /// The longest wait of a thread since the last call, ms; 0 if the kernel does not count it.
  double longest_since_last() {
    double longest = 0;
    for (std::size_t k = 0; k < threads_.size(); ++k) {
      std::ifstream file(threads_[k]);
      double ran = 0, waited = 0;
      if (file >> ran >> waited) {
        longest = std::max(longest, waited - waited_[k]);
        waited_[k] = waited;
      }
    }
    return longest * 1e-6;
  }

 private:
  std::vector<std::filesystem::path> threads_{"/proc/thread-self/schedstat"};
  std::vector<double> waited_;  ///< ns
};

/// For waits that include solving: the solver has a lower priority than other work of the machine.
constexpr int long_enough = 300'000;  // ms

double median(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

/// Times of equal actions, ms: wall-clock time, for the report; and processor time, for bounds that
/// do not depend on other work of the machine.
struct Timings {
  std::vector<double> clock, processor;

  void measure(const std::function<void()>& action) {
    QElapsedTimer timer;
    timer.start();
    const std::clock_t before = std::clock();
    action();
    processor.push_back(1e3 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
    clock.push_back(static_cast<double>(timer.nsecsElapsed()) * 1e-6);
  }
};

/// Measures the pauses between iterations of the event loop while it exists, ms.
class Gaps {
 public:
  Gaps() {
    QObject::connect(&tick_, &QTimer::timeout, &tick_, [this] {
      const double gap = static_cast<double>(since_last_.nsecsElapsed()) * 1e-6;
      // The first pictures are separate: a machine without a GPU compiles shaders for them.
      (since_start_.elapsed() < 1000 || first.empty() ? first : later).push_back(gap);
      since_last_.start();
      longest_without_waiting =
          std::max(longest_without_waiting, gap - waits_.longest_since_last());
    });
    since_last_.start();
    since_start_.start();
    tick_.start(1);
  }
  const QTimer& tick() const { return tick_; }
  qint64 elapsed() const { return since_start_.elapsed(); }

  std::vector<double> first, later;
  double longest_without_waiting = 0;

 private:
  QTimer tick_;
  QElapsedTimer since_last_, since_start_;
  ProcessorWaits waits_;
};

/// Runs the event loop until a condition holds, with an action now and then.
/// @returns the longest gap without waiting for a processor, ms; infinity if it never holds
double longest_gap(const std::function<bool()>& until, const std::function<void(int)>& act = {},
                   int interval_ms = 40) {
  const Gaps measured;
  QEventLoop loop;
  QTimer limit;
  limit.start(long_enough);
  QObject::connect(&limit, &QTimer::timeout, &loop, &QEventLoop::quit);
  int count = 0;
  QObject::connect(&measured.tick(), &QTimer::timeout, &loop, [&] {
    if (act && measured.elapsed() > interval_ms * count) {
      act(count++);
    }
    if (until()) {
      loop.quit();
    }
  });
  loop.exec();
  return limit.isActive() ? measured.longest_without_waiting
                          : std::numeric_limits<double>::infinity();
}

}  // namespace

class ResponsivenessTest : public QObject {
  Q_OBJECT

 private slots:
  void the_window_responds_while_the_solver_runs_data() {
    QTest::addColumn<QString>("scene");
    QTest::addColumn<double>("max_patch_area");
    QTest::newRow("20,000 patches") << "sphere-flake" << 0.0;
    QTest::newRow("100,000 patches") << "cornell-box" << 2.5e-5;
  }
  void the_window_responds_while_the_solver_runs() {
    QFETCH(const QString, scene);
    QFETCH(const double, max_patch_area);
    const auto window = make_window(SolveOptions{.directions = 100000, .first_shot = {}});
    window->set_options({.directions = 100000, .first_shot = {}},
                        {.max_patch_area = max_patch_area});
    window->open(scene, {Goal::Kind::finished});
    QVERIFY(
        wait_for([&] { return window->snapshot() && window->snapshot()->progress.direction > 2; },
                 long_enough));

    const int passes_before = window->snapshot()->progress.direction;
    const auto passes = [&] { return window->snapshot()->progress.direction - passes_before; };
    Gaps measured;
    // A machine with other work may need longer for as many gaps. wait_for() is not used here,
    // because it sleeps between event loop iterations.
    QEventLoop loop;
    QTimer limit;
    limit.start(long_enough);
    connect(&limit, &QTimer::timeout, &loop, &QEventLoop::quit);
    connect(&measured.tick(), &QTimer::timeout, &loop, [&] {
      if (measured.elapsed() > 6000 && passes() > 0 && measured.later.size() > 100) {
        loop.quit();
      }
    });
    loop.exec();
    QVERIFY(limit.isActive() && passes() > 0);
    std::vector<double> gaps = measured.later;
    std::sort(gaps.begin(), gaps.end());
    qInfo(
        "%d patches: event loop, ms between iterations: 99 %% below %.1f, longest %.1f; in the "
        "first "
        "second %.1f; longest without waiting for a processor %.1f; %d passes",
        window->snapshot()->loaded->scene->patch_count(), gaps[gaps.size() * 99 / 100], gaps.back(),
        *std::max_element(measured.first.begin(), measured.first.end()),
        measured.longest_without_waiting, passes());
    QTest::setBenchmarkResult(gaps.back(), QTest::WalltimeMilliseconds);
    // On an idle machine it is a few dozen ms.
    QVERIFY(measured.longest_without_waiting < 250);

    QElapsedTimer closing;
    closing.start();
    window->close();
    QVERIFY(closing.elapsed() < 1000);
  }

  void the_window_responds_while_one_works_with_it_data() {
    QTest::addColumn<bool>("linear");
    QTest::newRow("constant") << false;
    QTest::newRow("linear") << true;
  }
  void the_window_responds_while_one_works_with_it() {
    QFETCH(const bool, linear);
    const auto window = make_window(16);
    window->open("furnace");  // shaders are compiled
    QVERIFY(wait_for([&] { return window->snapshot() && window->settled(); }, long_enough) &&
            comes_to_rest(*window));
    SolveOptions options{.directions = 100000, .first_shot = {}};
    options.basis = linear ? Basis::linear : Basis::constant;
    window->set_options(options, {.max_patch_area = 1.3e-4});
    const double loading = longest_gap(
        [&] {
          const auto snapshot = window->snapshot();
          return snapshot && snapshot->loaded->scene->patch_count() > 10'000 &&
                 snapshot->progress.direction > 2;
        },
        [&](int count) {
          if (count == 0) {
            window->open("cornell-box", {Goal::Kind::finished});
          }
        });
    SceneView& view = *window->views().page.scene_view();
    int done = 0;
    const auto count_to = [&done](int count) { return [&done, count] { return done >= count; }; };
    const double turning = longest_gap(count_to(60), [&](int count) {
      view.turn(2, 1);
      done = count;
    });
    DockLayouts& docks = window->views().docks;
    done = 0;
    const double arranging = longest_gap(
        count_to(9),
        [&](int count) {
          const Layout layouts[] = {Layout::teach, Layout::inspect, Layout::debug};
          docks.arrange(layouts[count % 3]);
          done = count;
        },
        400);
    qInfo(
        "%d patches: longest gap without waiting for a processor, ms: loading %.0f, turning the "
        "camera %.0f, changing the layout %.0f",
        window->snapshot()->loaded->scene->patch_count(), loading, turning, arranging);
    QVERIFY(loading < 250);
    QVERIFY(turning < 250);
    QVERIFY(arranging < 250);
  }

  // The goals are 500 ms, and 1.15 times the library's time and the draft's, on an idle machine.
  void a_draft_stands_soon_and_the_window_costs_little() {
    const auto window = make_window(512);
    SolveOptions options{.directions = 512};
    options.basis = Basis::linear;
    window->set_options(options, {.max_patch_area = 1.3e-3});
    window->views().docks.arrange(Layout::inspect);
    Timings whole, draft, plain;
    const auto solve_in_window = [&] {
      const auto old = window->snapshot() ? window->snapshot()->loaded : nullptr;
      const auto is_new = [&] { return window->snapshot() && window->snapshot()->loaded != old; };
      whole.measure([&] {
        draft.measure([&] {
          window->scene.open("cornell-box", window->views().settings.options(),
                             {Goal::Kind::finished});
          QVERIFY(wait_for([&] { return is_new() && window->snapshot()->of_draft; }, long_enough));
          window->repaint();
        });
        QVERIFY(
            wait_for([&] { return window->runner.state() == RunState::finished; }, long_enough));
      });
    };
    solve_in_window();  // shaders are compiled
    solve_in_window();
    QVERIFY(!window->snapshot()->of_draft);
    Solution solution;
    plain.measure([&] {
      solution = solve(window->snapshot()->loaded->scene, window->views().settings.options().solve);
    });
    qInfo(
        "%d patches, ms: draft after %.0f, window %.0f, library %.0f; of processors %.0f %.0f %.0f",
        window->snapshot()->loaded->scene->patch_count(), draft.clock.back(), whole.clock.back(),
        plain.clock.back(), draft.processor.back(), whole.processor.back(), plain.processor.back());
    QVERIFY(window->snapshot()->radiosity == solution.radiosity);
    QVERIFY(draft.processor.back() < plain.processor.back());
    QVERIFY(whole.processor.back() - draft.processor.back() < 2 * plain.processor.back());
  }

  void the_window_responds_while_a_sharp_picture_is_made() {
    const auto window = make_window(64);
    window->set_options({.directions = 64, .first_shot = {}}, {.max_patch_area = 1e-3});
    window->open("cornell-box");
    QVERIFY(wait_for([&] { return window->runner.state() == RunState::finished; }, long_enough) &&
            comes_to_rest(*window));
    QVERIFY(window->snapshot()->loaded->scene->patch_count() > 2000);
    SceneView& view = *window->views().page.scene_view();
    const SharpView& sharp = *window->views().page.sharp();
    view.turn(1, 0);  // shaders are compiled
    const Gaps measured;
    sharp.action()->setChecked(true);
    QEventLoop loop;
    QTimer limit;
    limit.start(long_enough);
    connect(&limit, &QTimer::timeout, &loop, &QEventLoop::quit);
    connect(&sharp, &SharpView::progressed, &loop, [&](double, bool finished) {
      if (finished) {
        loop.quit();
      }
    });
    loop.exec();
    QVERIFY(limit.isActive() && !view.sharp().isNull());
    qInfo(
        "sharp picture of %d patches: %.1f s, longest gap without waiting for a processor %.1f ms",
        window->snapshot()->loaded->scene->patch_count(),
        static_cast<double>(measured.elapsed()) * 1e-3, measured.longest_without_waiting);
    QVERIFY(measured.longest_without_waiting < 250);
  }

  void a_seek_is_shown_quickly() {
    const auto window = make_window(64);
    window->open("sphere-flake", {Goal::Kind::passes, 2});
    QVERIFY(wait_for(
        [&] {
          return window->snapshot() && window->snapshot()->progress.direction >= 2 &&
                 window->settled();
        },
        long_enough));
    Focus& focus = window->focus;
    focus.go_to({0, 1, 100});
    QVERIFY(wait_for([&] { return window->settled(); }));
    QTimer heartbeat;
    heartbeat.start(5);
    const auto time_seeks = [&](int count, const std::function<RunPosition(int)>& to) {
      Timings timings;
      for (int k = 0; k < count; ++k) {
        timings.measure([&] {
          focus.go_to(to(k));
          while (!window->settled()) {
            QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
          }
          window->repaint();
        });
      }
      return timings;
    };
    const std::int32_t steps = focus.map()->history.step_count();
    const Timings same = time_seeks(15, [&](int k) {
      return RunPosition{0, 1, steps * ((7 * k) % 15) / 15};
    });
    const Timings other = time_seeks(5, [&](int k) { return RunPosition{0, 3 + k, steps / 2}; });
    qInfo("seek in the sphere-flake, median ms: same direction %.0f, another %.0f",
          median(same.clock), median(other.clock));
    // The goals are 50 and 500 ms on an idle machine.
    QVERIFY(median(same.processor) < 500);
    QVERIFY(median(other.processor) < 2500);
  }

  // Few directions, to limit the time of the test: measures everything except large form factors.
  void a_change_of_a_slider_is_shown_quickly() {
    constexpr int directions = 32;
    const auto window = make_window(directions);
    window->open("sphere-flake", {Goal::Kind::iteration});
    window->runner.include_form_factors();
    QVERIFY(wait_for([&] { return window->snapshot() && window->snapshot()->form_factors; },
                     long_enough));
    MaterialEdits& edits = window->relighting.edits();
    const std::vector<Material>& own = window->snapshot()->loaded->scene->materials();
    const auto brightest =
        std::max_element(own.begin(), own.end(), [](const auto& a, const auto& b) {
          return max_abs(a.reflectance) < max_abs(b.reflectance);
        });
    const std::string target = "material:" + brightest->name;
    const Rgb reflectance = brightest->reflectance;
    Timings timings;
    for (int k = 1; k <= 9; ++k) {
      const auto before = window->snapshot()->radiosity;
      timings.measure([&] {
        edits.set_reflectance(target, (1 - 0.05 * k) * reflectance);
        QVERIFY(wait_for(
            [&] { return !window->relighting.busy() && window->snapshot()->radiosity != before; },
            long_enough));
        window->repaint();
      });
    }
    qInfo("slider to picture, median ms: %.0f, longest %.0f; %d directions, %lld form factors",
          median(timings.clock), *std::max_element(timings.clock.begin(), timings.clock.end()),
          directions, static_cast<long long>(window->snapshot()->form_factors->value.size()));
    // The goal is 300 ms with 1,024 directions on an idle machine.
    QVERIFY(median(timings.processor) < 1500);
  }
};

const test::Registered registered("responsiveness", test::run_as_viewer<ResponsivenessTest>);

}  // namespace transillum::viewer::responsiveness_test

#include "responsiveness_test.moc"
