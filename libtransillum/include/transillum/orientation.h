// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Which side of a face is lit. Files from elsewhere often have faces whose corners run the wrong
// way round, so that light meets backs, which absorb it. back_fraction() measures how much of what
// is seen in a scene is a back; plan_orientation() finds the faces to turn, and orient() turns
// them. Both trace rays (Embree), so they see the scene as it is and need no closed or welded
// meshes.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/scene.h"

namespace TRANSILLUM_API transillum {

/// Changes that plan_orientation() makes among the faces of one material or group.
struct OrientationCount {
  std::string name;            ///< name of the material or group
  std::int64_t faces = 0;      ///< its faces
  std::int64_t turned = 0;     ///< how many of its faces are turned
  std::int64_t two_sided = 0;  ///< how many of its faces become two-sided
};

/// The findings of plan_orientation(), in counts and sentences.
struct OrientationReport {
  std::int64_t faces = 0;                 ///< faces in the description
  std::int64_t components = 0;            ///< connected components of faces
  std::int64_t components_turned = 0;     ///< components with turned faces
  std::int64_t faces_turned = 0;          ///< faces to turn
  std::int64_t components_two_sided = 0;  ///< components to make two-sided: seen on both sides
  std::int64_t faces_two_sided = 0;       ///< faces to make two-sided
  std::int64_t not_orientable = 0;        ///< components without two sides, such as a Moebius strip
  std::vector<OrientationCount> materials;  ///< materials with changes, in their order
  std::vector<OrientationCount> groups;     ///< the same for groups of faces
  std::vector<std::string> sentences;       ///< for the user, at most a few dozen
};

/// Which faces to turn and to make two-sided.
struct OrientationPlan {
  std::vector<bool> turned;           ///< by face: its outline is to be reversed
  std::vector<bool> two_sided;        ///< by face: it is to light and receive on both sides
  std::vector<std::int32_t> numbers;  ///< by face: SceneDescription::number_of()
  OrientationReport report;           ///< the same in counts

  /// Whether it changes any face.
  bool changes() const { return report.faces_turned > 0 || report.faces_two_sided > 0; }
};

/// Finds which faces to turn so that what is seen is the lit side.
///
/// Two faces are connected where they alone share an edge, by equal coordinates; a connected part
/// is turned as a whole, after its faces have been made consistent with each other. Its lit side is
/// the one from which random walks of light reach more of the other components and of the light. So
/// closed solids are lit outside, the room that contains the rest inside, as is an emitting closed
/// surface that is alone. An open part that is seen nearly as much on both sides becomes two-sided,
/// unless it emits, so that no light is doubled. Parts that nothing tells about keep the
/// orientation of most of their area. Two faces on the same points that face opposite ways are
/// kept. Parts that cannot be oriented stay as they are if few of their backs are seen, else they
/// become two-sided. Changes after which more of what light meets would be backs are taken back.
///
/// Time: a few 10^6 rays at most for scenes of up to 10^5 components, linear in the components
/// above. The result does not depend on the number of threads.
/// @param description a description that Scene accepts; not changed.
/// @param threads 0: all cores.
/// @param progress if set, called at intervals with the fraction done, in [0,1], on this thread.
/// @throws InputError as the constructor of Scene; Canceled
OrientationPlan plan_orientation(const SceneDescription& description, int threads = 0,
                                 const Cancellation& cancellation = {},
                                 const std::function<void(double)>& progress = {});

/// Reverses the outlines of the plan's turned faces and sets SceneDescription::face_two_sided.
/// Numbers of faces are not changed.
/// @param plan of a description with the same faces.
void apply(const OrientationPlan& plan, SceneDescription& description);

/// plan_orientation(), then apply().
OrientationReport orient(SceneDescription& description, int threads = 0,
                         const Cancellation& cancellation = {},
                         const std::function<void(double)>& progress = {});

/// How much of what is seen of a material or group is its back.
struct BackCount {
  std::string name;     ///< name of the material or group
  double fraction = 0;  ///< fraction of what is seen of it that is its back, in [0,1]
  double of_all = 0;    ///< its backs as a fraction of all that is seen, in [0,1]
};

/// Fractions of back sides among what light meets in a scene and among what lit sides see.
struct BackFraction {
  /// Fraction of what light meets above which the orientation of faces deserves a warning.
  static constexpr double worth_a_warning = 0.1;

  /// The fraction of backs in what light meets, in [0,1]; 0 where it meets nothing, as around a
  /// convex solid, but 1 where something is behind all sources: they are turned away.
  double fraction = 0;
  /// Fraction of the lines from lit sides that meet nothing, in [0,1]. Through a two-sided face, a
  /// line counts where it meets nothing on either side, so that a sealed room of two-sided faces
  /// has 0.
  double open = 0;
  std::vector<BackCount> materials;  ///< materials with visible backs, by falling of_all
  std::vector<BackCount> groups;     ///< the same for groups of faces
};

/// Measures the fraction of backs among what light meets, by random paths from the sources that lit
/// sides reflect up to 16 times and backs absorb; from all lit sides where nothing emits. At most
/// 2 · 10^5 rays in all, some 0.1 s and the construction of Embree's tree; the standard error of a
/// fraction is below 0.006. The same for any number of threads.
/// @param threads 0: all cores.
/// @throws Canceled
BackFraction back_fraction(const Scene& scene, int threads = 0,
                           const Cancellation& cancellation = {});

}  // namespace TRANSILLUM_API transillum
