// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The BSP tree along one direction, and the panel that shows it.
#include <QAbstractItemModelTester>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QTabWidget>
#include <QTableView>
#include <QTreeView>
#include <algorithm>
#include <set>

#include "solved_window.h"
#include "transillum/at.h"
#include "transillum/directions.h"
#include "tree/order_bar.h"
#include "tree/tree_outline.h"
#include "tree/tree_tables.h"

namespace transillum::viewer::tree_test {

using namespace test;

namespace {

using Place = TreeVisit::Place;

/// Mean of a fragment's corners.
Vec3 middle(const BspTree& tree, FragmentId f) {
  Vec3 sum;
  const auto corners = tree.corners(tree.fragment(f));
  for (const BspTree::Corner& corner : corners) {
    sum = sum + at(tree.points(), corner.point);
  }
  return sum / static_cast<double>(corners.size());
}

}  // namespace

class TreeTest : public QObject {
  Q_OBJECT

 private slots:
  void a_path_ends_at_the_fragment_of_its_step() {
    for (const char* name : {"boards", "cornell-box", "furnace"}) {
      const auto scene = load_scene(name);
      const auto tree = std::make_shared<const BspTree>(*scene);
      const TreeOutline outline(tree);
      for (const auto& sample : make_directions(Sampling::random, 12, 3)) {
        const std::vector<FragmentId> order = tree->order(sample.direction);
        const auto count = static_cast<std::int32_t>(order.size());
        for (std::int32_t step = 0; step < count; ++step) {
          const auto path = outline.path_to(step, sample.direction);
          QVERIFY(!path.empty());
          QCOMPARE(path.front().begin, 0);
          QCOMPARE(path.front().end, count);
          for (std::size_t k = 0; k < path.size(); ++k) {
            QVERIFY(path[k].holds(step));
            QCOMPARE(path[k].place_of(step) == Place::plane, k + 1 == path.size());
            if (k == 0) {
              continue;
            }
            // All of one side of the parent plane.
            const TreeVisit& above = path[k - 1];
            const bool near = above.place_of(step) == Place::near_side;
            QCOMPARE(path[k].begin, near ? above.begin : above.plane_end);
            QCOMPARE(path[k].end, near ? above.plane_begin : above.end);
          }
          const BspTree::Node& node = outline.node(path.back().node);
          const FragmentId f = at(order, step);
          QVERIFY(node.begin <= f && f < node.end);
        }
        QVERIFY(outline.path_to(-1, sample.direction).empty());
        QVERIFY(outline.path_to(count, sample.direction).empty());
      }
    }
  }

  void the_side_that_omega_points_to_comes_first() {
    const auto scene = load_scene("cornell-box");
    const auto tree = std::make_shared<const BspTree>(*scene);
    const TreeOutline outline(tree);
    int fronts_first = 0, backs_first = 0;
    for (const auto& sample : make_directions(Sampling::random, 12, 3)) {
      const std::vector<FragmentId> order = tree->order(sample.direction);
      const auto count = static_cast<std::int32_t>(order.size());
      for (std::int32_t step = 0; step < count; ++step) {
        for (const TreeVisit& visit : outline.path_to(step, sample.direction)) {
          const BspTree::Plane& plane = outline.node(visit.node).plane;
          ++(visit.cosine > 0 ? fronts_first : backs_first);
          for (std::int32_t k = visit.begin; k < visit.end; ++k) {
            const double height = dot(plane.normal, middle(*tree, at(order, k))) - plane.offset;
            const double toward_omega = visit.cosine > 0 ? height : -height;
            const double tolerance = 1e-9;
            switch (visit.place_of(k)) {
              case Place::near_side:
                QVERIFY(toward_omega > tolerance);
                break;
              case Place::plane:
                QVERIFY(std::abs(toward_omega) < tolerance);
                break;
              case Place::far_side:
                QVERIFY(toward_omega < -tolerance);
                break;
            }
          }
        }
      }
    }
    QVERIFY(fronts_first > 0 && backs_first > 0);
  }

  void visits_agree_with_paths() {
    const auto scene = load_scene("boards");
    const TreeOutline outline(std::make_shared<const BspTree>(*scene));
    for (const auto& sample : make_directions(Sampling::random, 6, 3)) {
      const auto visits = outline.visits(sample.direction);
      std::set<std::int32_t> found;
      for (std::int32_t step = 0; step < outline.size(0); ++step) {
        for (const TreeVisit& visit : outline.path_to(step, sample.direction)) {
          QCOMPARE(at(visits, visit.node), visit);
          found.insert(visit.node);
        }
      }
      // Every node has a fragment in or below it.
      QCOMPARE(found.size(), visits.size());
    }
  }

  void persistent_indexes_survive_a_change_of_direction() {
    const auto scene = load_scene("boards");
    const auto outline =
        std::make_shared<const TreeOutline>(std::make_shared<const BspTree>(*scene));
    TreeModel model;
    QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
    int changes = 0;
    QPersistentModelIndex deep;
    for (const auto& sample : make_directions(Sampling::random, 8, 3)) {
      model.show_position(outline, sample.direction, 5);
      const std::int32_t node = model.path().back();
      QVERIFY(model.visit(model.index_of(node)).holds(5));
      if (deep.isValid()) {
        QCOMPARE(QModelIndex(deep), model.index_of(static_cast<std::int32_t>(deep.internalId())));
        ++changes;
      }
      deep = model.index_of(node);
      // The sides of a node precede and follow the fragments in its plane.
      for (std::int32_t n = 0; n < static_cast<std::int32_t>(outline->tree().nodes().size()); ++n) {
        const QModelIndex index = model.index_of(n);
        std::int32_t at = model.visit(index).begin;
        for (int row = 0; row < model.rowCount(index); ++row) {
          const TreeVisit& side = model.visit(model.index(row, 0, index));
          QVERIFY(side.begin == at || side.begin == model.visit(index).plane_end);
          at = side.end;
        }
      }
    }
    QVERIFY(changes > 0);
  }

  void positions_on_a_bar_map_to_steps() {
    const QRectF bar(40, 0, 200, 10);
    const TreeVisit visit{0, 1, 100, 120, 121, 137};
    for (std::int32_t step = visit.begin; step < visit.end; ++step) {
      QCOMPARE(OrderBar::step_at(visit, bar, OrderBar::left_of(visit, bar, step) + 0.1), step);
    }
    QCOMPARE(OrderBar::step_at(visit, bar, -1e9), visit.begin);
    QCOMPARE(OrderBar::step_at(visit, bar, 1e9), visit.end - 1);
  }

  void the_panel_follows_the_focus_and_moves_it() {
    const SolvedWindow s("cornell-box");
    QVERIFY(s.ready);
    Focus& focus = s.window->focus;
    s.trigger("layout_debug");
    s.window->findChild<QDockWidget*>("tree_dock")->raise();
    focus.go_to({0, 3, 11});
    QVERIFY(wait_for([&] { return s.window->settled(); }));
    auto* view = s.window->findChild<QTableView*>("tree_path");
    QVERIFY(wait_for([&] { return view->isVisible(); }));
    const auto* path = qobject_cast<const TreePathTable*>(view->model());
    QCOMPARE(path->step(), 11);
    const int last = path->rowCount() - 1;
    QVERIFY(last > 1);

    // A click selects the plane's patch, a double-click goes to its step.
    const int row = patch_of(path->outline(), path->visit(0)) == no_patch ? last : 0;
    view->scrollTo(path->index(row, 0));
    const QPoint name = view->visualRect(path->index(row, TreePathTable::of_plane)).center();
    QTest::mouseClick(view->viewport(), Qt::LeftButton, {}, name);
    QCOMPARE(s.window->selection.patch(), patch_of(path->outline(), path->visit(row)));
    const std::int32_t step = path->visit(row).plane_begin;
    QTest::mouseDClick(view->viewport(), Qt::LeftButton, {}, name);
    QVERIFY(wait_for([&] { return focus.arrived(); }));
    QCOMPARE(focus.position().step, step);
    QCOMPARE(path->rowCount(), row + 1);

    // A position on the root's bar is a step.
    const QRect cell = view->visualRect(path->index(0, TreePathTable::of_order));
    const QRectF bar = OrderBar::bar_in(cell);
    const auto place = QPointF(
        (OrderBar::left_of(path->visit(0), bar, 20) + OrderBar::left_of(path->visit(0), bar, 21)) /
            2,
        bar.center().y());
    QTest::mouseClick(view->viewport(), Qt::LeftButton, {}, place.toPoint());
    QCOMPARE(s.window->selection.patch(), focus.map()->history.step(20).patch);
    QTest::mouseDClick(view->viewport(), Qt::LeftButton, {}, place.toPoint());
    QVERIFY(wait_for([&] { return focus.arrived(); }));
    QCOMPARE(focus.position().step, 20);

    // The text states which patch comes first.
    focus.go_to({0, 3, 5});
    s.window->selection.select(focus.map()->history.step(9).patch);
    QVERIFY(wait_for([&] { return focus.arrived(); }));
    QVERIFY(s.text("tree_words").contains("after"));
    QTRY_VERIFY(fraction_of(view->grab().toImage(), theme::selection) > 0);
    save_picture(*s.window, "tree");
  }

  void the_whole_tree_is_expanded_along_the_path() {
    const SolvedWindow s("cornell-box");
    QVERIFY(s.ready);
    Focus& focus = s.window->focus;
    s.trigger("layout_debug");
    s.window->views().docks.bring_to_front("tree");
    s.window->findChild<QTabWidget*>("tree_tabs")->setCurrentIndex(1);
    auto* view = s.window->findChild<QTreeView*>("tree_browser");
    const auto* model = qobject_cast<const TreeModel*>(view->model());
    const auto shows_path = [&] {
      if (!focus.arrived() || !focus.map() || model->path().empty()) {
        return false;
      }
      const QModelIndex last = model->index_of(model->path().back());
      return model->visit(last).holds(focus.position().step) &&
             view->visualRect(last).intersects(view->viewport()->rect());
    };
    for (const RunPosition& position :
         {RunPosition{0, 3, 11}, RunPosition{0, 3, 25}, RunPosition{0, 7, 2}}) {
      focus.go_to(position);
      QVERIFY(wait_for([&] { return focus.position() == position && shows_path(); }));
      // Nodes off the path are collapsed.
      const auto& path = model->path();
      for (std::int32_t n = 0;
           n < static_cast<std::int32_t>(model->outline().tree().nodes().size()); ++n) {
        if (view->isExpanded(model->index_of(n))) {
          QVERIFY(std::find(path.begin(), path.end(), n) != path.end());
        }
      }
    }
    const QModelIndex root = model->index_of(0);
    view->scrollTo(root);
    const QPoint name = view->visualRect(root).center();
    const std::int32_t in_plane = model->visit(root).plane_begin;
    QTest::mouseClick(view->viewport(), Qt::LeftButton, {}, name);
    QCOMPARE(s.window->selection.patch(), patch_of(model->outline(), model->visit(root)));
    QTest::mouseDClick(view->viewport(), Qt::LeftButton, {}, name);
    QVERIFY(wait_for([&] { return focus.arrived() && focus.position().step == in_plane; }));
    save_picture(*s.window, "whole-tree");
  }

  void a_large_tree_updates_in_time() {
    const auto scene = load_scene("sphere-flake");
    const auto outline =
        std::make_shared<const TreeOutline>(std::make_shared<const BspTree>(*scene));
    TreeModel model;
    QTreeView view;
    view.setModel(&model);
    view.setUniformRowHeights(true);
    view.show();
    QElapsedTimer timer;
    timer.start();
    const auto directions = make_directions(Sampling::random, 10, 3);
    for (const auto& sample : directions) {
      model.show_position(outline, sample.direction, outline->size(0) / 2);
      for (const std::int32_t node : model.path()) {
        view.expand(model.index_of(node));
      }
      QCoreApplication::processEvents();
    }
    const double each =
        static_cast<double>(timer.elapsed()) / static_cast<double>(directions.size());
    qInfo("%.1f ms per direction for %zu nodes", each, outline->tree().nodes().size());
    QVERIFY(each < 500);
  }
};

const test::Registered registered("tree", test::run_as_viewer<TreeTest>);

}  // namespace transillum::viewer::tree_test

#include "tree_test.moc"
