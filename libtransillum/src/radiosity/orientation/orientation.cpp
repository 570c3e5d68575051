// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Decides which side of each part of a scene is lit, and counts what has to be changed. Input: the
// connected components (connected_components.h) and what random walks from both of their sides
// reach (component_exposure.h). Reasons for the rules: decisions/0047-orientation.md.
#include "transillum/orientation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/box_tree.h"
#include "radiosity/orientation/component_exposure.h"
#include "radiosity/orientation/planned_backs.h"
#include "scene/build/warnings.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// Both sides of a component are seen if walks from one reach at least this fraction of what walks
/// from the other reach.
constexpr double alike = 0.5;
/// The same for components that emit, whose light a second side would double.
constexpr double alike_if_it_emits = 0.8;
/// Fraction of the walks below which meeting another component tells nothing about an open
/// component.
constexpr double least_meetings = 0.02;
/// Fraction of the walks below which nothing is inside a closed component: rays that rounding lets
/// through.
constexpr double leaking = 0.002;

/// Area of components within the bounding box of a closed component, relative to its own area, from
/// which on it may be a room among others.
constexpr double contents = 0.05;

/// Fraction of what light meets below which two plans have as many backs: what random paths tell.
constexpr double same_backs = 0.01;
/// Fraction of backs up to which a file shows which side is meant to be lit.
constexpr double few_backs = BackFraction::worth_a_warning;

/// Fraction of the walks on an unlit component's side that meet closed components, from which on
/// that side is the inside of a room, and that leave the scene, up to which it is.
constexpr double least_solids = 0.1, most_leaving = 0.05;

/// The decision about a component: `kept` with the orientation of most of its area, `opposite`, lit
/// on both sides, or unchanged, with each of its faces as in the file.
enum class Verdict { kept, opposite, two_sided, unchanged };

/// `kept` or `opposite`, whichever side has more; `otherwise` if they are alike.
Verdict larger(double front, double back, double limit, Verdict otherwise) {
  if (std::min(front, back) >= limit * std::max(front, back)) {
    return otherwise;
  }
  return front > back ? Verdict::kept : Verdict::opposite;
}

/// How much of the scene a side is exposed to: other components by their area, and light.
double exposed(const SideExposure& side) { return side.other_area + side.lit; }

/// A room is lit inside: it contains other components, and outside there are none, or few. All
/// other closed components are solids.
/// @param contained area of the components within its bounding box, m².
bool is_room(const SideExposure& inside, const SideExposure& outside, double contained, double area,
             bool has_light) {
  const double weight = has_light ? 1 : 0;  // without light, every outside is open to the sky
  return inside.met_other >= leaking &&
         (outside.met_other < leaking ||
          (contained >= contents * area && outside.other_area + weight * outside.lit <
                                               alike * (inside.other_area + weight * inside.lit)));
}

/// An open room without light: solids inside, and outside nothing.
bool is_open_room(const SideExposure& inside, const SideExposure& outside) {
  return inside.met_closed >= least_solids && inside.lit <= most_leaving &&
         outside.met_other < least_meetings;
}

Verdict verdict_on(const ConnectedComponent& component, const ComponentExposure& exposure,
                   bool alone, bool emits, double contained, bool has_light) {
  const auto& [front, back] = exposure;
  if (!component.orientable) {
    const Verdict side = larger(exposed(front), exposed(back), alike, Verdict::two_sided);
    return alone || side == Verdict::kept ? Verdict::unchanged : Verdict::two_sided;
  }
  const bool meets = std::max(front.met_other, back.met_other) >= least_meetings;
  if (alone || (!component.closed && !meets)) {
    // Only its own light could tell: a room has its lamp inside.
    return emits ? larger(front.own_area, back.own_area, alike, Verdict::kept) : Verdict::kept;
  }
  if (component.closed) {
    const bool outward = component.volume > 0;
    const bool room = outward ? is_room(back, front, contained, component.area, has_light)
                              : is_room(front, back, contained, component.area, has_light);
    return outward != room ? Verdict::kept : Verdict::opposite;
  }
  if (!has_light && (is_open_room(front, back) || is_open_room(back, front))) {
    return is_open_room(front, back) ? Verdict::kept : Verdict::opposite;
  }
  return emits ? larger(exposed(front), exposed(back), alike_if_it_emits, Verdict::kept)
               : larger(exposed(front), exposed(back), alike, Verdict::two_sided);
}

/// The scene with one patch for each face, and faces numbered by their order.
Scene one_sided(const SceneDescription& description, const Cancellation& cancellation) {
  SceneDescription copy = description;
  copy.face_two_sided.clear();
  copy.face_number.clear();
  copy.joined_to.clear();
  try {
    return {copy, {}, cancellation};
  } catch (const InputError&) {
    const Scene same_error_with_numbers(description, {}, cancellation);
    throw;
  }
}

class Planner {
 public:
  Planner(const SceneDescription& description, const Cancellation& cancellation)
      : description_(description),
        scene_(one_sided(description, cancellation)),
        components_(find_connected_components(scene_, cancellation)),
        has_light_(scene_.has_light()) {}

  OrientationPlan plan(int threads, const Cancellation& cancellation,
                       const std::function<void(double)>& progress) {
    const EmbreeScene embree(scene_, cancellation);
    const auto exposure =
        measure_exposure(scene_, embree, components_, threads, cancellation, progress);
    find_emitting();
    verdicts_.reserve(exposure.size());
    const bool alone = is_alone();
    const std::vector<double> contained = contained_areas();
    for (std::size_t p = 0; p < exposure.size(); ++p) {
      verdicts_.push_back(verdict_on(components_.components[p], exposure[p], alone, emits_[p],
                                     contained[p], has_light_));
    }
    avoid_backs(embree, threads, cancellation);
    set_faces(verdicts_);
    count();
    write_sentences();
    return std::move(plan_);
  }

 private:
  /// Whether the scene has one component and nothing else.
  bool is_alone() const {
    return components_.components.size() == 1 &&
           std::all_of(components_.first.begin(), components_.first.end(),
                       [this](PatchId i) { return at(components_.component, i) == 0; });
  }

  /// By closed component: the area of the other components whose bounding boxes are within its own,
  /// m².
  std::vector<double> contained_areas() const {
    std::vector<Bounds> boxes;
    for (const ConnectedComponent& component : components_.components) {
      boxes.push_back(component.bounds);
    }
    const BoxTree tree(boxes);
    std::vector<double> areas(boxes.size());
    for (std::size_t p = 0; p < boxes.size(); ++p) {
      const Vec3 center = boxes[p].center(), half = 0.5 * (boxes[p].high - boxes[p].low);
      const auto reaches = [&](const CenteredBox& box) {
        const Vec3 apart = box.center - center, sum = box.half + half;
        return std::abs(apart.x) <= sum.x && std::abs(apart.y) <= sum.y &&
               std::abs(apart.z) <= sum.z;
      };
      const auto visit = [&](std::int32_t other) {
        const Bounds& box = at(boxes, other);
        const Vec3 above = boxes[p].high - box.high, below = box.low - boxes[p].low;
        const double least = std::min({above.x, above.y, above.z, below.x, below.y, below.z});
        if (static_cast<std::size_t>(other) != p && least >= 0) {
          areas[p] += at(components_.components, other).area;
        }
      };
      if (components_.components[p].closed) {
        tree.for_each(reaches, visit);
      }
    }
    return areas;
  }

  void find_emitting() {
    emits_.assign(components_.components.size(), false);
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      if (max_abs(scene_.exitance(i)) > 0 &&
          at(components_.component, i) != ConnectedComponents::none) {
        at(emits_, at(components_.component, i)) = true;
      }
    }
  }

  /// Takes back verdicts after which more of what light meets would be backs than in the file.
  void avoid_backs(const EmbreeScene& embree, int threads, const Cancellation& cancellation) {
    const auto is_orientable = [](const ConnectedComponent& c) { return c.orientable; };
    if (!makes_changes(verdicts_) &&
        std::all_of(components_.components.begin(), components_.components.end(), is_orientable)) {
      return;
    }
    const auto measure = [&](const std::vector<Verdict>& verdicts) {
      set_faces(verdicts);
      return measure_planned_backs(scene_, embree, components_, lit_sides(), threads, cancellation);
    };
    const PlannedBacks before = measure({verdicts_.size(), Verdict::unchanged});
    judge_by_backs(before);
    if (!before.is_known || !makes_changes(verdicts_)) {
      return;
    }
    const std::vector<Verdict> all = verdicts_;
    keep_right_components(before, measure(all));
    for (const Verdict undone : {Verdict::two_sided, Verdict::opposite, Verdict::unchanged}) {
      const MetSurfaces now = measure(verdicts_).all;
      if (now.fraction() <= before.all.fraction() + same_backs) {
        break;
      }
      undo(undone, before, now.backs > before.all.backs);
    }
    count_undone(all);
  }

  /// Counts the components of which some faces would have been changed by other verdicts.
  void count_undone(const std::vector<Verdict>& planned) {
    set_faces(planned);
    const std::vector<bool> turned = plan_.turned, two_sided = plan_.two_sided;
    set_faces(verdicts_);
    std::vector<char> is_undone(verdicts_.size());
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      const std::int32_t component = at(components_.component, at(components_.first, i));
      const auto face = static_cast<std::size_t>(scene_.patch(i).face);
      if (component != ConnectedComponents::none &&
          (turned[face] != plan_.turned[face] || two_sided[face] != plan_.two_sided[face])) {
        at(is_undone, component) = 1;
      }
    }
    undone_ = std::count(is_undone.begin(), is_undone.end(), 1);
  }

  /// Takes back verdicts about single components of which the file shows the lit side.
  void keep_right_components(const PlannedBacks& before, const PlannedBacks& after) {
    const bool file_is_right = before.all.fraction() <= few_backs;
    for (std::size_t p = 0; p < verdicts_.size(); ++p) {
      const ConnectedComponent& component = components_.components[p];
      // Without light, a closed component is a solid, unless its inside sees lit sides of others.
      const bool is_shown =
          has_light_ || (component.closed && file_is_right && sees_lit_sides(before.others[p]));
      const bool has_more = after.share(p) > before.share(p) + same_backs;
      if (verdicts_[p] == Verdict::opposite && is_shown && has_more) {
        verdicts_[p] = Verdict::kept;
      }
    }
  }

  /// Components that cannot be oriented stay as in the file where few of their backs are seen, if
  /// their outside is lit, or the light of the file's lit sides tells.
  void judge_by_backs(const PlannedBacks& before) {
    for (std::size_t p = 0; p < verdicts_.size(); ++p) {
      if (!components_.components[p].orientable) {
        const MetSurfaces& own = before.own[p];
        const bool is_shown = has_light_ ? own.met > 0 : sees_lit_sides(before.others[p]);
        const bool is_outside = verdicts_[p] == Verdict::unchanged;
        const auto seen = static_cast<double>(own.met + before.starts[p]);
        const bool is_right = static_cast<double>(own.backs) <= few_backs * seen;
        verdicts_[p] =
            is_right && (is_outside || is_shown) ? Verdict::unchanged : Verdict::two_sided;
      }
    }
  }
  static bool sees_lit_sides(const MetSurfaces& others) {
    return others.met > 0 && others.fraction() <= few_backs;
  }

  /// Takes back verdicts of one kind; `unchanged`: all that are left. Where nothing emits, only of
  /// open components, and where the file shows their lit side: by few backs, or since they see
  /// more lit sides of others than backs.
  /// @param more_backs paths end at more backs than in the file, not only at fewer other surfaces
  void undo(Verdict kind, const PlannedBacks& before, bool more_backs) {
    for (std::size_t p = 0; p < verdicts_.size(); ++p) {
      const ConnectedComponent& component = components_.components[p];
      const MetSurfaces& others = before.others[p];
      const bool is_shown = more_backs || before.all.fraction() <= few_backs ||
                            (others.met > 0 && others.backs <= others.met - others.backs);
      if (has_light_ || (!component.closed && is_shown)) {
        if (kind == Verdict::unchanged) {
          verdicts_[p] = Verdict::unchanged;
        } else if (verdicts_[p] == kind) {
          verdicts_[p] = component.orientable ? Verdict::kept : Verdict::unchanged;
        }
      }
    }
  }

  bool makes_changes(const std::vector<Verdict>& verdicts) {
    set_faces(verdicts);
    return changes();
  }
  bool changes() const {
    return std::find(plan_.turned.begin(), plan_.turned.end(), true) != plan_.turned.end() ||
           std::find(plan_.two_sided.begin(), plan_.two_sided.end(), true) != plan_.two_sided.end();
  }

  /// By patch: its lit sides in plan_.
  std::vector<LitSides> lit_sides() const {
    std::vector<LitSides> lit;
    for (const Patch& patch : scene_.patches()) {
      const bool both = at(plan_.two_sided, patch.face) ||
                        description_.is_two_sided(static_cast<std::size_t>(patch.face));
      const bool turned = at(plan_.turned, patch.face);
      lit.push_back({both || !turned, both || turned});
    }
    return lit;
  }

  void set_faces(const std::vector<Verdict>& verdicts) {
    plan_.turned.assign(description_.face_count(), false);
    plan_.two_sided.assign(description_.face_count(), false);
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      const PatchId first = at(components_.first, i);
      const std::int32_t component = at(components_.component, first);
      if (component == ConnectedComponents::none ||
          description_.is_two_sided(static_cast<std::size_t>(scene_.patch(i).face))) {
        continue;
      }
      const Verdict verdict = at(verdicts, component);
      if (verdict == Verdict::unchanged) {
        continue;
      }
      const std::int32_t face = scene_.patch(i).face;
      const bool turned = (at(components_.sign, first) < 0) != (verdict == Verdict::opposite);
      if (verdict == Verdict::two_sided) {
        // The later of two faces on the same points would only hide the first.
        at(plan_.two_sided, face) = first == i;
      } else if (turned) {
        at(plan_.turned, face) = true;
      }
    }
  }

  void count() {
    for (std::size_t f = 0; f < description_.face_count(); ++f) {
      plan_.numbers.push_back(description_.number_of(f));
    }
    OrientationReport& report = plan_.report;
    report.faces = static_cast<std::int64_t>(description_.face_count());
    report.components = static_cast<std::int64_t>(components_.components.size());
    std::vector<bool> component_turned(components_.components.size()),
        component_two_sided(components_.components.size());
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      const std::int32_t component = at(components_.component, i);
      if (component != ConnectedComponents::none) {
        const std::int32_t face = scene_.patch(i).face;
        at(component_turned, component) = at(component_turned, component) || at(plan_.turned, face);
        at(component_two_sided, component) =
            at(component_two_sided, component) || at(plan_.two_sided, face);
      }
    }
    report.components_turned = std::count(component_turned.begin(), component_turned.end(), true);
    report.components_two_sided =
        std::count(component_two_sided.begin(), component_two_sided.end(), true);
    report.not_orientable =
        std::count_if(components_.components.begin(), components_.components.end(),
                      [](const ConnectedComponent& p) { return !p.orientable; });
    report.faces_turned = std::count(plan_.turned.begin(), plan_.turned.end(), true);
    report.faces_two_sided = std::count(plan_.two_sided.begin(), plan_.two_sided.end(), true);
    std::vector<std::string> names;
    for (const Material& material : description_.materials) {
      names.push_back(material.name);
    }
    report.materials =
        counts(names, [this](std::size_t f) { return description_.face_material[f]; });
    report.groups =
        counts(description_.groups, [this](std::size_t f) { return description_.group_of(f); });
  }

  /// Counts by material or group, without those that have no changes.
  template <class Kind>
  std::vector<OrientationCount> counts(const std::vector<std::string>& names,
                                       const Kind& kind_of) const {
    std::vector<OrientationCount> all(names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
      all[k].name = names[k];
    }
    for (std::size_t f = 0; f < description_.face_count(); ++f) {
      if (const std::int32_t kind = kind_of(f); kind >= 0) {
        OrientationCount& count = at(all, kind);
        ++count.faces;
        count.turned += plan_.turned[f] ? 1 : 0;
        count.two_sided += plan_.two_sided[f] ? 1 : 0;
      }
    }
    std::erase_if(all, [](const OrientationCount& c) { return c.turned + c.two_sided == 0; });
    return all;
  }

  /// "3 turned, 2 made two-sided", without what did not happen.
  static std::string changes_text(std::int64_t turned, std::int64_t two_sided) {
    return fmt::format("{}{}{}", turned > 0 ? fmt::format("{} turned", turned) : std::string(),
                       turned > 0 && two_sided > 0 ? ", " : "",
                       two_sided > 0 ? fmt::format("{} made two-sided", two_sided) : std::string());
  }

  void write_sentences() {
    OrientationReport& report = plan_.report;
    const auto counted = [](std::int64_t n, const char* what) {
      return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
    };
    if (undone_ > 0) {
      report.sentences.push_back(fmt::format(
          "{} left mostly as in the file, since more of what light meets would be backs after a "
          "change",
          counted(undone_, "part")));
    }
    if (!plan_.changes()) {
      report.sentences.emplace_back("no face is turned");
      return;
    }
    report.sentences.push_back(fmt::format(
        "of {} in {}: {}", counted(report.faces, "face"), counted(report.components, "part"),
        changes_text(report.faces_turned, report.faces_two_sided)));
    Warnings list;
    const bool by_group = !report.groups.empty();
    for (const OrientationCount& c : by_group ? report.groups : report.materials) {
      list.add(by_group ? "groups" : "materials",
               fmt::format("of {} of {} \"{}\": {}", counted(c.faces, "face"),
                           by_group ? "group" : "material", c.name,
                           changes_text(c.turned, c.two_sided)));
    }
    const std::vector<std::string> sentences = list.sentences();
    report.sentences.insert(report.sentences.end(), sentences.begin(), sentences.end());
    std::int64_t two_sided = 0, kept = 0;
    for (std::size_t p = 0; p < verdicts_.size(); ++p) {
      if (!components_.components[p].orientable) {
        ++(verdicts_[p] == Verdict::two_sided ? two_sided : kept);
      }
    }
    const auto add = [&](std::int64_t parts, const char* what) {
      if (parts > 0) {
        report.sentences.push_back(fmt::format(
            "{} cannot be oriented, as a Moebius strip cannot: {}", counted(parts, "part"), what));
      }
    };
    add(two_sided, "made two-sided");
    add(kept, "left as in the file, since few backs are seen");
  }

  const SceneDescription& description_;
  Scene scene_;
  ConnectedComponents components_;
  bool has_light_;
  std::vector<bool> emits_;        ///< by component
  std::vector<Verdict> verdicts_;  ///< by component
  std::int64_t undone_ = 0;        ///< number of verdicts that avoid_backs() has taken back
  OrientationPlan plan_;
};

}  // namespace

OrientationPlan plan_orientation(const SceneDescription& description, int threads,
                                 const Cancellation& cancellation,
                                 const std::function<void(double)>& progress) {
  return Planner(description, cancellation).plan(threads, cancellation, progress);
}

void apply(const OrientationPlan& plan, SceneDescription& description) {
  for (std::size_t f = 0; f < description.face_count(); ++f) {
    if (plan.turned[f]) {
      const auto first =
          description.corners.begin() + static_cast<std::ptrdiff_t>(description.face_begin[f]);
      std::reverse(first, first + std::ssize(description.outline(f)));
    }
    if (plan.two_sided[f]) {
      description.face_two_sided.resize(description.face_count(), 0);
      description.face_two_sided[f] = 1;
    }
  }
}

OrientationReport orient(SceneDescription& description, int threads,
                         const Cancellation& cancellation,
                         const std::function<void(double)>& progress) {
  OrientationPlan plan = plan_orientation(description, threads, cancellation, progress);
  apply(plan, description);
  return std::move(plan.report);
}

}  // namespace transillum
