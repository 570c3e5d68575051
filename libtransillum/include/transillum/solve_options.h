// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Options of a solve.
#pragma once

#include <cstdint>
#include <optional>

#include "transillum/accuracy_goal.h"
#include "transillum/choice.h"
#include "transillum/directions.h"
#include "transillum/engine.h"
#include "transillum/export.h"
#include "transillum/sky.h"

namespace TRANSILLUM_API transillum {

/// How the form-factor matrix is scaled to have the correct row sums.
enum class Normalization {
  none,       ///< the paper's plain estimator
  rows,       ///< rows divided by their quadrature of the cosine: removes the error of section 5.1;
              ///< the iteration contracts for every M; reciprocity is lost
  symmetric,  ///< rows and columns scaled by the same factors to the same end: reciprocity,
              ///< A_i F_ij = A_j F_ji, is kept. Requires two_way and kept form factors
};
/// Their names (choice.h).
template <>
const Choices& choices_of<Normalization>();

/// Which directions an iteration uses, and how iterations are combined (section 6).
enum class Scheme {
  fixed,           ///< the same M directions in every iteration (eq. 11)
  growing,         ///< twice as many in each iteration, up to M; each computed once (eq. 44)
  semi_iterative,  ///< M new directions in each iteration; B is the mean over iterations (eq. 45)
  conjugate_gradients,  ///< the equations of `fixed` in symmetric form, solved by conjugate
                        ///< gradients to within the tolerance of the limit of the iteration, in
                        ///< the second iteration. Requires two_way; not with Normalization::rows
};
/// Their names (choice.h).
template <>
const Choices& choices_of<Scheme>();

/// The properties of a scheme. Callers ask these instead of naming schemes.
struct SchemeTraits {
  Scheme value;                    ///< the scheme
  const char* name;                ///< in options and files
  const char* label;               ///< in a list of choices
  const char* sentence;            ///< which directions an iteration has
  bool renews_directions = false;  ///< each iteration has other directions; B is their mean
  bool is_symmetric = false;       ///< solves the equations in symmetric form
};
/// The traits of one scheme.
const SchemeTraits& traits_of(Scheme scheme);

/// The functions that represent the radiosity of a patch.
enum class Basis {
  constant,  ///< one value per patch
  linear,    ///< a linear function on each patch (section 3; ALGORITHM.md 6.12), not continuous
             ///< across edges. Requires an engine that has_moments(), or pairs; not with
             ///< Scheme::semi_iterative
};
/// Their names (choice.h).
template <>
const Choices& choices_of<Basis>();

/// In place of a threshold: each source whose shot is expected to take less time than the passes
/// that would be needed to reach its accuracy.
inline constexpr double first_shot_where_it_pays = -1;

/// Options of a solve run.
struct SolveOptions {
  int directions = 1024;                          ///< M: passes per iteration, 1 … 2^24
  std::optional<Sampling> sampling = {};          ///< set of directions; used_sampling() if unset
  std::uint64_t seed = 1;                         ///< seed of seeded samplings and of engine rays
  std::optional<std::uint64_t> rotation = {};     ///< seed of a rotation of all directions, if any
  Engine engine = Engine::fast;                   ///< computes the transfers
  EngineOptions engine_options = {};              ///< options of the engine
  bool two_way = true;                            ///< each pass serves omega and -omega
  Normalization normalize = Normalization::none;  ///< normalization of the form factors
  Scheme scheme = Scheme::fixed;                  ///< scheme of the iteration
  Basis basis = Basis::constant;                  ///< basis of the radiosity on a patch
  /// R²/A from which sources are small and, if bright, are shot before the first iteration;
  /// first_shot_where_it_pays: those for which it saves time (first_shot_sources()), and none where
  /// another option excludes a first shot, or lobes take part; nothing: no first shot.
  std::optional<double> first_shot = first_shot_where_it_pays;
  /// semi_iterative: iterations omitted from the mean; unset: until what is left of the start is
  /// below a quarter of the RMS change per iteration, or a tenth of the tolerance; at most half of
  /// `iterations`
  std::optional<int> burn_in = {};
  int replicas = 1;    ///< 2 … 64: split the M directions into this many sets with independent
                       ///< rotations, whose spread gives an error estimate. At most M
  int iterations = 0;  ///< number of iterations; 0: by averaged_iterations or tolerance
  /// semi_iterative: number of iterations in the mean, after which it stops; 0 stops by tolerance
  int averaged_iterations = 0;
  /// Bound of what the iteration omits, relative to reflected light: of
  /// IterationRecord::remainder and remainder_dimmest; semi_iterative: IterationRecord::error
  double tolerance = 1e-6;
  std::uint64_t memory = 0;  ///< limit for kept form factors, bytes; 0: a quarter of the machine's
  int threads = 0;           ///< 0 uses all cores; the result does not depend on it
  /// If set, a SolveSession chooses `directions` and `replicas`. A RadiositySolver uses the
  /// values given.
  AccuracyGoal goal = {};
  /// Light that enters where nothing is above a patch. With engines hemicube and pairs, only a sun.
  Sky sky = {};
  /// solve(): lobes of materials take part (glossy.h). Requires two_way, Scheme::fixed,
  /// Basis::constant, an engine that takes_directions(), normalization none or rows. A
  /// RadiositySolver ignores lobes.
  bool glossy = false;

  /// `first_shot`; nothing where it is first_shot_where_it_pays and another option excludes it or
  /// lobes take part.
  std::optional<double> used_first_shot() const;
  /// `sampling`, or default_sampling(two_way).
  Sampling used_sampling() const { return sampling.value_or(default_sampling(two_way)); }
  /// @throws InputError naming the option and its range.
  void validate() const;
  /// Why B would be 0 everywhere, as a phrase; empty if there is light.
  /// @param emits whether a patch emits: Scene::has_light()
  std::string why_dark(bool emits) const;
  /// Exact comparison of all members.
  friend bool operator==(const SolveOptions&, const SolveOptions&) = default;
};

}  // namespace TRANSILLUM_API transillum
