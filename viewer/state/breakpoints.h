// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "state/focus.h"
#include "state/step_events.h"

class QSettings;
class QUndoStack;

namespace transillum::viewer {

/// A condition on a step.
struct Condition {
  enum class Kind {
    patch,           ///< the step processes, cuts or covers a polygon of `patch`
    cut,             ///< the step cuts a fragment of `patch`
    pair,            ///< `patch` and `other` exchange light, either way
    small_fragment,  ///< the step makes a fragment smaller than `value` m²
    open_receiver,   ///< the closure defect of the step's receiver exceeds `value`, 0 to 1
    large_map,       ///< V has more than `value` polygons
    growing_map,     ///< the step makes V have more than `value` polygons, which it had not before
  };
  Kind kind = Kind::patch;
  PatchId patch = 0, other = 0;
  double value = 0;

  friend bool operator==(const Condition&, const Condition&) = default;
};

/// Conditions joined by "and" and "or"; a run through the steps stops where they hold. "And" binds
/// more strongly than "or".
struct Breakpoint {
  using Kind = Condition::Kind;
  /// A further condition, and how it is joined to the previous conditions.
  struct Further {
    bool alternative = false;  ///< by "or"
    Condition condition;

    friend bool operator==(const Further&, const Further&) = default;
  };
  static constexpr int most_hits = 1'000'000'000;

  Condition condition;
  bool enabled = true;
  std::vector<Further> further = {};
  int stop_at = 1;  ///< stops at this hit, counted from where the run begins; 1 to most_hits

  friend bool operator==(const Breakpoint&, const Breakpoint&) = default;
};

bool holds(const Condition& condition, const MapHistory& history, std::int32_t step);
bool holds(const Breakpoint& breakpoint, const MapHistory& history, std::int32_t step);
QString text_of(const Condition& condition);
/// The conditions and, unless it is 1, the hit to stop at.
QString text_of(const Breakpoint& breakpoint);
/// The name of a kind in files and settings.
const char* name_of(Condition::Kind kind);
std::optional<Condition::Kind> breakpoint_kind(const std::string& name);

/// The steps of a run at which something held.
struct HitCount {
  std::int64_t steps = 0;
  std::optional<RunPosition> first = {};  ///< the first that the run came to
};

/// The hits of a breakpoint in a run.
struct BreakpointHits : HitCount {
  std::vector<HitCount> conditions = {};  ///< each by itself
};
/// By breakpoint of the list.
using HitCounts = std::vector<BreakpointHits>;

/// When each condition of a breakpoint that never held was true; empty for one that held, or that
/// has one condition.
QString text_of_miss(const Breakpoint& breakpoint, const BreakpointHits& hits);

/// The list of breakpoints of the open scene: patches of another scene have the same numbers. The
/// lists of all scenes are saved in the settings between runs of the program.
class Breakpoints : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  /// Changes can be undone there, except set_list() and load(). Without a stack, they cannot.
  void set_undo_stack(QUndoStack* undo) { undo_ = undo; }
  const std::vector<Breakpoint>& list() const { return list_; }
  void set_list(std::vector<Breakpoint> list);
  /// Replaces the list by the list of another scene.
  /// @param scene a file or a built-in, as it was opened; the list is not saved if this is empty
  void set_scene(const std::string& scene);
  /// Sets the list of a scene, which may be opened later.
  void set_list_of(const std::string& scene, std::vector<Breakpoint> list);
  void add(const Breakpoint& breakpoint);
  void remove(std::size_t k);
  void set_enabled(std::size_t k, bool enabled);
  /// Joins a condition to the conditions of breakpoint k.
  void join(std::size_t k, const Breakpoint::Further& further);
  /// Removes the last condition of breakpoint k, unless it is the only one.
  void remove_last_condition(std::size_t k);
  void set_stop_at(std::size_t k, int hit);
  bool any_enabled() const;

  /// Finds the nearest step where an enabled breakpoint holds.
  StepFinder finder() const;
  /// The finder for one run: it finds where an enabled breakpoint has the hit at which it stops. A
  /// step is counted once, even if the search comes back to its direction.
  /// @param hits  receives the counts of the run so far; the finder keeps it
  /// @param searched  the position whose direction is searched; its step is not used
  StepFinder run_finder(std::shared_ptr<HitCounts> hits,
                        std::function<RunPosition()> searched) const;
  /// All steps of a direction where a breakpoint holds, ascending.
  std::vector<std::int32_t> steps_in(const MapHistory& history) const;

  void save(QSettings& settings) const;
  /// Entries that cannot be read are skipped.
  void load(QSettings& settings);

 signals:
  void changed();

 private:
  void change(const QString& what, std::vector<Breakpoint> list);
  void change(const QString& what, std::size_t k, const Breakpoint& changed);

  std::string scene_;
  std::vector<Breakpoint> list_;
  std::map<std::string, std::vector<Breakpoint>> other_lists_;  ///< lists of other scenes
  QUndoStack* undo_ = nullptr;
};

}  // namespace transillum::viewer
