// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/at.h"
#include "transillum/bsp_tree.h"
#include "visibility/pixels/pixel_grid.h"
#include "visibility/pixels/scan_conversion.h"

namespace transillum {

// Sets of convex polygons, addressed by number, with corners snapped to a PixelGrid.

/// The pieces of a scene, as Scene::pieces().
class PieceOutlines {
 public:
  /// Keeps a reference.
  PieceOutlines(const Scene& scene, const PixelGrid& grid)
      : scene_(scene), points_(grid.snapped(scene.points())) {}

  const Piece& piece(std::int32_t k) const { return at(scene_.pieces(), k); }
  PatchId patch(std::int32_t k) const { return piece(k).patch; }
  const PixelPoint& point(PointId p) const { return at(points_, p); }
  template <class Visit>
  void for_each_corner(std::int32_t k, Visit visit) const {
    for (const PointId p : scene_.corners(piece(k))) {
      visit(point(p));
    }
  }
  void add_edges(std::int32_t k, ScanConverter& converter) const {
    const auto corners = scene_.corners(piece(k));
    for (std::size_t n = 0; n < corners.size(); ++n) {
      const PixelPoint &a = point(corners[n]), &b = point(corners[(n + 1) % corners.size()]);
      converter.add_edge(a, b, a, b);
    }
  }

 private:
  const Scene& scene_;
  std::vector<PixelPoint> points_;
};

/// The fragments of a tree. Their edges are converted as parts of the tree's lines.
class SnappedFragments {
 public:
  /// Keeps a reference.
  SnappedFragments(const BspTree& tree, const PixelGrid& grid)
      : tree_(tree), points_(grid.snapped(tree.points())) {}

  PatchId patch(FragmentId f) const { return tree_.fragment(f).patch; }
  template <class Visit>
  void for_each_corner(FragmentId f, Visit visit) const {
    for (const BspTree::Corner& corner : tree_.corners(tree_.fragment(f))) {
      visit(point(corner.point));
    }
  }
  void add_edges(FragmentId f, ScanConverter& converter) const {
    const auto corners = tree_.corners(tree_.fragment(f));
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const BspTree::Line& line = at(tree_.lines(), corners[k].line);
      converter.add_edge(point(corners[k].point), point(corners[(k + 1) % corners.size()].point),
                         point(line.a), point(line.b));
    }
  }

 private:
  const PixelPoint& point(PointId p) const { return at(points_, p); }

  const BspTree& tree_;
  std::vector<PixelPoint> points_;
};

}  // namespace transillum
