// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The part of QuestionBox for answers that are drawn: areas in the map, outlines in the scene, and
// curves in a chart.
#include <QGridLayout>
#include <QLabel>
#include <QToolButton>
#include <algorithm>
#include <iterator>

#include "lessons/question_box.h"
#include "model/snapshot_values.h"
#include "transillum/at.h"
#include "widgets/build.h"
#include "widgets/log_chart.h"
#include "widgets/theme.h"

namespace transillum::viewer {

void QuestionBox::add_drawing() {
  auto* grid = static_cast<QGridLayout*>(answers_->layout());
  given_ = named("question_given", new QLabel);
  given_->setWordWrap(true);
  grid->addWidget(given_, 0, 0);
  grid->setColumnStretch(0, 1);
  const Question::Kind kind = page_->question->kind;
  if (kind == Question::Kind::curve) {
    add_chart();
  } else if (kind != Question::Kind::patch) {
    drop_ = named("question_drop", new QToolButton,
                  tr("Remove the corner that was clicked last (Backspace)"));
    drop_->setText(tr("Remove the last corner"));
    drop_->setShortcut(Qt::Key_Backspace);
    grid->addWidget(drop_, 0, 1);
    connect(drop_, &QToolButton::clicked, this, &QuestionBox::drop_point);
  }
}

// Four decades, whatever the answer is: the axes must not tell it.
void QuestionBox::add_chart() {
  chart_ = named("question_chart", new LogChart({}, {}, {}));
  constexpr int usual_height = 170;
  chart_->setFixedHeight(theme::scaled(usual_height));
  QStringList names;
  for (const Question::Choice& choice : page_->question->choices) {
    names << QString::fromStdString(choice.text);
  }
  chart_->set_axes(names, {-4, 0});
  static_cast<QGridLayout*>(answers_->layout())->addWidget(chart_, 1, 0);
  connect(chart_, &LogChart::pointed, this, [this](int x, double value) {
    if (!solved_) {
      GivenAnswer answer = answer_;
      answer.heights.resize(page_->question->choices.size());
      at(answer.heights, x - 1) = value;
      set_answer(std::move(answer));
    }
  });
}

void QuestionBox::show_chart() {
  std::vector<LogChart::Line> lines{{tr("yours"), theme::accent, answer_.heights, true}};
  if (solved_) {
    lines.push_back({tr("computed"), theme::good, solved_->values, true});
  }
  chart_->show_lines(std::move(lines), {}, static_cast<int>(page_->question->choices.size()));
}

void QuestionBox::take_point() {
  if (!page_ || solved_ || page_->question->kind != Question::Kind::area || !focus_.probe()) {
    return;
  }
  GivenAnswer answer = answer_;
  answer.outline.push_back(*focus_.probe());
  set_answer(std::move(answer));
}

namespace {

// Corners may be clicked beside the patch, too.
bool is_near(const Scene& scene, PatchId patch, const Vec3& point) {
  constexpr double margin = 1.5;
  const Vec3& center = scene.patch(patch).center;
  double radius = 0;
  for (const PointId corner : scene.outline(patch)) {
    radius = std::max(radius, norm(scene.point(corner) - center));
  }
  return norm(point - center) <= margin * radius;
}

}  // namespace

void QuestionBox::take_ray(const Vec3& begin, const Vec3& direction) {
  if (!page_ || solved_ || page_->question->kind != Question::Kind::outline) {
    return;
  }
  // The answer is on the plane of the direction that the question is about.
  const LessonValue& wanted = page_->question->wanted;
  const auto map = focus_.map();
  if (!map || map->direction != wanted.direction) {
    return;
  }
  selection_.select(page_->state.selection);  // the click was for a corner
  const Scene& scene = *map->loaded->scene;
  const Patch& patch = scene.patch(wanted.patch);
  const Vec3 point =
      begin + dot(patch.center - begin, patch.normal) / dot(direction, patch.normal) * direction;
  if (dot(point - begin, direction) > 0 && is_near(scene, wanted.patch, point)) {
    GivenAnswer answer = answer_;
    answer.outline.push_back(map->record().frame.project(point));
    set_answer(std::move(answer));
  } else {
    given_->setText(tr("That point is not on patch %1. %2").arg(wanted.patch).arg(given_text()));
  }
}

void QuestionBox::drop_point() {
  if (solved_ || answer_.outline.empty()) {
    return;
  }
  GivenAnswer answer = answer_;
  answer.outline.pop_back();
  set_answer(std::move(answer));
}

QString QuestionBox::given_text() const {
  switch (page_->question->kind) {
    case Question::Kind::patch:
      return is_given(*page_->question, answer_) ? tr("Your answer: patch %1").arg(answer_.patch)
                                                 : tr("Click a patch in the scene or the map");
    case Question::Kind::curve:
      return tr("Click or drag in the chart: %1 of %2 points")
          .arg(answer_.heights.size() -
               std::count(answer_.heights.begin(), answer_.heights.end(), 0.0))
          .arg(page_->question->choices.size());
    case Question::Kind::outline:
      return tr("Click the corners on patch %1 in the scene, in order: %2 so far")
          .arg(page_->question->wanted.patch)
          .arg(answer_.outline.size());
    default:
      return tr("Click the corners of the area in the map, in order: %1 so far")
          .arg(answer_.outline.size());
  }
}

void QuestionBox::send_sketch() {
  MapSketch sketch{answer_.outline, {}};
  if (solved_) {
    sketch.right = solved_->region;
  }
  emit sketched(sketch);
  emit surface_sketched(surface_sketch());
}

SceneSketch QuestionBox::surface_sketch() const {
  const auto map = focus_.map();
  if (!page_ || page_->question->kind != Question::Kind::outline || !map ||
      map->direction != page_->question->wanted.direction ||
      page_->question->wanted.patch >= map->loaded->scene->patch_count()) {
    return {};  // perhaps still the map of another scene
  }
  const Patch& patch = map->loaded->scene->patch(page_->question->wanted.patch);
  const auto on_patch = [&](const std::vector<Vec2>& corners) {
    std::vector<Vec3> points;
    for (const Vec2& p : corners) {
      points.push_back(map->record().frame.point_on(patch, p).value_or(patch.center));
    }
    return points;
  };
  SceneSketch sketch{on_patch(answer_.outline), {}};
  if (solved_) {
    std::transform(solved_->region.begin(), solved_->region.end(), std::back_inserter(sketch.right),
                   on_patch);
  }
  return sketch;
}

}  // namespace transillum::viewer
