// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The number of patches after refinement, without refining: the parts that PatchBuilder::refine()
// divides are found once, and their grids are counted for any limit of the area.
#include "scene/build/patch_count.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/memory_limit.h"
#include "scene/build/patch_builder.h"
#include "scene/build/refinement.h"
#include "scene/build/two_sided.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr std::int64_t too_many = std::int64_t{1} << 62;
constexpr int bisections = 60;
/// Resident memory of solves of cornell-box, rooms and sphere-flake with 5,000 to 230,000 patches.
constexpr std::uint64_t bytes_per_patch = 1700, bytes_of_the_program = 40'000'000;
/// Of a patch in each replica, for each of its unknowns: B, H and what is gathered.
constexpr std::uint64_t bytes_per_replica = 200;
/// Memory for each further unknown of a patch, with the moments of the passes under way: 1,475 to
/// 1,820 in the same scenes on two threads.
constexpr std::uint64_t bytes_per_unknown = 1800;

/// The triangles and quadrilaterals that a patch is divided into before grids are laid on them.
std::vector<std::vector<PointId>> parts_of(const Scene& scene, PatchId i,
                                           std::span<const Piece> pieces) {
  std::vector<std::vector<PointId>> parts;
  const bool four_corners = scene.outline(i).size() == 4;
  for (const Piece& piece : pieces) {
    const auto corners = scene.corners(piece);
    if (corners.size() <= 3 || (corners.size() == 4 && four_corners)) {
      parts.emplace_back(corners.begin(), corners.end());
      continue;
    }
    for (const auto& t : triangulate(drop_axis(scene.points(), corners, scene.patch(i).normal))) {
      parts.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
    }
  }
  return parts;
}

/// Counts the patches of a scene for any limit of their area.
class PatchCounter {
 public:
  explicit PatchCounter(const Scene& scene) : scene_(scene) {
    const std::vector<Piece>& pieces = scene.pieces();
    std::size_t begin = 0;
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      std::size_t end = begin;
      while (end < pieces.size() && pieces[end].patch == i) {
        ++end;
      }
      for (auto& outline : parts_of(scene, i, std::span(pieces).subspan(begin, end - begin))) {
        const double area = measure(scene.points(), outline).area;
        undivided_.push_back({i, area, std::move(outline)});
      }
      begin = end;
    }
  }

  std::int64_t count(double max_area) const {
    std::int64_t total = 0;
    PatchId last = no_patch;
    for (const Undivided& undivided : undivided_) {
      // The same slack as in PatchBuilder::add_part().
      if (scene_.patch(undivided.patch).area * (1 - 1e-9) <= max_area) {
        total += undivided.patch != last ? 1 : 0;
      } else {
        total +=
            choose_grid(scene_.points(), undivided.outline, undivided.area, max_area).cell_count();
      }
      last = undivided.patch;
      if (total >= too_many) {
        return too_many;
      }
    }
    return total;
  }

 private:
  struct Undivided {
    PatchId patch;
    double area;
    std::vector<PointId> outline;
  };

  const Scene& scene_;
  std::vector<Undivided> undivided_;
};

double largest_area(const Scene& scene) {
  double largest = 0;
  for (const Patch& patch : scene.patches()) {
    largest = std::max(largest, patch.area);
  }
  return largest;
}

/// The limit with the number nearest to the wanted one by ratio, of those tried.
struct Nearest {
  std::int64_t wanted;
  double area = 0;
  double ratio = HUGE_VAL;

  void consider(double tried, std::int64_t count) {
    const auto more = static_cast<double>(std::max(count, wanted));
    const auto less = static_cast<double>(std::min(count, wanted));
    if (more / less < ratio) {
      ratio = more / less;
      area = tried;
    }
  }
};

/// The limit with the fewest decimal digits that makes as many patches as `area`.
double with_few_digits(double area, const PatchCounter& counter, const Cancellation& cancellation) {
  if (area == 0) {
    return area;
  }
  const std::int64_t count = counter.count(area);
  for (int digits = 1; digits < std::numeric_limits<double>::digits10; ++digits) {
    cancellation.throw_if_canceled();
    const std::string text = fmt::format("{:.{}e}", area, digits - 1);
    double shorter = 0;
    std::from_chars(text.data(), text.data() + text.size(), shorter);
    if (shorter > 0 && counter.count(shorter) == count) {
      return shorter;
    }
  }
  return area;
}

}  // namespace

std::int64_t count_patches(const Scene& unrefined, double max_patch_area) {
  return PatchCounter(unrefined).count(max_patch_area);
}

std::uint64_t expected_memory(std::int64_t patches, int replicas, int unknowns) {
  const auto further = static_cast<std::uint64_t>(std::max(unknowns - 1, 0));
  const auto of_replicas =
      static_cast<std::uint64_t>(std::max(replicas - 1, 0)) * (further + 1) * bytes_per_replica;
  return bytes_of_the_program + static_cast<std::uint64_t>(patches) *
                                    (bytes_per_patch + of_replicas + further * bytes_per_unknown);
}

void check_memory(const std::string& name, std::int64_t patches, int replicas, int unknowns) {
  if (patches > PatchBuilder::max_patches) {
    return;  // whatever the memory, no scene may have so many, which it says itself
  }
  const std::uint64_t needed = expected_memory(patches, replicas, unknowns);
  const std::uint64_t available = free_memory();
  if (needed > available) {
    const auto gigabytes = [](std::uint64_t bytes) { return 1e-9 * static_cast<double>(bytes); };
    throw std::runtime_error(fmt::format(
        "{}: {} patches{}{} take about {:.2g} GB of memory without form factors, but only "
        "{:.2g} GB are free",
        name, patches, unknowns > 1 ? " with linear functions" : "",
        replicas > 1 ? fmt::format(" in {} replicas", replicas) : "", gigabytes(needed),
        gigabytes(available)));
  }
}

std::int64_t usual_patches(std::size_t faces) {
  constexpr std::size_t few_faces = 1000;
  return faces < few_faces ? 2000 : 0;
}

double max_patch_area_for(const Scene& unrefined, std::int64_t patches,
                          const Cancellation& cancellation) {
  if (patches < 1 || patches > PatchBuilder::max_patches) {
    throw InputError(fmt::format("the number of patches is {}, but must be 1 to {}", patches,
                                 PatchBuilder::max_patches));
  }
  if (unrefined.patch_count() >= patches) {
    return 0;
  }
  const PatchCounter counter(unrefined);
  Nearest nearest{patches};
  nearest.consider(0, unrefined.patch_count());
  double few = largest_area(unrefined), many = few;
  std::int64_t count = unrefined.patch_count();
  const auto try_area = [&](double area) {
    cancellation.throw_if_canceled();
    count = counter.count(area);
    nearest.consider(area, count);
  };
  while (count < patches) {
    few = many;
    many /= 2;
    try_area(many);
  }
  for (int k = 0; k < bisections && nearest.ratio > 1 && few > many * (1 + 1e-12); ++k) {
    const double middle = std::sqrt(few) * std::sqrt(many);
    try_area(middle);
    (count < patches ? few : many) = middle;
  }
  return with_few_digits(nearest.area, counter, cancellation);
}

bool has_two_sided_faces(const Scene& scene) {
  for (PatchId i = 0; i + 1 < scene.patch_count(); ++i) {
    if (are_two_sides(scene, i)) {
      return true;
    }
  }
  return false;
}

}  // namespace transillum
