// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <optional>
#include <vector>

#include "radiosity/reflected_light.h"
#include "radiosity/solver/radiosity_iterate.h"
#include "radiosity/solver/solver_input.h"

namespace transillum {

/// How much of the start, B = E, is left in an iterate of the semi-iterative scheme.
///
/// A second iterate starts above the solution and gathers along the same directions. Both obey eq.
/// 44, so their difference obeys it without E: it shows what any error of the start has become, and
/// the solution lies between the two, but for the error of the directions. It is no longer followed
/// once it is negligible.
class StartRemainder {
 public:
  /// Keeps references to the scene and the first shot of `input`. Nothing is followed in schemes
  /// other than semi_iterative.
  explicit StartRemainder(const SolverInput& input);

  /// Begins an iteration.
  void begin();
  /// Gathers along the directions of one pass.
  void add(const Transfers& transfers);
  /// Completes what passes have gathered.
  void complete();
  /// Ends an iteration which led to `whole`.
  void finish(const RadiosityIterate& whole);

  /// Upper bound of what the solution exceeds the last finished iteration by, because of the start:
  /// W/m², one per patch. Empty before the first iteration.
  const std::vector<Rgb>& left() const { return left_; }
  /// Factor per iteration by which the largest of left() decreases, from the second half of the
  /// iterations followed; the largest reflectance while there are fewer than 4.
  double contraction() const;
  double rho_max() const { return max_abs(rho_max_); }  ///< largest reflectance

  /// For StateOutput and StateInput.
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    bool has_upper = self.upper_.has_value();
    archive(self.follows_, has_upper);
    if (has_upper) {
      if constexpr (Archive::reading) {
        self.make_upper();
      }
      archive(*self.upper_);
    }
    archive.empty_or(self.patch_count(), self.left_);
    archive(self.largest_);
    archive.require(!has_upper || self.left_.size() == self.patch_count());
  }

 private:
  void start(const RadiosityIterate& whole);
  void make_upper();
  std::size_t patch_count() const { return input_.patch_count(); }

  const SolverInput& input_;
  ReflectedLight light_;
  bool follows_;
  Rgb rho_max_;
  std::optional<RadiosityIterate> upper_;
  std::vector<Rgb> left_;
  std::vector<double> largest_;  ///< largest value of left(), after each iteration followed
};

}  // namespace transillum
