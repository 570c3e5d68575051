// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Sealed files with the points of a study.
#include "io/runs/study_checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <utility>

#include "io/runs/run_identity.h"
#include "io/runs/sealed_file.h"
#include "radiosity/state_archive.h"

namespace transillum {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* study_kind = "study";

struct StoredPoint {
  StudyPoint point;

  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    auto& p = self.point;
    auto series = static_cast<std::uint64_t>(p.series);
    auto remedy = static_cast<std::int32_t>(p.remedy);
    std::vector<char> failure(p.failure.begin(), p.failure.end());
    archive(series, p.passes, p.directions, p.rms_error, p.max_error, p.bound, p.seconds, failure,
            remedy);
    if constexpr (Archive::reading) {
      archive.require(remedy >= 0 && remedy <= static_cast<std::int32_t>(Remedy::memory));
      p.series = static_cast<std::size_t>(series);
      p.remedy = static_cast<Remedy>(remedy);
      p.failure.assign(failure.begin(), failure.end());
    }
  }
};

RunIdentity study_identity(const Scene& scene, const StudyOptions& options,
                           const SolveOptions& reference) {
  Json study = {{"directions", options.directions},
                {"rotations", options.rotations},
                {"errors_of", "reflected light"}};
  for (std::size_t k = 0; k < options.series.size(); ++k) {
    study[fmt::format("series {}", k + 1)] = run_options(
        options.solve_options(options.series[k], options.directions.front()), scene.options());
  }
  RunIdentity identity = run_identity(scene, reference);
  identity.json["study"] = study;
  return identity;
}

}  // namespace

struct [[gnu::visibility("hidden")]] StudyCheckpoint::Impl {
  std::filesystem::path file;
  RunIdentity identity;
  std::size_t series, points;  ///< numbers of the whole study
};

StudyCheckpoint::StudyCheckpoint(std::filesystem::path file, const Scene& scene,
                                 const StudyOptions& options, const SolveOptions& reference)
    : impl_(std::make_unique<const Impl>(
          Impl{std::move(file), study_identity(scene, options, reference), options.series.size(),
               options.series.size() * options.directions.size()})) {}
StudyCheckpoint::~StudyCheckpoint() = default;

void StudyCheckpoint::save(std::span<const StudyPoint> points) const {
  write_sealed(impl_->file, study_kind, {{"run", impl_->identity.json}}, [&](std::ostream& out) {
    std::vector<StoredPoint> stored;
    for (const StudyPoint& point : points) {
      stored.push_back({point});
    }
    StateOutput archive(out);
    archive(stored);
  });
}

std::vector<StudyPoint> StudyCheckpoint::resume() const {
  SealedFile file(impl_->file, study_kind);
  check_identity(file, impl_->identity);
  file.check();
  std::vector<StoredPoint> stored;
  try {
    StateInput archive(file.in(), file.size());
    archive(stored);
    archive.finish();
    archive.require(stored.size() <= impl_->points &&
                    std::all_of(stored.begin(), stored.end(), [&](const StoredPoint& one) {
                      return one.point.series < impl_->series;
                    }));
  } catch (const DamagedState& error) {
    file.refuse(error.what());
  }
  std::vector<StudyPoint> points;
  for (StoredPoint& one : stored) {
    points.push_back(std::move(one.point));
  }
  return points;
}

}  // namespace transillum
