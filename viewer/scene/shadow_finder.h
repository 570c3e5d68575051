// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>
#include <optional>
#include <vector>

#include "model/requests/recorded_map.h"
#include "model/snapshot.h"
#include "support/newest_result.h"
#include "visibility/map/shadow_edges.h"

namespace transillum::viewer {

/// Finds the edges of shadows on a thread of its own: of the sun's light if the solve has a sun, or
/// else of the light of emitting patches along the direction whose map is shown.
///
/// Threads: the main thread only.
class ShadowFinder : public QObject {
  Q_OBJECT

 public:
  explicit ShadowFinder(QObject* parent = nullptr);

  /// @param map  of the direction shown, may be null or of another scene
  void request(const SolverSnapshot& snapshot, const std::shared_ptr<const RecordedMap>& map);
  /// Stops what is being computed, and forgets what was.
  void clear() {
    edges_.clear();
    loaded_ = nullptr;
  }
  /// Null until the edges of the scene are found, or if there is no light to find them for.
  const std::vector<ShadowEdge>* edges(const LoadedScene& loaded) const;
  bool busy() const { return edges_.busy(); }

 signals:
  void changed();

 private:
  struct Request {
    std::shared_ptr<const LoadedScene> loaded;
    std::shared_ptr<const PatchMaterials> materials;  ///< null: the materials of the scene
    std::optional<Vec3> sun;                          ///< toward it
    std::shared_ptr<const RecordedMap> map;           ///< used without a sun

    friend bool operator==(const Request&, const Request&) = default;
  };
  struct Found {
    std::shared_ptr<const LoadedScene> loaded;
    std::vector<ShadowEdge> edges;
  };
  static Found find(const Request& request, const Cancellation& cancellation);

  std::shared_ptr<const LoadedScene> loaded_;  ///< the newest request is for it
  KeptResult<Request, Found> edges_;
};

}  // namespace transillum::viewer
