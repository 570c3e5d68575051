// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/edit/face_edits.h"

#include <algorithm>
#include <array>
#include <compare>
#include <map>
#include <numeric>
#include <tuple>

#include "transillum/errors.h"

namespace transillum {

namespace {

using Key = std::tuple<double, double, double>;

/// The number of each point, equal for points of the same coordinates.
std::vector<std::int32_t> numbers_by_place(const SceneDescription& description) {
  std::map<Key, std::int32_t> places;
  std::vector<std::int32_t> numbers;
  numbers.reserve(description.points.size());
  for (const Vec3& p : description.points) {
    const auto next = static_cast<std::int32_t>(places.size());
    numbers.push_back(places.try_emplace({p.x, p.y, p.z}, next).first->second);
  }
  return numbers;
}

/// The faces that are connected with `face` over common edges of faces that are among `members`.
FaceList connected(const SceneDescription& description, std::int32_t face,
                   const std::vector<bool>& members) {
  const std::vector<std::int32_t> numbers = numbers_by_place(description);
  std::map<std::pair<std::int32_t, std::int32_t>, FaceList> by_edge;
  const auto visit_edges = [&](std::int32_t f, const auto& visit) {
    const auto outline = description.outline(static_cast<std::size_t>(f));
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const std::int32_t a = at(numbers, outline[k]);
      const std::int32_t b = at(numbers, outline[(k + 1) % outline.size()]);
      visit(std::minmax({a, b}));
    }
  };
  const auto count = static_cast<std::int32_t>(description.face_count());
  for (std::int32_t f = 0; f < count; ++f) {
    if (at(members, f)) {
      visit_edges(f, [&](const auto& edge) { by_edge[edge].push_back(f); });
    }
  }
  std::vector<bool> found(description.face_count());
  FaceList waiting{face};
  found[static_cast<std::size_t>(face)] = true;
  while (!waiting.empty()) {
    const std::int32_t f = waiting.back();
    waiting.pop_back();
    visit_edges(f, [&](const auto& edge) {
      for (const std::int32_t other : by_edge[edge]) {
        if (!at(found, other)) {
          found[static_cast<std::size_t>(other)] = true;
          waiting.push_back(other);
        }
      }
    });
  }
  FaceList faces;
  for (std::int32_t f = 0; f < count; ++f) {
    if (at(found, f)) {
      faces.push_back(f);
    }
  }
  return faces;
}

template <class Belongs>
FaceList faces_where(const SceneDescription& description, const Belongs& belongs) {
  FaceList faces;
  for (std::size_t f = 0; f < description.face_count(); ++f) {
    if (belongs(f)) {
      faces.push_back(static_cast<std::int32_t>(f));
    }
  }
  return faces;
}

/// Gives every face an entry in the lists that may be empty or too short.
void fill_lists(SceneDescription& description) {
  const std::size_t count = description.face_count();
  description.face_group.resize(count, no_group);
  description.face_two_sided.resize(count, 0);
  for (std::size_t f = description.face_number.size(); f < count; ++f) {
    description.face_number.push_back(description.number_of(f));
  }
}

/// A number that no face has, nor one that was joined to another.
std::int32_t next_number(const SceneDescription& description) {
  const std::size_t count = description.face_count();
  const std::int32_t after = count == 0 ? 0 : description.number_of(count - 1) + 1;
  return std::max(after, static_cast<std::int32_t>(description.joined_to.size()));
}

/// Appends a face to a description whose lists are filled.
void append(SceneDescription& description, const std::vector<PointId>& outline, int material,
            int group, bool two_sided) {
  const std::int32_t number = next_number(description);
  description.add_face(outline, material, 0, group);
  description.face_two_sided.resize(description.face_count(), 0);
  description.face_two_sided.back() = two_sided ? 1 : 0;
  description.face_number.push_back(number);
}

PointId append_point(SceneDescription& description, const Vec3& p) {
  description.points.push_back(p);
  return static_cast<PointId>(description.points.size()) - 1;
}

int added_material(SceneDescription& description, const std::string& name, const Rgb& reflectance,
                   const Rgb& exitance) {
  const Material material{name, reflectance, exitance};
  for (std::size_t m = 0; m < description.materials.size(); ++m) {
    const Material& other = description.materials[m];
    if (other.name == name && other.reflectance == reflectance && other.exitance == exitance) {
      return static_cast<int>(m);
    }
  }
  description.materials.push_back(material);
  return static_cast<int>(description.materials.size()) - 1;
}

/// Adds a group with a name that no other has.
int added_group(SceneDescription& description, const std::string& name) {
  std::string unique = name;
  for (int k = 2; std::count(description.groups.begin(), description.groups.end(), unique) > 0;
       ++k) {
    unique = name + "-" + std::to_string(k);
  }
  description.groups.push_back(unique);
  return static_cast<int>(description.groups.size()) - 1;
}

}  // namespace

FaceList faces_of_number(const SceneDescription& description, std::int32_t number) {
  return faces_where(description,
                     [&](std::size_t f) { return description.number_of(f) == number; });
}

FaceList faces_of_group(const SceneDescription& description, std::int32_t group) {
  return faces_where(description, [&](std::size_t f) {
    return group != no_group && description.group_of(f) == group;
  });
}

FaceList faces_of_object(const SceneDescription& description, std::int32_t face) {
  return connected(description, face, std::vector<bool>(description.face_count(), true));
}

FaceList faces_of_lamp(const SceneDescription& description, std::int32_t face) {
  std::vector<bool> emits(description.face_count());
  for (std::size_t f = 0; f < emits.size(); ++f) {
    emits[f] = max_abs(at(description.materials, description.face_material[f]).exitance) > 0;
  }
  const auto first = std::find(emits.begin(), emits.end(), true);
  if (first == emits.end()) {
    return {};
  }
  return connected(description,
                   at(emits, face) ? face : static_cast<std::int32_t>(first - emits.begin()),
                   emits);
}

Bounds bounds_of(const SceneDescription& description, std::span<const std::int32_t> faces) {
  Bounds bounds;
  bool any = false;
  for (const std::int32_t face : faces) {
    for (const PointId id : description.outline(static_cast<std::size_t>(face))) {
      const Vec3& p = at(description.points, id);
      if (!any) {
        bounds = {p, p};
        any = true;
      }
      for (int axis = 0; axis < 3; ++axis) {
        coordinate(bounds.low, axis) = std::min(coordinate(bounds.low, axis), coordinate(p, axis));
        coordinate(bounds.high, axis) =
            std::max(coordinate(bounds.high, axis), coordinate(p, axis));
      }
    }
  }
  return bounds;
}

void place_faces(SceneDescription& description, std::span<const std::int32_t> faces,
                 const Vec3& pivot, const FacePlacement& placement) {
  const Vec3& scale = placement.scale;
  if (!(scale.x > 0 && scale.y > 0 && scale.z > 0)) {
    throw InputError("scale: the factors must be > 0");
  }
  if (!is_finite(placement.move) || !is_finite(placement.turn) || !is_finite(scale)) {
    throw InputError("placement: the numbers must be finite");
  }
  if (placement == FacePlacement{}) {
    return;
  }
  std::vector<std::int32_t> uses(description.points.size());
  for (const PointId id : description.corners) {
    ++uses[static_cast<std::size_t>(id)];
  }
  std::vector<std::int32_t> uses_here(description.points.size());
  const auto corners_of = [&](std::int32_t face) {
    const auto outline = description.outline(static_cast<std::size_t>(face));
    return std::span(description.corners)
        .subspan(static_cast<std::size_t>(outline.data() - description.corners.data()),
                 outline.size());
  };
  for (const std::int32_t face : faces) {
    for (const PointId id : corners_of(face)) {
      ++uses_here[static_cast<std::size_t>(id)];
    }
  }
  std::vector<PointId> moved(uses.size(), -1);
  for (const std::int32_t face : faces) {
    for (PointId& id : corners_of(face)) {
      const auto k = static_cast<std::size_t>(id);
      if (moved[k] < 0) {
        const Vec3 p = placed(description.points[k], pivot, placement);
        if (uses[k] == uses_here[k]) {
          description.points[k] = p;
          moved[k] = id;
        } else {
          moved[k] = append_point(description, p);
        }
      }
      id = moved[k];
    }
  }
  description.coordinate_rounding = 0;
}

void remove_faces(SceneDescription& description, std::span<const std::int32_t> faces) {
  fill_lists(description);
  SceneDescription kept = description;
  kept.corners.clear();
  kept.face_begin.clear();
  kept.face_material.clear();
  kept.face_line.clear();
  kept.face_number.clear();
  kept.face_group.clear();
  kept.face_two_sided.clear();
  for (std::size_t f = 0; f < description.face_count(); ++f) {
    if (std::binary_search(faces.begin(), faces.end(), static_cast<std::int32_t>(f))) {
      continue;
    }
    const auto outline = description.outline(f);
    kept.face_begin.push_back(static_cast<std::uint32_t>(kept.corners.size()));
    kept.corners.insert(kept.corners.end(), outline.begin(), outline.end());
    kept.face_material.push_back(description.face_material[f]);
    kept.face_line.push_back(description.face_line[f]);
    kept.face_number.push_back(description.face_number[f]);
    kept.face_group.push_back(description.face_group[f]);
    kept.face_two_sided.push_back(description.face_two_sided[f]);
  }
  description = std::move(kept);
}

FaceList copy_faces(SceneDescription& description, std::span<const std::int32_t> faces,
                    const Vec3& move) {
  fill_lists(description);
  FaceList copies;
  std::map<PointId, PointId> copied;
  for (const std::int32_t face : faces) {
    const auto f = static_cast<std::size_t>(face);
    std::vector<PointId> outline;
    for (const PointId id :
         std::vector<PointId>(description.outline(f).begin(), description.outline(f).end())) {
      const auto [found, is_new] = copied.try_emplace(id, 0);
      if (is_new) {
        found->second = append_point(description, at(description.points, id) + move);
      }
      outline.push_back(found->second);
    }
    copies.push_back(static_cast<std::int32_t>(description.face_count()));
    append(description, outline, description.face_material[f], description.face_group[f],
           description.face_two_sided[f] != 0);
  }
  description.coordinate_rounding = 0;
  return copies;
}

FaceList add_solid(SceneDescription& description, AddedSolid solid, const Vec3& center,
                   const Vec3& size, int up) {
  fill_lists(description);
  constexpr std::array<const char*, 4> names{"box", "board", "lamp", "room"};
  const bool glows = solid == AddedSolid::lamp;
  const int material = glows ? added_material(description, "added lamp", {}, {10, 10, 10})
                             : added_material(description, "added gray", {0.5, 0.5, 0.5}, {});
  const int group = added_group(description, names[static_cast<std::size_t>(solid)]);
  const bool level = glows || solid == AddedSolid::board;
  FaceList added;
  // Corner k has the high coordinate of an axis where its bit is set.
  std::array<PointId, 8> corner{};
  std::array<bool, 8> made{};
  const auto point = [&](int k) {
    const auto c = static_cast<std::size_t>(k);
    if (!made[c]) {
      Vec3 p = center;
      for (int axis = 0; axis < 3; ++axis) {
        const double half = level && axis == up ? 0 : coordinate(size, axis) / 2;
        coordinate(p, axis) += (k >> axis & 1) != 0 ? half : -half;
      }
      corner[c] = append_point(description, p);
      made[c] = true;
    }
    return corner[c];
  };
  // The face on the low or the high side of an axis, lit on that side.
  const auto add_side = [&](int axis, bool high, bool inward) {
    const int a = 1 << (axis + 1) % 3, b = 1 << (axis + 2) % 3;
    const int base = high ? 1 << axis : 0;
    std::vector<PointId> outline{point(base), point(base + a), point(base + a + b),
                                 point(base + b)};
    if (high == inward) {
      std::reverse(outline.begin(), outline.end());
    }
    added.push_back(static_cast<std::int32_t>(description.face_count()));
    append(description, outline, material, group, solid == AddedSolid::board);
  };
  if (level) {
    add_side(up, false, false);
    return added;
  }
  for (int axis = 0; axis < 3; ++axis) {
    add_side(axis, false, solid == AddedSolid::room);
    add_side(axis, true, solid == AddedSolid::room);
  }
  return added;
}

}  // namespace transillum
