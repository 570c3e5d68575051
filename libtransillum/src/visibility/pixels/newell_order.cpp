// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Newell, Newell and Sancha's depth sort of a scene's pieces along one direction. Heights are
// measured along omega from the transillumination plane; outlines are tested in integer grid
// coordinates (PixelGrid). Piece numbers are indexes into Scene::pieces().
#include "visibility/pixels/painter.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>
#include <string>

#include "transillum/at.h"
#include "transillum/errors.h"
#include "visibility/plane/plane_index.h"

namespace transillum {
namespace {

/// The order of one direction.
class NewellOrder {
 public:
  NewellOrder(const Scene& scene, const PixelGrid& grid, const PieceOutlines& outlines,
              const PatchHeights& heights, const Cancellation& cancellation)
      : scene_(scene),
        grid_(grid),
        outlines_(outlines),
        heights_(heights),
        cancellation_(cancellation),
        index_({-1, -1, static_cast<double>(grid.columns() * grid.units_per_pixel()) + 1,
                static_cast<double>(grid.rows() * grid.units_per_pixel()) + 1},
               scene.pieces().size()) {
    for (const Vec3& p : scene.points()) {
      const Vec3 from_origin = p - grid.frame().origin;
      points_.push_back({grid.frame().project(p), dot(from_origin, grid.frame().omega)});
    }
  }

  std::vector<std::int32_t> find() {
    measure();
    std::vector<std::int32_t> by_height(scene_.pieces().size());
    std::iota(by_height.begin(), by_height.end(), 0);
    std::stable_sort(by_height.begin(), by_height.end(),
                     [this](std::int32_t a, std::int32_t b) { return of(a).high > of(b).high; });
    for (const std::int32_t k : by_height) {
      if (of(k).state == State::waiting) {
        append_after_all_above(k);
      }
    }
    return std::move(order_);
  }

 private:
  enum class State : std::uint8_t { waiting, pending, done };
  struct PieceState {
    double low = 0, high = 0;  ///< heights
    PlaneBox box{};            ///< grid units
    State state = State::done;
  };
  struct HeightPoint {
    Vec2 at;
    double height;
  };
  /// On which sides of another piece's plane the corners of a piece lie.
  struct Sides {
    bool none_below = true, none_above = true;

    void add(double above, double slack) {
      none_below = none_below && above >= -slack;
      none_above = none_above && above <= slack;
    }
  };

  PieceState& of(std::int32_t k) { return at(states_, k); }
  std::span<const PointId> corners(std::int32_t k) const {
    return scene_.corners(outlines_.piece(k));
  }
  const HeightPoint& point(PointId p) const { return at(points_, p); }

  void measure() {
    states_.resize(scene_.pieces().size());
    for (std::int32_t k = 0; k < std::ssize(states_); ++k) {
      if (k % 1024 == 0) {
        cancellation_.throw_if_canceled();
      }
      if (heights_.edge_on(outlines_.patch(k))) {
        continue;
      }
      PieceState& piece = of(k);
      piece.state = State::waiting;
      piece.low = HUGE_VAL;
      piece.high = -HUGE_VAL;
      piece.box = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
      for (const PointId p : corners(k)) {
        piece.low = std::min(piece.low, point(p).height);
        piece.high = std::max(piece.high, point(p).height);
        const auto x = static_cast<double>(outlines_.point(p).x);
        const auto y = static_cast<double>(outlines_.point(p).y);
        piece.box = {std::min(piece.box.x0, x), std::min(piece.box.y0, y),
                     std::max(piece.box.x1, x), std::max(piece.box.y1, y)};
      }
      index_.insert(k, piece.box);
    }
  }

  void append_after_all_above(std::int32_t first) {
    pending_.assign(1, first);
    of(first).state = State::pending;
    while (!pending_.empty()) {
      const std::int32_t k = pending_.back();
      const std::int32_t above = find_above(k);
      if (above < 0) {
        pending_.pop_back();
        of(k).state = State::done;
        index_.erase(k);
        order_.push_back(k);
        continue;
      }
      if (of(above).state == State::pending) {
        fail_on_cycle(above);
      }
      of(above).state = State::pending;
      pending_.push_back(above);
    }
  }

  /// A piece that must precede piece k and is not in the order yet; -1: none.
  std::int32_t find_above(std::int32_t k) {
    found_.clear();
    index_.query(of(k).box, found_);
    for (std::size_t n = 0; n < found_.size(); ++n) {
      if (n % 256 == 0) {
        cancellation_.throw_if_canceled();
      }
      if (must_precede(found_[n], k)) {
        return found_[n];
      }
    }
    return -1;
  }

  /// Whether q lies above p somewhere, so that p must be painted later.
  bool must_precede(std::int32_t q, std::int32_t p) {
    const PatchId of_p = outlines_.patch(p), of_q = outlines_.patch(q);
    if (of_p == of_q) {
      return false;
    }
    const double slack = heights_.slack(of_p) + heights_.slack(of_q);
    if (of(q).high < of(p).low - slack) {
      return false;
    }
    const Sides p_to_q = sides(p, of_q), q_to_p = sides(q, of_p);
    const bool coplanar = p_to_q.none_below && p_to_q.none_above;
    if (!coplanar && (p_to_q.none_below || q_to_p.none_above)) {
      return false;
    }
    if (separates(p, q) || separates(q, p)) {
      return false;
    }
    if (coplanar) {
      return heights_.comes_first(of_q, of_p);
    }
    if (p_to_q.none_above || q_to_p.none_below) {
      return true;
    }
    return is_above_in_overlap(q, p);
  }

  Sides sides(std::int32_t k, PatchId plane) const {
    Sides sides;
    for (const PointId p : corners(k)) {
      sides.add(point(p).height - heights_.height(plane, point(p).at), heights_.slack(plane));
    }
    return sides;
  }

  /// Whether an edge of a separates them: all of b lies on its outer side, or on it.
  bool separates(std::int32_t a, std::int32_t b) const {
    const std::int64_t turn = heights_.front_facing(outlines_.patch(a)) ? 1 : -1;
    const auto of_a = corners(a), of_b = corners(b);
    for (std::size_t k = 0; k < of_a.size(); ++k) {
      const PixelPoint& from = outlines_.point(of_a[k]);
      const PixelPoint& to = outlines_.point(of_a[(k + 1) % of_a.size()]);
      const std::int64_t x = turn * (to.x - from.x), y = turn * (to.y - from.y);
      if (x == 0 && y == 0) {
        continue;
      }
      if (std::all_of(of_b.begin(), of_b.end(), [&](PointId p) {
            const PixelPoint& at = outlines_.point(p);
            return x * (at.y - from.y) <= y * (at.x - from.x);
          })) {
        return true;
      }
    }
    return false;
  }

  /// must_precede() where the tests against the planes do not decide.
  bool is_above_in_overlap(std::int32_t q, std::int32_t p) {
    const PatchId of_p = outlines_.patch(p), of_q = outlines_.patch(q);
    Sides sides;
    for (const Vec2& at : overlap(p, q)) {
      sides.add(heights_.height(of_q, at) - heights_.height(of_p, at),
                heights_.slack(of_p) + heights_.slack(of_q));
    }
    if (!sides.none_below && !sides.none_above) {
      fail_on_intersection(of_p, of_q);
    }
    return !sides.none_above;
  }

  /// Corners of a's projection clipped by the edges of b's.
  const std::vector<Vec2>& overlap(std::int32_t a, std::int32_t b) {
    overlap_.clear();
    for (const PointId p : corners(a)) {
      overlap_.push_back(point(p).at);
    }
    const double turn = heights_.front_facing(outlines_.patch(b)) ? 1 : -1;
    const auto of_b = corners(b);
    for (std::size_t k = 0; k < of_b.size(); ++k) {
      const Vec2 &from = point(of_b[k]).at, &to = point(of_b[(k + 1) % of_b.size()]).at;
      const auto inside = [&](const Vec2& c) {
        return turn * ((to.x - from.x) * (c.y - from.y) - (to.y - from.y) * (c.x - from.x));
      };
      clipped_.clear();
      for (std::size_t n = 0; n < overlap_.size(); ++n) {
        const Vec2 &c = overlap_[n], &d = overlap_[(n + 1) % overlap_.size()];
        const double at_c = inside(c), at_d = inside(d);
        if (at_c >= 0) {
          clipped_.push_back(c);
        }
        if ((at_c > 0 && at_d < 0) || (at_c < 0 && at_d > 0)) {
          const double t = at_c / (at_c - at_d);
          clipped_.push_back({c.x + t * (d.x - c.x), c.y + t * (d.y - c.y)});
        }
      }
      overlap_.swap(clipped_);
    }
    return overlap_;
  }

  std::string direction_text() const {
    const Vec3& omega = grid_.frame().omega;
    return fmt::format("direction {:.4g}, {:.4g}, {:.4g}", omega.x, omega.y, omega.z);
  }

  [[noreturn]] void fail_on_cycle(std::int32_t again) const {
    constexpr std::size_t max_listed = 8;
    std::vector<PatchId> cycle;
    for (auto k = std::find(pending_.begin(), pending_.end(), again); k != pending_.end(); ++k) {
      cycle.push_back(outlines_.patch(*k));
    }
    const std::size_t more = cycle.size() > max_listed ? cycle.size() - max_listed : 0;
    cycle.resize(cycle.size() - more);
    throw InputError(
        fmt::format("{}: {}: patches {}{} overlap in a cycle; the painter's order newell does not "
                    "split patches; order bsp does",
                    scene_.name(), direction_text(), fmt::join(cycle, ", "),
                    more > 0 ? fmt::format(" and {} more", more) : std::string()));
  }

  [[noreturn]] void fail_on_intersection(PatchId a, PatchId b) const {
    throw InputError(
        fmt::format("{}: {}: patches {} and {} intersect; the painter's order newell does not "
                    "split patches; order bsp does",
                    scene_.name(), direction_text(), std::min(a, b), std::max(a, b)));
  }

  const Scene& scene_;
  const PixelGrid& grid_;
  const PieceOutlines& outlines_;
  const PatchHeights& heights_;
  const Cancellation& cancellation_;
  PlaneIndex index_;  ///< index of the pieces not in order_ yet
  std::vector<HeightPoint> points_;
  std::vector<PieceState> states_;
  std::vector<std::int32_t> pending_;  ///< stack: each must come after the next
  std::vector<std::int32_t> order_, found_;
  std::vector<Vec2> overlap_, clipped_;
};

}  // namespace

std::vector<std::int32_t> newell_order(const Scene& scene, const PixelGrid& grid,
                                       const PieceOutlines& outlines, const PatchHeights& heights,
                                       const Cancellation& cancellation) {
  return NewellOrder(scene, grid, outlines, heights, cancellation).find();
}

}  // namespace transillum
