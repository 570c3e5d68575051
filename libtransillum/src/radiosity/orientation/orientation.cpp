// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Decides which side of each part of a scene is lit, and counts what has to be changed. Input: the
// connected components (face_parts.h) and what random walks from both of their sides reach
// (part_exposure.h). Reasons for the rules: decisions/0047-orientation.md.
#include "transillum/orientation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/box_tree.h"
#include "radiosity/orientation/part_exposure.h"
#include "scene/build/warnings.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// Both sides of a part are seen if walks from one reach at least this fraction of what walks from
/// the other reach.
constexpr double alike = 0.5;
/// The same for parts that emit, whose light a second side would double.
constexpr double alike_if_it_emits = 0.8;
/// Share of the walks below which meeting another part tells nothing about an open part.
constexpr double least_meetings = 0.02;
/// Share of the walks below which nothing is inside a closed part: rays that rounding lets through.
constexpr double leaking = 0.002;

/// Area of parts within the bounding box of a closed part, relative to its own area, from which on
/// it may be a room among others.
constexpr double contents = 0.05;

/// The decision about a part: `kept` with the orientation of most of its area.
enum class Verdict { kept, opposite, two_sided };

/// `kept` or `opposite`, whichever side has more; `otherwise` if they are alike.
Verdict larger(double front, double back, double limit, Verdict otherwise) {
  if (std::min(front, back) >= limit * std::max(front, back)) {
    return otherwise;
  }
  return front > back ? Verdict::kept : Verdict::opposite;
}

/// How much of the scene a side is exposed to: other parts by their area, and light.
double exposed(const SideExposure& side) { return side.other_area + side.lit; }

/// A room is lit inside: it contains other parts, and outside there are none, or few. All other
/// closed parts are solids.
/// @param contained area of the parts within its bounding box, m².
bool is_room(const SideExposure& inside, const SideExposure& outside, double contained, double area,
             bool has_light) {
  const double weight = has_light ? 1 : 0;  // without light, every outside is open to the sky
  return inside.met_other >= leaking &&
         (outside.met_other < leaking ||
          (contained >= contents * area && outside.other_area + weight * outside.lit <
                                               alike * (inside.other_area + weight * inside.lit)));
}

Verdict verdict_on(const SurfacePart& part, const PartExposure& exposure, bool alone, bool emits,
                   double contained, bool has_light) {
  const auto& [front, back] = exposure;
  if (!part.orientable) {
    return Verdict::two_sided;
  }
  const bool meets = std::max(front.met_other, back.met_other) >= least_meetings;
  if (alone || (!part.closed && !meets)) {
    // Only its own light could tell: a room has its lamp inside.
    return emits ? larger(front.own_area, back.own_area, alike, Verdict::kept) : Verdict::kept;
  }
  if (part.closed) {
    const bool outward = part.volume > 0;
    const bool room = outward ? is_room(back, front, contained, part.area, has_light)
                              : is_room(front, back, contained, part.area, has_light);
    return outward != room ? Verdict::kept : Verdict::opposite;
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
        parts_(find_parts(scene_, cancellation)) {}

  OrientationPlan plan(int threads, const Cancellation& cancellation,
                       const std::function<void(double)>& progress) {
    const EmbreeScene embree(scene_, cancellation);
    const auto exposure = measure_exposure(scene_, embree, parts_, threads, cancellation, progress);
    find_emitting();
    verdicts_.reserve(exposure.size());
    const bool alone = is_alone();
    const std::vector<double> contained = contained_areas();
    for (std::size_t p = 0; p < exposure.size(); ++p) {
      verdicts_.push_back(verdict_on(parts_.parts[p], exposure[p], alone, emits_[p], contained[p],
                                     scene_.has_light()));
    }
    set_faces();
    count();
    write_sentences();
    return std::move(plan_);
  }

 private:
  /// Whether the scene has one part and nothing else.
  bool is_alone() const {
    return parts_.parts.size() == 1 &&
           std::all_of(parts_.first.begin(), parts_.first.end(),
                       [this](PatchId i) { return at(parts_.part, i) == 0; });
  }

  /// By closed part: the area of the other parts whose bounding boxes are within its own, m².
  std::vector<double> contained_areas() const {
    std::vector<Bounds> boxes;
    for (const SurfacePart& part : parts_.parts) {
      boxes.push_back(part.bounds);
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
          areas[p] += at(parts_.parts, other).area;
        }
      };
      if (parts_.parts[p].closed) {
        tree.for_each(reaches, visit);
      }
    }
    return areas;
  }

  void find_emitting() {
    emits_.assign(parts_.parts.size(), false);
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      if (max_abs(scene_.exitance(i)) > 0 && at(parts_.part, i) != SurfaceParts::none) {
        at(emits_, at(parts_.part, i)) = true;
      }
    }
  }

  void set_faces() {
    plan_.turned.assign(description_.face_count(), false);
    plan_.two_sided.assign(description_.face_count(), false);
    for (std::size_t f = 0; f < description_.face_count(); ++f) {
      plan_.numbers.push_back(description_.number_of(f));
    }
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      const PatchId first = at(parts_.first, i);
      const std::int32_t part = at(parts_.part, first);
      if (part == SurfaceParts::none ||
          description_.is_two_sided(static_cast<std::size_t>(scene_.patch(i).face))) {
        continue;
      }
      const Verdict verdict = at(verdicts_, part);
      const std::int32_t face = scene_.patch(i).face;
      const bool turned = (at(parts_.sign, first) < 0) != (verdict == Verdict::opposite);
      if (verdict == Verdict::two_sided) {
        // The later of two faces on the same points would only hide the first.
        at(plan_.two_sided, face) = first == i;
      } else if (turned) {
        at(plan_.turned, face) = true;
      }
    }
  }

  void count() {
    OrientationReport& report = plan_.report;
    report.faces = static_cast<std::int64_t>(description_.face_count());
    report.parts = static_cast<std::int64_t>(parts_.parts.size());
    std::vector<bool> part_turned(parts_.parts.size()), part_two_sided(parts_.parts.size());
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      const std::int32_t part = at(parts_.part, i);
      if (part != SurfaceParts::none) {
        const std::int32_t face = scene_.patch(i).face;
        at(part_turned, part) = at(part_turned, part) || at(plan_.turned, face);
        at(part_two_sided, part) = at(part_two_sided, part) || at(plan_.two_sided, face);
      }
    }
    report.parts_turned = std::count(part_turned.begin(), part_turned.end(), true);
    report.parts_two_sided = std::count(part_two_sided.begin(), part_two_sided.end(), true);
    report.not_orientable = std::count_if(parts_.parts.begin(), parts_.parts.end(),
                                          [](const SurfacePart& p) { return !p.orientable; });
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
    if (!plan_.changes()) {
      report.sentences.emplace_back("no face is turned");
      return;
    }
    report.sentences.push_back(
        fmt::format("of {} in {}: {}", counted(report.faces, "face"), counted(report.parts, "part"),
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
    if (report.not_orientable > 0) {
      report.sentences.push_back(
          fmt::format("{} cannot be oriented, as a Moebius strip cannot: made two-sided",
                      counted(report.not_orientable, "part")));
    }
  }

  const SceneDescription& description_;
  Scene scene_;
  SurfaceParts parts_;
  std::vector<bool> emits_;        ///< by part
  std::vector<Verdict> verdicts_;  ///< by part
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
