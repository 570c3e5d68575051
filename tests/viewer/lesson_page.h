// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <memory>
#include <vector>

#include "lessons/lesson.h"
#include "transillum/at.h"
#include "transillum/directions.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace transillum::viewer::test {

/// A page and the run that it shows. Lessons and pages count from 1.
struct ShownPage {
  const Lesson::Page& page;
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const BspTree> tree;
  std::vector<DirectionSample> samples;

  ShownPage(int lesson, int number)
      : page(at(at(built_in_lessons(), lesson - 1).pages, number - 1)),
        scene(load_scene(page.state.scene, page.state.options.scene)),
        tree(std::make_shared<const BspTree>(*scene)) {
    const SolveOptions& solve = page.state.options.solve;
    samples = make_directions(solve.used_sampling(), solve.directions, solve.seed);
  }

  bool contains(const QString& text) const {
    return QString::fromStdString(page.text + (page.question ? page.question->then : std::string()))
        .contains(text);
  }
  Vec3 omega() const {
    const RadiositySolver solver(scene, page.state.options.solve, {.tree = tree});
    return solver.direction(0, page.state.focus->direction);
  }
  Solution solution() const { return solve(scene, page.state.options.solve); }
};

}  // namespace transillum::viewer::test
